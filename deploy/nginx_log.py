"""nginx's messages as records of our own log, without the addresses and queries of students."""

import asyncio
import logging
import os
import re
import sys

LOG = logging.getLogger("rotorstab.nginx")
LONGEST_LINE = 1 << 20  # characters
LEVELS = {
    "emerg": logging.CRITICAL,
    "alert": logging.CRITICAL,
    "crit": logging.CRITICAL,
    "error": logging.ERROR,
    "warn": logging.WARNING,
    "notice": logging.INFO,
    "info": logging.INFO,
    "debug": logging.DEBUG,
}
LINE = re.compile(r"\S+ \S+ \[(?P<level>[a-z]+)\] \d+#\d+: (?:\*\d+ )?(?P<message>.*)")
# nginx appends these to a message in this order; `upstream`, which names the worker, stays
CLIENT = re.compile(r', (client|server|request|subrequest|host|referrer): ("[^"]*"|[^,]*)')
QUERY = re.compile(r"\?[^\s\",]*")
NUMBER = re.compile(
    r"(?<![\w/.:])(\d{1,3}(\.\d{1,3}){3}|\[?[0-9a-f]*(:[0-9a-f]*){2,7}\]?)(:\d+)?(?!\w)"
)


def without_client(message: str) -> str:
    """Return a message of nginx without the client's address, its request and every query."""
    message, upstream, worker = CLIENT.sub("", message).partition(", upstream: ")
    return NUMBER.sub("…", QUERY.sub("", message)) + upstream + QUERY.sub("", worker)


def record(line: str) -> None:
    """Log one line of nginx's standard error."""
    if line.startswith("{"):  # the access log, written as JSON without addresses and queries
        # In one piece: `print` writes the end of the line by itself where output is not buffered,
        # and a line of a worker, which shares this stream, may come between the two.
        sys.stderr.write(f"{line}\n")
        sys.stderr.flush()
        return
    match = LINE.fullmatch(line)
    if match:
        LOG.log(LEVELS.get(match["level"], logging.ERROR), "%s", without_client(match["message"]))
    elif line:
        LOG.warning("%s", without_client(line))


async def relay() -> tuple[int, asyncio.Task[None]]:
    """Return the end of a pipe to write to, and the task that logs its lines until it is closed.

    With a pipe of asyncio a process would count as running until its children close it too.
    """
    read_end, write_end = os.pipe()
    reader = asyncio.StreamReader(limit=LONGEST_LINE)
    await asyncio.get_running_loop().connect_read_pipe(
        lambda: asyncio.StreamReaderProtocol(reader), os.fdopen(read_end, "rb", buffering=0)
    )
    return write_end, asyncio.create_task(_record_all(reader))


async def _record_all(reader: asyncio.StreamReader) -> None:
    while True:
        try:
            line = await reader.readline()
        except ValueError:  # a line longer than any of nginx; the stream goes on after it
            continue
        if not line:
            return
        record(line.decode(errors="replace").rstrip())
