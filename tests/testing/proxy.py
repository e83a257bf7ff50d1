"""A way to the server that can be slow, deaf or without WebSockets, for tests of the connection."""

import asyncio
import contextlib
import re
import threading

from tests.testing.serving import free_port


class Proxy:
    """A proxy in front of a served page, with faults that are switched while it runs.

    Attributes
    ----------
    delay : float
        Seconds that bytes take, either way.
    held : bool
        Whether all bytes wait, as on a network that is gone for a while; none is lost.
    upgrade : str
        What becomes of a request for a WebSocket: "pass", "strip" (its Upgrade is taken off, as an
        old proxy does), "swallow" (no answer comes), "foreign" (it tells another origin).
    """

    def __init__(self, server):
        self.port = free_port()
        self.origin = f"http://localhost:{self.port}"
        self.delay = 0.0
        self.held = False
        self.upgrade = "pass"
        self._server = server.port
        self._dead = set()  # connections that stay silent for ever
        self._tasks = set()
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._loop.run_forever)

    def __enter__(self):
        self._thread.start()
        self._listener = self._run(
            asyncio.start_server(self._connected, "127.0.0.1", self.port, limit=2**20)
        )
        return self

    def __exit__(self, *_):
        self._run(self._end())
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join()
        self._loop.close()

    def kill(self):
        """Leave every connection open and pass nothing on it from now on; new ones work."""
        self._run(self._kill())

    def _run(self, coroutine):
        return asyncio.run_coroutine_threadsafe(coroutine, self._loop).result(20)

    async def _kill(self):
        self._dead |= self._tasks

    async def _end(self):
        self._listener.close()
        others = asyncio.all_tasks() - {asyncio.current_task()}
        for task in others:
            task.cancel()
        await asyncio.gather(*others, return_exceptions=True)
        await asyncio.sleep(0.1)  # for transports to end

    async def _connected(self, reader, writer):
        task = asyncio.current_task()
        self._tasks.add(task)
        far = await asyncio.open_connection("127.0.0.1", self._server, limit=2**20)
        queues = asyncio.Queue(), asyncio.Queue()
        parts = (
            self._requests(reader, queues[0]),
            self._raw(far[0], queues[1]),
            self._late(queues[0], far[1], task),
            self._late(queues[1], writer, task),
        )
        try:
            await asyncio.gather(*parts)
        except (OSError, asyncio.IncompleteReadError):
            pass
        finally:
            self._tasks.discard(task)
            for one in (writer, far[1]):
                one.transport.abort()

    async def _requests(self, reader, queue):
        """Pass requests, which have no bodies, until one has made the connection a WebSocket."""
        while True:
            head = await reader.readuntil(b"\r\n\r\n")
            socket = b"upgrade: websocket" in head.lower()
            if socket and self.upgrade == "swallow":
                continue
            if socket and self.upgrade == "strip":
                head = re.sub(rb"(?im)^(upgrade|connection):.*\r\n", b"", head)
            ours, theirs = (f"localhost:{one}".encode() for one in (self.port, self._server))
            head = head.replace(b"Host: " + ours, b"Host: " + theirs)
            if self.upgrade != "foreign":
                head = head.replace(b"Origin: http://" + ours, b"Origin: http://" + theirs)
            self._put(queue, head)
            if socket and self.upgrade == "pass":
                return await self._raw(reader, queue)

    async def _raw(self, reader, queue):
        while data := await reader.read(2**16):
            self._put(queue, data)
        raise asyncio.IncompleteReadError(b"", None)

    def _put(self, queue, data):
        queue.put_nowait((self._loop.time() + self.delay, data))

    async def _late(self, queue, writer, task):
        while True:
            due, data = await queue.get()
            await asyncio.sleep(due - self._loop.time())
            while self.held or task in self._dead:
                await asyncio.sleep(0.05)
            with contextlib.suppress(ConnectionError):
                writer.write(data)
                await writer.drain()
