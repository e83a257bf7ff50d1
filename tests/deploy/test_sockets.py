"""Errors of writing to a page: of a socket that was closed they are no news, others are logged."""

import asyncio

import pytest
from tornado.websocket import WebSocketClosedError, WebSocketHandler

from deploy.patches import sockets
from tests.testing.serving import run


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
        for _ in range(20):  # the turns that the failure takes
            await asyncio.sleep(0)

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
