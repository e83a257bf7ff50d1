"""Bokeh's protocol without Bokeh: one raw socket to a served page, which may send anything."""

import asyncio
import contextlib
import itertools
import json
import re

from tornado.httpclient import HTTPRequest
from tornado.websocket import websocket_connect

ANSWER = 30  # s


def encoded(value):
    """A value as the browser writes it: mappings as maps, what is not finite by name."""
    if isinstance(value, dict):
        pairs = [[str(name), encoded(one)] for name, one in value.items()]
        return {"type": "map", "entries": pairs}
    if isinstance(value, list | tuple):
        return [encoded(one) for one in value]
    if isinstance(value, float) and (value != value or value in (float("inf"), float("-inf"))):
        words = "nan" if value != value else "+inf" if value > 0 else "-inf"
        return {"type": "number", "value": words}
    return value


def custom(model, data):
    """The event of a custom message to a component."""
    values = {"type": "map", "entries": [["model", {"id": model}], ["data", encoded(data)]]}
    return {
        "kind": "MessageSent",
        "msg_type": "bokeh_event",
        "msg_data": {"type": "event", "name": "data_event", "values": values},
    }


def changed(model, name, value):
    """The event of a property that was set."""
    return {"kind": "ModelChanged", "model": {"id": model}, "attr": name, "new": value}


class Wire:
    """An open socket. `raw` sends fragments as they are; `ask` waits for the answer's number."""

    def __init__(self, connection):
        self.connection = connection
        self.count = itertools.count(1)
        self.models = {}
        self.heard = []  # every text that came, for tests that look for leaks
        self.ended = False

    async def raw(self, *fragments):
        for one in fragments:
            await self.connection.write_message(one, binary=isinstance(one, bytes))

    async def send(self, kind, content):
        number = f"test-{next(self.count)}"
        header = json.dumps({"msgid": number, "msgtype": kind})
        await self.raw(header, "{}", json.dumps(content))
        return number

    async def patch(self, *events):
        return await self.send("PATCH-DOC", {"events": list(events)})

    async def fragment(self):
        """The next fragment; None once where the socket was closed, for the queue has no more."""
        part = await self.connection.read_message()
        self.ended = self.ended or part is None
        if isinstance(part, str):
            self.heard.append(part)
        return part

    async def read(self):
        """One message as header and content; None where the socket was closed."""
        parts = []
        while len(parts) < 3:
            part = await asyncio.wait_for(self.fragment(), ANSWER)
            if part is None:
                return None
            parts.append(part)
        header, _, content = map(json.loads, parts)
        for _ in range(2 * header.get("num_buffers", 0)):
            await asyncio.wait_for(self.fragment(), ANSWER)
        return header, content

    async def reply(self, number):
        """The reply to a message: its type and content; None where the socket was closed."""
        while (message := await self.read()) is not None:
            header, content = message
            if header.get("reqid") == number:
                return header["msgtype"], content
        return None

    async def pull(self):
        """Read the document; keep its models' ids by type."""
        _, content = await self.reply(await self.send("PULL-DOC-REQ", {}))
        for name, one in re.findall(r'"name": ?"([\w.]+)", ?"id": ?"(\w+)"', json.dumps(content)):
            self.models.setdefault(name.rpartition(".")[2], []).append(one)
        return content

    async def ask(self, data):
        """Send the page's component a message; return its answer, None where it was refused."""
        sequence = next(self.count)
        number = await self.patch(custom(self.models["ReactiveESM"][0], data | {"seq": sequence}))
        while (message := await self.read()) is not None:
            if message[0].get("reqid") == number and message[0]["msgtype"] == "ERROR":
                return None
            for event in message[1].get("events", []):
                answer = plain(event.get("msg_data"))
                if isinstance(answer, dict):
                    found = answer.get("values", {}).get("data", {})
                    if isinstance(found, dict) and found.get("seq") == sequence:
                        return found
        return None


def plain(value):
    """A value that the server wrote, with its maps as mappings."""
    if isinstance(value, dict):
        if value.get("type") == "map":
            return {name: plain(one) for name, one in value.get("entries", [])}
        return {name: plain(one) for name, one in value.items()}
    return [plain(one) for one in value] if isinstance(value, list) else value


def token(server, path="/app"):
    """A token of a new page."""
    status, _, page = server.get(path)
    assert status == 200, f"{path} answered {status}"
    return re.search(r'"token":"([^"]+)"', page)[1]


@contextlib.asynccontextmanager
async def opened(server, path="/app", page=None):
    """A wire to a new page, or to the page of a token, past the server's greeting."""
    loop = asyncio.get_running_loop()
    page = page or await loop.run_in_executor(None, token, server, path)
    request = HTTPRequest(
        f"ws://127.0.0.1:{server.port}{path}/ws", headers={"Origin": server.origin}
    )
    connection = await websocket_connect(request, subprotocols=["bokeh", page])
    connection.protocol.set_nodelay(True)
    wire = Wire(connection)
    try:
        await wire.read()
        yield wire
    finally:
        connection.close()
        with contextlib.suppress(asyncio.TimeoutError):  # a wire that was cut
            while not wire.ended:
                await asyncio.wait_for(wire.fragment(), 5)
