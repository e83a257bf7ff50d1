"""Connections: the oldest gives way above a bound, and accepting pauses without descriptors."""

import asyncio
import errno
import socket
import time

import pytest

from deploy.patches import connections
from tests.testing.serving import START, Server, run
from tests.testing.wire import opened


@pytest.mark.long
def test_idle_connections_beyond_the_limit_are_closed_and_the_log_stays_short(tmp_path):
    """With 1,150 of them and 1,024 descriptors, a worker once ran in circles and wrote 91 MB."""
    app = tmp_path / "tiny.py"
    app.write_text("import panel as pn\npn.pane.Markdown('throw-away').servable()\n")
    server = Server(
        tmp_path / "log.txt",
        command=["sh", "-c", f"ulimit -n 200; exec sh '{START}' '{app}'"],
    )
    idle = []
    try:
        server.wait()
        before = len(server.log.read_text())
        for _ in range(300):
            idle.append(connect(server))
        time.sleep(1)
        clients = [one for one in idle if not is_closed(one)]
        assert 16 <= len(clients) <= 50
        log = server.log.read_text()[before:]
        assert log.count("as many as are allowed") == 1
        assert len(log) < 2000
        # later connections are served, because the oldest give way, but never the socket of a page
        time.sleep(connections.YOUNG)

        async def page():
            async with opened(server, "/tiny") as wire:
                await wire.pull()
                for _ in range(len(clients) + 20):
                    idle.append(connect(server))
                return await wire.pull()

        assert run(page())
        assert server.get("/tiny")[0] == 200
    finally:
        while idle:
            idle.pop().close()
        server.stop()


def connect(server):
    return socket.create_connection(("127.0.0.1", server.port))


def is_closed(connection):
    """Return whether the other side has closed a connection on which nothing was sent."""
    connection.setblocking(False)
    try:
        return connection.recv(1) == b""
    except BlockingIOError:
        return False
    except ConnectionResetError:
        return True


def test_a_system_without_descriptors_is_waited_for_and_named_once(monkeypatch, caplog):
    """Accepting pauses instead of failing in every turn of the loop."""
    monkeypatch.setattr(connections, "PAUSE", 0.05)
    taken = []

    class Listener(socket.socket):
        refusals = 4

        def accept(self):
            if self.refusals:
                Listener.refusals -= 1
                raise OSError(errno.EMFILE, "Too many open files")
            return super().accept()

    async def go():
        listener = Listener()
        listener.bind(("127.0.0.1", 0))
        listener.listen()
        listener.setblocking(False)
        remove = connections.add_accept_handler(listener, lambda *one: taken.append(one), most=5)
        with socket.create_connection(listener.getsockname()), listener:
            for _ in range(200):
                await asyncio.sleep(0.01)
                if taken:
                    break
            remove()

    run(go())
    assert len(taken) == 1
    taken[0][0].close()
    assert [one.message for one in caplog.records] == [
        "the system has no descriptor left: new connections wait"
    ]
