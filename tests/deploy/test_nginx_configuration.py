"""The configuration of nginx: it is accepted, and with TLS it does what the settings say."""

import contextlib
import http.client
import http.server
import os
import socket
import ssl
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

from deploy.nginx import command, find_nginx, write
from deploy.settings import read
from tests.testing.lab import (
    NEEDS_NGINX,
    PATIENCE,
    Lab,
    ask,
    certify,
)
from tests.testing.serving import free_port

pytestmark = NEEDS_NGINX


@pytest.mark.parametrize(
    "environment",
    [
        {},
        {"ADDRESS": "::1"},
        {"ADDRESS": "::", "ROTORSTAB_ORIGINS": "[2001:db8::1]:5006,[::1]"},
        {"ROTORSTAB_ORIGINS": "lab-pc,lab-pc.example:8080,127.0.0.1"},
        {"ROTORSTAB_LOG_LEVEL": "debug", "ROTORSTAB_MAX_SESSIONS": "10000"},
    ],
)
def test_nginx_accepts_its_configuration(tmp_path, environment):
    check(tmp_path, environment | {"PORT": str(free_port())})


def test_nginx_accepts_its_configuration_with_tls(tmp_path):
    folder = tmp_path / "with space"
    folder.mkdir()
    names = {"ROTORSTAB_TLS_KEY": "key.pem", "ROTORSTAB_TLS_CERTIFICATE": "certificate.pem"}
    files = {name: str(folder / file) for name, file in names.items()}
    files["ROTORSTAB_ORIGINS"] = "lab-pc"
    certify(files["ROTORSTAB_TLS_KEY"], files["ROTORSTAB_TLS_CERTIFICATE"])
    text = check(tmp_path, files | {"PORT": str(free_port())})
    assert "; Secure" in text
    assert "Strict-Transport-Security" not in text
    text = check(tmp_path, files | {"PORT": str(free_port()), "ROTORSTAB_HSTS": "86400"})
    # a location that adds a header inherits none from the server
    own = [block for block in text.split("location ") if "add_header" in block]
    assert len(own) > 4
    assert all('Strict-Transport-Security "max-age=86400" always;' in block for block in own)
    assert "ssl_reject_handshake on" in text


def test_tls_tells_browsers_to_stay_with_it_where_that_is_set(tmp_path):
    with tempfile.TemporaryDirectory(prefix="rotorstab-test-") as name:
        folder = Path(name)
        folder.chmod(0o755)
        key, certificate = str(folder / "key.pem"), str(folder / "certificate.pem")
        certify(key, certificate)
        port = free_port()
        settings = read(
            {
                "PORT": str(port),
                "ROTORSTAB_TLS_KEY": key,
                "ROTORSTAB_TLS_CERTIFICATE": certificate,
                "ROTORSTAB_HSTS": "86400",
            }
        )
        front = subprocess.Popen(command(find_nginx(), write(settings, [], folder)))
        trusted = ssl.create_default_context(cafile=certificate)
        try:
            for path, status in (("/app", 503), ("/", 302), ("/nothing", 404)):
                found, headers, _ = ask(port, path, trusted)
                assert found == status
                assert headers["Strict-Transport-Security"] == "max-age=86400"
            status, headers, page = ask(port, "/app", None)  # http:// to this port
            assert status == 400
            assert "https://" in page
        finally:
            front.terminate()
            front.wait(PATIENCE)


@contextlib.contextmanager
def front_with_tls(**environment):
    """Settings and certificate of an nginx with TLS that has no worker yet, while it runs."""
    with tempfile.TemporaryDirectory(prefix="rotorstab-test-") as name:
        folder = Path(name)
        folder.chmod(0o755)
        files = {
            "ROTORSTAB_TLS_KEY": str(folder / "key.pem"),
            "ROTORSTAB_TLS_CERTIFICATE": str(folder / "certificate.pem"),
        }
        certify(*files.values())
        environment |= files
        front = subprocess.Popen(command(find_nginx(), write(read(environment), [], folder)))
        try:
            yield environment, files["ROTORSTAB_TLS_CERTIFICATE"]
        finally:
            front.terminate()
            front.wait(PATIENCE)


