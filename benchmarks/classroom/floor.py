"""The comparison for a class: a bare Bokeh page that patches the same arrays, in two processes."""

import asyncio
import json
import sys
import time
from contextlib import contextmanager
from pathlib import Path

from bokeh.protocol.messages.patch_doc import patch_doc

from benchmarks.classroom.client import PATIENCE, TOKEN, Lost, User
from benchmarks.classroom.moving import Moves
from benchmarks.redraw.moves import SLIDERS, values
from tests.testing.serving import Server

PAGE = Path(__file__).parents[1] / "redraw" / "floor.py"
COUNT = 12  # values of a slider
SIZES = {"instability": (900, 500), "load-frequency": (450, 350), "campbell": (450, 350)}


@contextmanager
def serve(folder, processes=2):
    """Yield the origins of the servers of the bare page."""
    servers = [
        Server(
            Path(folder) / f"floor{number}.txt",
            command=[sys.executable, "-m", "bokeh", "serve", str(PAGE), "--port", "PORT"],
            FLOOR_COUNT=str(COUNT),
            FLOOR_SIZES=json.dumps(SIZES),
            FLOOR_DRAGGED="0",
        )
        for number in range(processes)
    ]
    try:
        yield [server.wait().origin for server in servers]
    finally:
        for server in servers:
            server.stop()


class FloorUser(User):
    """A user of the bare page: moves a stock slider and waits for Bokeh's OK."""

    async def open(self):
        """Open the page and its socket."""
        await self.connect(TOKEN.search(await self.get())[1])

    def _find(self, roots):
        self._sliders = {
            root["attributes"]["name"]: root["id"]
            for root in roots
            if root["name"].endswith("Slider")
        }

    def _take(self, message):
        if message.msgtype == "OK" and (waiting := self._waiting.pop(message.header["reqid"], 0)):
            waiting.set_result(time.perf_counter())
        elif message.msgtype == "ERROR":
            super()._take(message)

    async def move(self, name, value):
        """Return the seconds from a slider's value sent to its patches received."""
        if not self.connected:
            raise Lost("not connected")
        event = {
            "kind": "ModelChanged",
            "model": {"id": self._sliders[name]},
            "attr": "value",
            "new": value,
        }
        message = patch_doc(patch_doc.create_header(), {}, {"events": [event]})
        done = self._waiting[message.header["msgid"]] = asyncio.get_running_loop().create_future()
        start = time.perf_counter()
        await message.send(self._wire)
        return await asyncio.wait_for(done, PATIENCE) - start


async def move_floor(origins, count, seconds):
    """Have users of the bare page move once a second, staggered; return what they met."""
    users = [FloorUser(origins[number % len(origins)], "/floor") for number in range(count)]
    for user in users:
        await user.open()
    found = Moves()

    async def take_turns(user, number):
        start = asyncio.get_running_loop().time() + number / count
        for turn in range(seconds):
            await asyncio.sleep(max(0.0, start + turn - asyncio.get_running_loop().time()))
            name = SLIDERS[(number + turn) % len(SLIDERS)]
            value = values(name, COUNT)[(5 * number + turn) % COUNT]
            found.moved.append(await user.move(name, value))

    await asyncio.gather(*(take_turns(user, number) for number, user in enumerate(users)))
    await asyncio.gather(*(user.close() for user in users))
    return found
