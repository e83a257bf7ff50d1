"""One simulated user of the real page, without a browser.

It sends the messages that `app/assets/messages.js` sends, in Bokeh's own frames. It receives and
assembles the patches but does not draw them.
"""

import asyncio
import re
import time
from dataclasses import dataclass
from http.cookies import SimpleCookie

from bokeh.client.websocket import WebSocketClientConnectionWrapper
from bokeh.core.serialization import Deserializer, Serialized
from bokeh.protocol import Protocol
from bokeh.protocol.messages.patch_doc import patch_doc
from bokeh.protocol.receiver import Receiver
from tornado.httpclient import AsyncHTTPClient, HTTPClientError, HTTPRequest
from tornado.websocket import websocket_connect

PATIENCE = 60  # s until a user gives up; nothing is measured by it
REST = 0.08  # s at rest after which controls.js asks for the full picture
TOKEN = re.compile(r'"token":"([^"]+)"')
_PROTOCOL = Protocol()

# one client would wait for the other's connection
AsyncHTTPClient.configure(None, max_clients=1000)


class Refused(Exception):
    """An answer other than the page; `code` and `headers` tell which."""

    def __init__(self, code, headers, body):
        super().__init__(f"{code}: {body[:80]}")
        self.code, self.headers, self.body = code, headers, body


class Lost(Exception):
    """The connection ended or the server refused a message."""


@dataclass(frozen=True)
class Answer:
    """One answer of the server.

    Parameters
    ----------
    content : dict
        What the page was told.
    seconds : float
        From the message sent to the answer and its patches received.
    patches, size : int
        Number of patches that came with it, and its bytes.
    """

    content: dict
    seconds: float
    patches: int
    size: int


