"""`panel serve app` without the start script, in the ways that people start it."""

import logging
import re
import socket
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace
from urllib.parse import parse_qs, urlsplit
from urllib.request import urlopen

import pytest

from deploy import worker
from deploy.patches import patching, plain_serving
from deploy.settings import SettingError, read
from tests.testing.serving import Server, run
from tests.testing.wire import opened

ROOT = Path(__file__).parents[2]
PANEL = [sys.executable, "-m", "panel", "serve"]
LOOPBACK = ["--address", "127.0.0.1", "--port", "PORT"]


@pytest.fixture(scope="module")
def plain(tmp_path_factory):
    """The app served by plain Panel as a developer does, with a page made at the start."""
    log = tmp_path_factory.mktemp("plain") / "log.txt"
    server = Server(log, command=[*PANEL, "app", "--dev", "--warm", *LOOPBACK])
    try:
        yield server.wait()
    finally:
        server.stop()


@pytest.fixture(scope="module")
def below(tmp_path_factory):
    """The start script's server with a prefix."""
    log = tmp_path_factory.mktemp("below") / "log.txt"
    server = Server(log, ROTORSTAB_PREFIX="/lab", ROTORSTAB_LOG_LEVEL="info")
    try:
        yield server.wait()
    finally:
        server.stop()


def hello(server, path):
    """The page's answer to its browser's first message."""

    async def asked():
        async with opened(server, path=path) as wire:
            await wire.pull()
            return await wire.ask({"type": "hello"})

    return run(asked())


def test_a_page_works_with_dev_and_warm(plain):
    assert hello(plain, "/app")["values"]["spin_speed"] == 2.0
    log = plain.log.read_text()
    assert "Traceback" not in log
    assert "listens on" not in log  # nobody else can reach it


def test_the_app_s_file_is_served_from_another_folder_below_a_prefix(tmp_path):
    file = ROOT / "app" / "main.py"
    command = [*PANEL, str(file), "--prefix", "/lab", *LOOPBACK]
    server = Server(tmp_path / "log.txt", command=command, folder=tmp_path)
    try:
        server.wait()
        assert hello(server, "/lab/main")["values"]["spin_speed"] == 2.0
        status, headers, _ = server.get("/lab/main/?spin=1.5&as=0.3")
        assert (status, headers["Location"]) == (302, "/lab/main?spin=1.5&as=0.3")
        assert server.get("/lab/components/os/path")[0] == 404  # from the first page on
        assert "Traceback" not in server.log.read_text()
    finally:
        server.stop()


LONG = pytest.mark.long  # the same lines of main.py, reached in the other way
WITHOUT = """
import sys
from panel.command import main
sys.modules[{module!r}] = None  # cannot be imported
sys.argv = ["panel", "serve", {path!r}, "--warm", "--address", "127.0.0.1", "--port", "0"]
main()
"""


@pytest.mark.parametrize(
    ("module", "path"),
    [
        ("rotorstab", ROOT / "app"),
        ("app", ROOT / "app"),
        ("deploy", ROOT / "app" / "main.py"),
        *(pytest.param(one, ROOT / "app" / "main.py", marks=LONG) for one in ("rotorstab", "app")),
        pytest.param("deploy", ROOT / "app", marks=LONG),
    ],
)
def test_panel_says_in_one_line_that_the_project_is_not_installed(tmp_path, module, path):
    done = subprocess.run(
        [sys.executable, "-c", WITHOUT.format(module=module, path=str(path))],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )
    assert done.returncode == 1
    lines = [line for line in done.stderr.splitlines() if not re.match(r"\d{4}-", line)]  # the log
    assert len(lines) == 1
    assert lines[0].startswith("rotorstab: this Python cannot serve the dashboard: ")
    assert module in lines[0]
    assert "pip install 'rotorstab[app]'" in lines[0]


@pytest.mark.parametrize("query", ["", "?spin=1.5&as=0.3&p1=spin_1~~a%20b%2B"])
def test_a_slash_too_many_leads_to_the_page_with_its_query(plain, below, query):
    for server, path, page in (
        (plain, "/app/", "/app"),
        (plain, "/", "/app"),
        (below, "/lab/app/", "/lab/app"),
        (below, "/lab/", "/lab/app"),
        (below, "/lab", "/lab/app"),
        (below, "/", "/lab/app"),
    ):
        status, headers, _ = server.get(path + query)
        assert status == 302
        where = urlsplit(headers["Location"])
        assert (where.netloc, where.path) == ("", page)
        assert parse_qs(where.query) == parse_qs(query[1:])
        assert server.get(path + query, method="HEAD")[0] == 302


