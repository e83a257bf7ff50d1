"""Kinds of settings: how the text of a value is read, and how a message names what is allowed."""

import os
import re
from collections.abc import Callable
from ipaddress import ip_address
from pathlib import Path
from typing import Any, NamedTuple

SHORTEST_SECRET = 32  # characters
HOST = r"([A-Za-z0-9]([A-Za-z0-9.-]{0,251}[A-Za-z0-9])?|\[[0-9A-Fa-f:.]{2,45}\])"


class Kind(NamedTuple):
    """How the text of a setting is read, and what is allowed.

    `read` raises ValueError where the text is not allowed.
    """

    read: Callable[[str], Any]
    allowed: str


def integer(lowest: int, highest: int) -> Kind:
    """Return the kind of an integer in a range."""

    def read(text: str) -> int:
        if not re.fullmatch("[0-9]{1,9}", text) or not lowest <= int(text) <= highest:
            raise ValueError
        return int(text)

    return Kind(read, f"an integer from {lowest} to {highest}")


def choice(*words: str) -> Kind:
    """Return the kind of a setting that has one of these words as its value."""
    return Kind(lambda text: words[words.index(text)], f"one of {', '.join(words)}")


def sequence(pattern: str, allowed: str) -> Kind:
    """Return the kind of several texts that match a pattern, separated by commas or spaces."""

    def read(text: str) -> tuple[str, ...]:
        values = tuple(value for value in re.split(r"[,\s]+", text) if value)
        if not all(re.fullmatch(pattern, value) for value in values):
            raise ValueError
        return values

    return Kind(read, allowed)


def existing_path(is_right: Callable[[Path], bool], allowed: str) -> Kind:
    """Return the kind of a path that exists and can be read; an empty text means no path."""

    def read(text: str) -> str:
        if text and not (is_right(Path(text)) and os.access(text, os.R_OK)):
            raise ValueError
        return text

    return Kind(read, allowed)


def _secret(text: str) -> str:
    if text and len(text) < SHORTEST_SECRET:
        raise ValueError
    return text


def _prefix(text: str) -> str:
    if not re.fullmatch("((/[A-Za-z0-9_~-][A-Za-z0-9_.~-]*)*)/?", text):
        raise ValueError
    return text.rstrip("/")


ADDRESS = Kind(lambda text: str(ip_address(text)), "an IP address")
FILE = existing_path(Path.is_file, "a file that can be read")
FOLDER = existing_path(Path.is_dir, "a folder that can be read")
ORIGINS = sequence(
    HOST + "(:[0-9]{1,5})?", "host or host:port as browsers write it, comma-separated"
)
PATH = Kind(str, "a path")
PORT = integer(1, 65535)
PREFIX = Kind(_prefix, "empty or a path such as /rotorstab")
SECRET = Kind(_secret, f"at least {SHORTEST_SECRET} characters")
UPSTREAM = sequence("[A-Za-z0-9_.-]+:[0-9]{1,5}", "host:port, comma-separated")
