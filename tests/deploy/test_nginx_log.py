"""nginx's messages in the log, without the addresses and queries of students."""

import json
import os
import socket
import subprocess
import sys
import threading

import pytest

from deploy import nginx_log
from tests.testing.lab import (
    NEEDS_NGINX,
    PATIENCE,
    Lab,
)

STUDENT = "192.0.2.77"


@pytest.mark.parametrize(
    ("line", "level", "message"),
    [
        (
            f"2026/11/27 10:00:00 [error] 7#7: *12 upstream prematurely closed connection, client: "
            f'{STUDENT}, server: lab-pc, request: "GET /app?spin=1&name=Ada HTTP/1.1", upstream: '
            '"http://127.0.0.1:5101/app?spin=1&name=Ada", host: "lab-pc"',
            "ERROR",
            'upstream prematurely closed connection, upstream: "http://127.0.0.1:5101/app"',
        ),
        (
            f"2026/11/27 10:00:00 [warn] 7#7: *1 a client of {STUDENT}:4040 is slow, client: "
            f"{STUDENT}",
            "WARNING",
            "a client of … is slow",
        ),
        (
            '2026/11/27 10:00:00 [crit] 7#7: *1 open() "/tmp/a" failed (28: No space left), '
            'client: 2001:db8::7, server: lab, request: "GET /app?a=1 HTTP/1.1", host: "[::1]:80"',
            "CRITICAL",
            'open() "/tmp/a" failed (28: No space left)',
        ),
        (
            "2026/11/27 10:00:00 [notice] 7#7: signal process started",
            "INFO",
            "signal process started",
        ),
        (
            f"nginx: what it says otherwise of {STUDENT}",
            "WARNING",
            "nginx: what it says otherwise of …",
        ),
    ],
)
def test_nginxs_messages_are_logged_without_address_and_query(caplog, line, level, message):
    with caplog.at_level("DEBUG"):
        nginx_log.record(line)
    (found,) = caplog.records
    assert (found.levelname, found.getMessage()) == (level, message)


WRITE_BOTH = """
import logging
from deploy import nginx_log, settings
from deploy.patches import logs

logs.install(settings.read({"ROTORSTAB_LOG_FORMAT": "json"}))
nginx_log.record('{"message":"GET /app"}')
logging.warning("of our own")
"""


@pytest.mark.parametrize("unbuffered", ["", "1"])
def test_each_line_is_one_write_because_several_processes_share_the_stream(unbuffered):
    """Each write to this kind of socket is a message of its own."""
    ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    with ours, theirs:
        subprocess.run(
            [sys.executable, "-c", WRITE_BOTH],
            env=os.environ | {"PYTHONUNBUFFERED": unbuffered},
            stderr=theirs,
            check=True,
        )
        theirs.close()
        writes = []
        while part := ours.recv(1 << 16):
            writes.append(part.decode())
    assert [line[-1] for line in writes] == ["\n", "\n"]
    assert [json.loads(line)["message"] for line in writes] == ["GET /app", "of our own"]


@NEEDS_NGINX
@pytest.mark.long
def test_debug_logs_requests_but_neither_address_nor_query(tmp_path):
    """Standard error is a socket, as under journald, which nginx could not open by itself."""
    ours, theirs = socket.socketpair()
    parts = []

    def read_all():
        while part := ours.recv(1 << 16):
            parts.append(part)

    reading = threading.Thread(target=read_all, daemon=True)
    reading.start()
    with ours, theirs:
        lab = Lab(tmp_path, stderr=theirs, ROTORSTAB_LOG_LEVEL="debug")
        theirs.close()
        try:
            lab.wait_for(lambda: lab.get("/app?name=Ada")[0] == 200)
            for port in lab.ports:
                lab.wait_for(lambda port=port: lab.worker(port, "/app?name=Ada")[0] == 200)
            lab.get("/app?name=Ada", method="POST")
            lab.get("/nothing?name=Ada")
        finally:
            lab.stop()
        reading.join(PATIENCE)
    log = b"".join(parts).decode()
    assert '"message":"GET /app","status":200' in log
    assert "GET /app" in log.replace('"message":"GET /app"', "")  # a worker's own line
    assert "Ada" not in log
    assert "127.0.0.1)" not in log
    for line in log.splitlines():
        json.loads(line)
