"""`rotorstab serve` of the installed package; `make newest` runs this on a fresh environment."""

import os
import re
import subprocess
import sys
from importlib.metadata import entry_points
from pathlib import Path

import pytest

from tests.testing.lab import NEEDS_NGINX, worker_ports
from tests.testing.serving import Server, run
from tests.testing.wire import opened

PROGRAM = Path(sys.executable).with_name("rotorstab")
NOT_INSTALLED = "rotorstab is not installed as pyproject.toml says: `make unit` installs it"


@pytest.fixture(autouse=True)
def _installed():
    if not entry_points(group="rotorstab.commands"):
        pytest.fail(NOT_INSTALLED, pytrace=False)


@pytest.fixture
def elsewhere(tmp_path):
    """A working directory with modules of other people that have our names."""
    for name in ("app", "deploy"):
        (tmp_path / f"{name}.py").write_text("raise SystemExit('a foreign module was imported')")
    return tmp_path


def failure(folder, *arguments, **environment):
    """Run `rotorstab` with arguments that are wrong; return its one line on standard error."""
    done = subprocess.run(
        [PROGRAM, *arguments],
        cwd=folder,
        env=os.environ | environment,
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )
    assert done.returncode == 2
    assert done.stdout == ""
    (line,) = done.stderr.splitlines()
    return line


def test_the_dashboard_is_served_from_another_folder(elsewhere, tmp_path):
    command = [PROGRAM, "serve", "--address", "127.0.0.1", "--port", "PORT"]
    server = Server(tmp_path / "log.txt", command=command, folder=elsewhere, PORT="1")

    async def hello():
        async with opened(server) as wire:
            await wire.pull()
            return await wire.ask({"type": "hello"})

    try:
        status, _, page = server.wait().get("/app")
        assert status == 200
        assert '<section class="page" data-page="explore"' in page
        assert "What is parametric resonance?" in page  # the first lesson
        assert run(hello())["values"]["spin_speed"] == 2.0
        files = set(re.findall(r'"(/?static/[^"?]+)', page))
        assert files
        for file in files:
            assert server.get(f"/{file.lstrip('/')}", method="HEAD")[0] == 200
        log = server.log.read_text()
        assert f"serving http://127.0.0.1:{server.port}/" in log
        assert "Traceback" not in log
    finally:
        server.stop()


@NEEDS_NGINX
@pytest.mark.long
def test_several_workers_are_served_by_nginx(elsewhere, tmp_path):
    command = [PROGRAM, "serve", "--port", "PORT", "--workers", "2"]
    first, second = worker_ports()
    server = Server(
        tmp_path / "log.txt", command=command, folder=elsewhere, ROTORSTAB_WORKER_PORT=str(first)
    )
    try:
        server.wait()
        while (status := server.get("/app", method="HEAD")[0]) == 503:
            assert server.process.poll() is None, server.log.read_text()
        assert status == 200
        log = server.log.read_text()
        assert "started nginx" in log
        assert f"started worker {second}" in log
    finally:
        server.stop()


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        (
            ["--port", "70000"],
            "argument --port: must be an integer from 1 to 65535, got '70000'",
        ),
        (["--address", "lab-pc"], "argument --address: must be an IP address, got 'lab-pc'"),
        (["--workers", "0"], "argument --workers: must be an integer from 1 to 64, got '0'"),
        (["--dev"], "unrecognized arguments: --dev"),
    ],
)
def test_wrong_options_are_refused_in_one_line(tmp_path, arguments, line):
    assert failure(tmp_path, "serve", *arguments).endswith(f": {line}")


def test_a_wrong_setting_of_the_environment_is_refused_in_one_line(tmp_path):
    line = failure(tmp_path, "serve", ROTORSTAB_DRAIN="0")
    assert line == "rotorstab: ROTORSTAB_DRAIN must be an integer from 1 to 60, got '0'"


def test_the_program_says_its_version(tmp_path):
    done = subprocess.run(
        [PROGRAM, "--version"], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    assert re.fullmatch(r"rotorstab \d+\.\d+\.\d+\n", done.stdout)