def test_with_tls_health_is_found_and_http_is_sent_on():
    """The check once sent no host name in its handshake, so no container with TLS was healthy."""
    port, plain = free_port(), free_port()
    settings = {
        "PORT": str(port),
        "ROTORSTAB_HTTP_PORT": str(plain),
        "ROTORSTAB_ORIGINS": f"lab-pc:{port},localhost:{port},lab-pc.example",
    }
    with front_with_tls(**settings) as (environment, certificate):
        trusted = ssl.create_default_context(cafile=certificate)
        assert ask(port, "/app", trusted)[0] == 503
        done = subprocess.run(
            [sys.executable, "-m", "deploy.check", "/app"],
            env=os.environ | environment,
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.stdout == "/app: 503\n"  # no worker yet, and no failed handshake
        for host, where in (
            ("localhost", f"localhost:{port}"),
            ("lab-pc", f"lab-pc:{port}"),
            ("lab-pc.example", "lab-pc.example"),
        ):
            connection = http.client.HTTPConnection("127.0.0.1", plain, timeout=10)
            with contextlib.closing(connection):
                connection.request("GET", "/app?spin=1", headers={"Host": host})
                reply = connection.getresponse()
                assert reply.status == 301
                assert reply.headers["Location"] == f"https://{where}/app?spin=1"
        # a number that is not listed gets no handshake
        with pytest.raises(ssl.SSLError):
            handshake(port, certificate)


def test_with_tls_a_listed_number_is_served():
    port = free_port()
    settings = {"PORT": str(port), "ROTORSTAB_ORIGINS": f"127.0.0.1:{port}"}
    with front_with_tls(**settings) as (_, certificate):
        ask(port, "/app", ssl.create_default_context(cafile=certificate))
        assert handshake(port, certificate, f"127.0.0.1:{port}").startswith(b"HTTP/1.1 503")
        assert handshake(port, certificate, "192.0.2.1") == b""


@pytest.mark.long
def test_with_tls_the_launcher_serves_pages_and_sends_http_on(tmp_path):
    """Workers once found the second port in use by nginx, and the launcher ended."""
    files = [str(tmp_path / name) for name in ("key.pem", "certificate.pem")]
    certify(*files)
    plain = free_port()
    lab = Lab(
        tmp_path,
        ROTORSTAB_TLS_KEY=files[0],
        ROTORSTAB_TLS_CERTIFICATE=files[1],
        ROTORSTAB_HTTP_PORT=str(plain),
    )
    try:
        lab.wait()
        assert ask(lab.port, "/app", ssl.create_default_context(cafile=files[1]))[0] == 200
        status, headers, _ = ask(plain, "/app?spin=1", None)
        assert (status, headers["Location"]) == (301, f"https://localhost:{lab.port}/app?spin=1")
    finally:
        lab.stop()


def handshake(port, certificate, host="127.0.0.1"):
    """Return the first bytes of the answer to a client that sends no host name in its handshake."""
    trusted = ssl.create_default_context(cafile=certificate)
    trusted.check_hostname = False
    with (
        socket.create_connection(("127.0.0.1", port), timeout=10) as plain,
        trusted.wrap_socket(plain) as client,
    ):
        client.sendall(f"GET /app HTTP/1.1\r\nHost: {host}\r\n\r\n".encode())
        try:
            return client.recv(100)
        except ConnectionResetError:
            return b""


def check(folder, environment):
    """Have nginx test the configuration of some settings; return the configuration."""
    path = write(read(environment), ["127.0.0.1:5101", "127.0.0.1:5102"], folder)
    tested = subprocess.run(
        command(find_nginx(), path, "-t"), capture_output=True, text=True, check=False
    )
    assert tested.returncode == 0, tested.stderr
    assert "warn" not in tested.stderr.replace('the "user" directive makes sense only', "")
    return path.read_text()
