"""Settings: what is allowed, and the one line with which a wrong setting ends the start."""

import os
import re
import stat
import subprocess
import sys
from dataclasses import fields
from pathlib import Path

import pytest

from deploy.constants import HEADERS
from deploy.lab import PATIENCE
from deploy.secret import find_secret
from deploy.settings import SettingError, Settings, read
from tests.testing.serving import START, free_port

ROOT = Path(__file__).parents[2]


def start(**environment):
    """Run the start script to its end; return its code and the lines it wrote."""
    environment = {k: v for k, v in os.environ.items() if k != "BOKEH_SECRET_KEY"} | environment
    done = subprocess.run(
        ["sh", START],
        env=environment | {"PYTHON": sys.executable},
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )
    return done.returncode, (done.stdout + done.stderr).splitlines()


def test_without_an_environment_the_server_is_for_this_machine_alone():
    settings = read({})
    assert settings.address == "127.0.0.1"
    assert settings.origins == ("localhost:5006", "127.0.0.1:5006", "[::1]:5006")
    assert settings.workers == 1
    assert settings.metrics == "loopback"


@pytest.mark.parametrize(
    ("name", "value", "allowed"),
    [
        ("PORT", "0", "an integer from 1 to 65535"),
        ("PORT", "65536", "an integer from 1 to 65535"),
        ("PORT", "5006.0", "an integer"),
        ("PORT", "٥٠٠٦", "an integer"),
        ("PORT", "9" * 5000, "an integer"),
        ("ADDRESS", "lab-pc", "an IP address"),
        ("ROTORSTAB_ORIGINS", "*", "host or host:port"),
        ("ROTORSTAB_ORIGINS", "http://lab-pc:5006", "host or host:port"),
        ("ROTORSTAB_ORIGINS", "lab-pc;return 200", "host or host:port"),
        ("ROTORSTAB_WORKERS", "65", "an integer from 1 to 64"),
        ("ROTORSTAB_MAX_SESSIONS", "-1", "an integer from 1 to 10000"),
        ("ROTORSTAB_TOKEN_LIFETIME", "5", "an integer from 60"),
        ("ROTORSTAB_UNUSED_LIFETIME", "1e3", "an integer from 5"),
        ("ROTORSTAB_KEEP_ALIVE", "200", "an integer from 1 to 110"),
        ("ROTORSTAB_LESSONS", "/nowhere", "a folder that can be read"),
        ("ROTORSTAB_LOG_LEVEL", "loud", "one of debug, info, warning, error"),
        ("ROTORSTAB_LOG_FORMAT", "xml", "one of auto, json, text"),
        ("ROTORSTAB_DRAIN", "0", "an integer from 1 to 60"),
        ("ROTORSTAB_HANG", "inf", "an integer from 5"),
        ("ROTORSTAB_METRICS", "yes", "one of off, loopback, on"),
        ("ROTORSTAB_TLS_KEY", "/nowhere.pem", "a file that can be read"),
        ("ROTORSTAB_UPSTREAM", "worker", "host:port"),
    ],
)
def test_a_value_that_nobody_meant_is_refused_in_one_line(name, value, allowed):
    with pytest.raises(SettingError) as refused:
        read({name: value})
    message = str(refused.value)
    assert message.startswith(f"{name} must be {allowed}")
    assert message.endswith(f"got {value[:60]!r}")
    assert "\n" not in message


def test_the_server_ends_with_one_line_before_it_listens():
    code, lines = start(PORT="many")
    assert code == 2
    assert lines == ["rotorstab: PORT must be an integer from 1 to 65535, got 'many'"]


def test_a_short_secret_is_refused_and_not_shown():
    code, lines = start(BOKEH_SECRET_KEY="a-secret")
    assert code == 2
    assert lines == ["rotorstab: BOKEH_SECRET_KEY must be at least 32 characters, got 8"]


def test_several_workers_without_a_common_secret_do_not_start(tmp_path):
    path = tmp_path / "secret"
    code, lines = start(ROTORSTAB_WORKERS="2", ROTORSTAB_SECRET_FILE=str(path))
    assert code == 2
    assert len(lines) == 1
    assert "2 workers need one secret" in lines[0]
    assert not path.exists()


def test_tls_needs_both_files(tmp_path):
    certificate = tmp_path / "lab.pem"
    certificate.write_text("")
    with pytest.raises(SettingError, match="set together"):
        read({"ROTORSTAB_TLS_CERTIFICATE": str(certificate)})
    # HSTS promises TLS, which this server would not offer
    with pytest.raises(SettingError, match="ROTORSTAB_TLS_CERTIFICATE, which is not set"):
        read({"ROTORSTAB_HSTS": "86400"})


