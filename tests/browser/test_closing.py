"""A page that is closed while the server redraws it leaves no traceback, and real errors stay."""

import asyncio
import re
import time

import pytest
from tornado.websocket import WebSocketClosedError, WebSocketHandler

from deploy.patches import sockets
from tests.testing.serving import run

DRAG = """(start) => {
  for (let step = 0; step < 4; step += 1) {
    rotorstab.send({ type: "change", values: { spin_speed: start + 0.013 * step } });
    rotorstab.send({ type: "settle" });
  }
}"""


def open_sockets(server):
    """Number of open sockets, from the server itself."""
    return float(re.search(r"^rotorstab_sockets (\S+)$", server.get("/metrics")[2], re.M)[1])


@pytest.mark.browser
def test_closing_during_a_redraw_logs_no_traceback(open_page, dashboard):
    for start in (1.0, 1.5):
        others = open_sockets(dashboard)
        page = open_page()
        before = len(dashboard.log.read_text())
        page.evaluate(DRAG, start)
        page.close()
        deadline = time.monotonic() + 60
        while open_sockets(dashboard) > others:
            assert time.monotonic() < deadline
            time.sleep(0.1)
        new = dashboard.log.read_text()[before:]
        assert "Traceback" not in new
        assert "never retrieved" not in new


@pytest.mark.parametrize("error", [WebSocketClosedError(), OSError("a real one")])
def test_only_a_closed_socket_is_let_go(error, monkeypatch, caplog):
    told = []

    async def fail():
        raise error

    async def write_and_forget():
        asyncio.get_running_loop().set_exception_handler(lambda _, context: told.append(context))
        monkeypatch.setattr(sockets, "write_message", lambda *_: asyncio.ensure_future(fail()))
        sockets.install()
        WebSocketHandler.write_message(None, "part")
        await asyncio.sleep(0.01)

    monkeypatch.setattr(WebSocketHandler, "write_message", WebSocketHandler.write_message)
    run(write_and_forget())
    assert told == []
    assert ("a real one" in caplog.text) == isinstance(error, OSError)


def test_whoever_awaits_a_write_still_gets_its_error(monkeypatch):
    async def fail():
        raise WebSocketClosedError

    async def write():
        monkeypatch.setattr(sockets, "write_message", lambda *_: asyncio.ensure_future(fail()))
        await sockets.write_and_look(None, "part")

    with pytest.raises(WebSocketClosedError):
        run(write())