class User:
    """Opens the page, moves sliders, asks for the settled picture, leaves.

    `origin` is the address of the server, `query` what stands in the address after "?".
    """

    def __init__(self, origin, path="/app", query=""):
        self.origin, self.path, self.query = origin, path, query
        self.cookies = SimpleCookie()
        self.seconds = {}  # of the page, its socket and its first data
        self.last = {}  # the newest content with values
        self.unasked = []  # what came without a question
        self._socket = self._reader = None
        self._sequence = 0
        self._waiting = {}
        self._sent = {}
        self._later = []

    async def open(self):
        """Open the page, its socket and its document; return the seconds until the first data."""
        start = time.perf_counter()
        page = await self.get()
        self.seconds["page"] = time.perf_counter() - start
        await self.connect(TOKEN.search(page)[1])
        self.seconds["socket"] = time.perf_counter() - start
        await self.ask(type="hello")
        self.seconds["data"] = time.perf_counter() - start
        await self.ask(type="settle")  # the charts of the marked point
        return self.seconds["data"]

    async def get(self):
        """Return the page's text; raise `Refused` for any other answer."""
        address = f"{self.origin}{self.path}" + (f"?{self.query}" if self.query else "")
        reply = await AsyncHTTPClient().fetch(
            HTTPRequest(address, headers=self._cookie(), request_timeout=PATIENCE),
            raise_error=False,
        )
        for cookie in reply.headers.get_list("Set-Cookie"):
            self.cookies.load(cookie)
        body = reply.body.decode() if reply.body else ""
        if reply.code != 200:
            raise Refused(reply.code, reply.headers, body)
        return body

    def _cookie(self):
        text = "; ".join(f"{name}={one.value}" for name, one in self.cookies.items())
        return {"Cookie": text} if text else {}

    async def connect(self, token):
        """Open the socket of a page's token and pull its document."""
        address = "ws" + self.origin.removeprefix("http") + self.path + "/ws"
        try:
            self._socket = await websocket_connect(
                HTTPRequest(
                    address,
                    headers={"Origin": self.origin} | self._cookie(),
                    request_timeout=PATIENCE,
                ),
                subprotocols=["bokeh", token],
                max_message_size=64 << 20,
            )
        except HTTPClientError as problem:
            reply = problem.response
            body = reply.body.decode() if reply is not None and reply.body else ""
            headers = reply.headers if reply is not None else {}
            raise Refused(problem.code, headers, body) from None
        # Nagle's algorithm would add 40 ms to what is sent in three parts
        self._socket.protocol.stream.set_nodelay(True)
        self._wire = WebSocketClientConnectionWrapper(self._socket)
        self._receiver = Receiver(_PROTOCOL)
        await self._next("ACK")
        await _PROTOCOL.create("PULL-DOC-REQ").send(self._wire)
        pulled = await self._next("PULL-DOC-REPLY")
        self._find(pulled.content["doc"]["roots"])
        self._reader = asyncio.create_task(self._read())
        await self._tell("document_ready", {"type": "map"})

    def _find(self, roots):
        """Remember the page's one component."""
        self._controls = next(root["id"] for root in roots if "esm" in root["attributes"])

    async def _next(self, kind=None):
        """Return the next message, of a kind; its bytes are its `size`."""
        size = 0
        while True:
            # a page that is idle waits for ever
            limit = None if kind is None else PATIENCE
            fragment = await asyncio.wait_for(self._socket.read_message(), limit)
            if fragment is None:
                raise Lost(f"socket closed: {self._socket.close_code}")
            size += len(fragment)
            message = await self._receiver.consume(fragment)
            if message is not None:
                if kind not in (None, message.msgtype):
                    raise Lost(f"{message.msgtype} came instead of {kind}")
                message.size = size
                return message

    async def _read(self):
        """Take what comes until the socket closes; Tornado answers pings."""
        try:
            while True:
                self._take(await self._next())
        except asyncio.CancelledError:
            self._fail(Lost("left"))
            raise
        except Exception as problem:
            self._fail(problem if isinstance(problem, Lost) else Lost(repr(problem)))

    def _take(self, message):
        if message.msgtype == "ERROR":
            raise Lost(f"the server refused a message: {message.content}")
        if message.msgtype != "PATCH-DOC":
            return
        events = message.content["events"]
        for event in events:
            content = self._content(event)
            if content is None:
                continue
            if "values" in content:
                self.last = content
            sequence = content.get("seq", 0)
            if sequence not in self._waiting:
                self.unasked.append(content)
                for condition, future in self._later:
                    if condition(content) and not future.done():
                        future.set_result(content)
                continue
            seconds = time.perf_counter() - self._sent.pop(sequence)
            waiting = self._waiting.pop(sequence)
            if not waiting.done():
                waiting.set_result(Answer(content, seconds, len(events) - 1, message.size))

    @staticmethod
    def _content(event):
        """Return what a component was told by an event, None where it is none."""
        if event["kind"] != "MessageSent" or event["msg_data"]["name"] != "esm_event":
            return None
        values = dict(event["msg_data"]["values"]["entries"])
        return Deserializer().deserialize(Serialized(values["data"]))

    def _fail(self, problem):
        for future in [*self._waiting.values(), *(future for _, future in self._later)]:
            if not future.done():
                future.set_exception(problem)
                future.exception()  # seen, also where nobody waits for it any more
        self._waiting.clear()

    @property
    def connected(self):
        """Whether the socket is open."""
        return self._reader is not None and not self._reader.done()

    async def send(self, **message):
        """Send a message of the component; return its number."""
        self._sequence += 1
        sequence = message.setdefault("seq", self._sequence)
        self._waiting[sequence] = asyncio.get_running_loop().create_future()
        self._sent[sequence] = time.perf_counter()
        values = [["model", {"id": self._controls}], ["data", _map(message)]]
        await self._tell("data_event", {"type": "map", "entries": values})
        return sequence

    async def _tell(self, name, values):
        """Send one of Bokeh's events."""
        event = {
            "kind": "MessageSent",
            "msg_type": "bokeh_event",
            "msg_data": {"type": "event", "name": name, "values": values},
        }
        await patch_doc(patch_doc.create_header(), {}, {"events": [event]}).send(self._wire)

    async def answer(self, sequence):
        """Return the answer to a message that was sent."""
        return await asyncio.wait_for(self._waiting[sequence], PATIENCE)

    async def ask(self, **message):
        """Send a message and return its answer."""
        if not self.connected:
            raise Lost("not connected")
        return await self.answer(await self.send(**message))

    async def change(self, **values):
        """Set inputs, as a slider does, and return the answer."""
        return await self.ask(type="change", values=values)

    async def settle(self):
        """Ask for the full picture after a rest; return the seconds until it is there."""
        await asyncio.sleep(REST)
        start = time.perf_counter()
        answer = await self.ask(type="settle")
        if not answer.content.get("settled"):
            await self.told(lambda content: content.get("settled"))
        return time.perf_counter() - start

    async def told(self, condition):
        """Wait for something unasked of which a condition is true."""
        future = asyncio.get_running_loop().create_future()
        entry = condition, future
        self._later.append(entry)
        try:
            return await asyncio.wait_for(future, PATIENCE)
        finally:
            self._later.remove(entry)

    @property
    def close_code(self):
        """The code with which the socket was closed; None while it is open."""
        return self._socket.close_code

    async def close(self):
        """Leave as a browser does: close the socket and wait for the server's part."""
        if self._socket is not None:
            self._socket.close(1001)
        if self._reader is not None:
            await asyncio.wait([self._reader], timeout=5)
            self._reader.cancel()


def _map(values):
    """Return a mapping as Bokeh writes it."""
    return {
        "type": "map",
        "entries": [
            [name, _map(value) if isinstance(value, dict) else value]
            for name, value in values.items()
        ],
    }