def test_a_secret_is_made_once_for_its_owner_only(tmp_path):
    path = tmp_path / "state" / "secret"
    settings = read({"ROTORSTAB_SECRET_FILE": str(path)})
    made = find_secret(settings, make=True)
    assert len(made) >= 32
    assert stat.S_IMODE(path.stat().st_mode) == 0o600
    assert find_secret(settings, make=True) == made
    assert find_secret(settings, make=False) == made
    assert [one.name for one in path.parent.iterdir()] == ["secret"]


@pytest.mark.parametrize("content", [b"", b"short", b"\xff" * 40])
def test_a_secret_file_that_holds_none_is_refused(tmp_path, content):
    path = tmp_path / "secret"
    path.write_bytes(content)
    path.chmod(0o600)
    with pytest.raises(SettingError, match="must hold at least 32 characters"):
        find_secret(read({"ROTORSTAB_SECRET_FILE": str(path)}), make=True)


def test_a_secret_that_others_can_read_is_refused(tmp_path):
    path = tmp_path / "secret"
    path.write_text("s" * 64)
    path.chmod(0o644)
    with pytest.raises(SettingError, match="chmod 600"):
        find_secret(read({"ROTORSTAB_SECRET_FILE": str(path)}), make=True)


def test_a_secret_that_cannot_be_kept_is_refused(tmp_path):
    blocked = tmp_path / "file"
    blocked.write_text("")
    with pytest.raises(SettingError, match="set it to another path, or BOKEH_SECRET_KEY"):
        find_secret(read({"ROTORSTAB_SECRET_FILE": str(blocked / "secret")}), make=True)


def test_make_serve_works_in_a_path_with_a_space(tmp_path):
    """The start script and the worker run from a folder with a space, until they find no app."""
    folder = tmp_path / "a lab"
    folder.mkdir()
    (folder / "deploy").symlink_to(ROOT / "deploy", target_is_directory=True)
    done = subprocess.run(
        ["sh", folder / "deploy" / "start.sh", folder / "no app"],
        env=os.environ
        | {
            "PYTHON": sys.executable,
            "PORT": str(free_port()),  # whoever tests may be serving
            "ROTORSTAB_SECRET_FILE": f"{folder}/secret",
        },
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2
    assert done.stderr == f"rotorstab: there is no app at {folder}/no app\n"


def test_a_port_in_use_is_refused_in_one_line(tmp_path):
    import socket

    with socket.socket() as taken:
        taken.bind(("127.0.0.1", free_port()))
        taken.listen()
        port = str(taken.getsockname()[1])
        code, lines = start(PORT=port, ROTORSTAB_SECRET_FILE=str(tmp_path / "secret"))
    assert code == 2
    assert lines[-1] == f"rotorstab: PORT {port} of 127.0.0.1 is in use"


def test_the_documentation_lists_every_setting_as_it_is():
    text = (ROOT / "docs" / "deploy.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| `([A-Z_]+)` \| (.*?) \| (.*?) \| (.*?) \|$", text, re.M)
    declared = [
        (
            one.metadata["name"],
            f"`{one.metadata['default']}`" if one.metadata["default"] else "none",
            one.metadata["kind"].allowed,
            one.metadata["meaning"],
        )
        for one in fields(Settings)
    ]
    assert rows == declared


FIXED_BY_COMPOSE = {"ADDRESS", "PORT", "ROTORSTAB_WORKER_PORT", "ROTORSTAB_SECRET_FILE"}


def test_compose_passes_every_setting_that_the_documentation_lists():
    compose = (ROOT / "compose.yaml").read_text(encoding="utf-8")
    names = {one.metadata["name"] for one in fields(Settings)} - FIXED_BY_COMPOSE
    assert {name for name in names if f"  {name}:" not in compose} == set()
    documented = (ROOT / "docs" / "deploy.md").read_text(encoding="utf-8")
    fixed = documented.partition("but for those that the\ncontainers fix:")[2].partition(".")[0]
    assert {f"`{name}`" in fixed for name in FIXED_BY_COMPOSE} == {True}


def test_a_worker_that_drains_as_long_as_it_may_is_not_killed():
    longest = next(one for one in fields(Settings) if one.name == "drain").metadata["kind"].allowed
    seconds = int(longest.rpartition(" ")[2])
    unit = (ROOT / "deploy" / "rotorstab.service").read_text()
    compose = (ROOT / "compose.yaml").read_text()
    stops = [int(re.search(r"TimeoutStopSec=(\d+)", unit)[1])]
    stops += [int(one) for one in re.findall(r"stop_grace_period: (\d+)s", compose)]
    assert len(stops) == 3
    # the workers, then nginx
    assert min(stops) >= seconds + 2 * PATIENCE


def test_no_security_header_holds_a_double_quote():
    # the template of nginx's configuration writes each value between double quotes
    assert not [name for name, value in HEADERS.items() if '"' in value]