@pytest.mark.parametrize("path", ["//app", "/app//", "/app/x", "//evil.example/app/", "/lab/app"])
def test_nothing_else_is_redirected(plain, path):
    status, headers, _ = plain.get(path)
    assert status == 404 or urlsplit(headers["Location"]).netloc == ""
    assert "evil" not in headers.get("Location", "")


def test_below_a_prefix_links_icon_and_log_are_below_it_too(below):
    status, _, text = below.get("/lab/nothing")
    assert status == 404
    assert re.findall(r'href="([^"]+)"', text) == ["/lab/app"]
    with urlopen(f"http://127.0.0.1:{below.port}/lab/favicon.ico") as icon:
        assert icon.read(4) == b"\x00\x00\x01\x00"
    assert f"serving http://127.0.0.1:{below.port}/lab/ " in below.log.read_text()


def test_plain_panel_is_hardened_from_inside(plain):
    status, headers, text = plain.get("/nothing")
    assert status == 404
    assert "Traceback" not in text
    assert "default-src 'self'" in headers["Content-Security-Policy"]
    assert headers["X-Frame-Options"] == "DENY"
    assert "Server" not in headers
    assert plain.get("/components/os/path")[0] == 404
    assert plain.get("/static/js/%00.js")[0] == 404
    assert plain.get(f"/app?spin={'9' * 5000}")[0] == 200
    for host in ("localhost", "127.0.0.1:5006", "[::1]", "192.168.1.7", socket.gethostname()):
        assert plain.get("/nothing", Host=host)[0] == 404
    for host in (
        "evil.example",
        "localhost.evil.example",
        "127.0.0.1.evil.example",
        "[::1",
        "a:b:c",
    ):
        status, _, text = plain.get("/nothing", Host=host)
        assert status in (400, 421)
        assert "evil" not in text


@pytest.mark.parametrize(
    ("address", "others"),
    [
        (None, True),
        ("", True),
        ("0.0.0.0", True),
        ("::", True),
        ("192.168.1.7", True),
        ("lab-pc", True),
        ("127.0.0.1", False),
        ("127.0.0.2", False),
        ("::1", False),
        ("localhost", False),
    ],
)
def test_a_server_that_others_reach_says_so_with_the_command_that_is_safe(
    address, others, caplog, monkeypatch
):
    monkeypatch.setattr(patching, "hardened", False)
    assert plain_serving.listens_to_others(address) is others
    with caplog.at_level(logging.WARNING):
        plain_serving.warn(SimpleNamespace(address=address, port=5006))
    assert len(caplog.records) == others
    if others:
        assert f"listens on {address or 'every address of this machine'}:" in caplog.text
        assert "panel serve app --address 127.0.0.1" in caplog.text
        assert "deploy/start.sh" in caplog.text
    caplog.clear()
    plain_serving.warn(SimpleNamespace(address=None, port=None))  # a Unix socket
    monkeypatch.setattr(patching, "hardened", True)  # by the start script
    plain_serving.warn(SimpleNamespace(address=address, port=5006))
    assert caplog.records == []


def test_several_processes_are_refused_with_the_reason():
    done = subprocess.run(
        [*PANEL, "app", "--address", "127.0.0.1", "--port", "0", "--num-procs", "2"],
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert done.returncode != 0
    assert "--num-procs is not possible: the processes that it starts would go on" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize(
    "more",
    ["--num-procs 2", "--num-procs=2", "--num 2", "--dev", "--autoreload", "--admin", "--reuse-s"],
)
def test_the_start_script_refuses_what_a_server_for_others_must_not_have(more):
    with pytest.raises(SettingError, match="is not possible: "):
        worker.command(read({}), "app", more.split())
    words = worker.command(read({}), "app", ["--num-threads", "1", "--warm"])
    assert words[-3:] == ["--num-threads", "1", "--warm"]
