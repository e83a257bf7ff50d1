"""Where in a file something stands, for the message of an error."""

from __future__ import annotations

import re

__all__ = ["RotorFileError", "lines_of_json", "lines_of_toml"]

_HEADER = re.compile(r"\s*(\[\[?)\s*([^\[\]\n]{1,120}?)\s*\]\]?\s*(?:#.*)?$")
_KEY = re.compile(r"\s*\"?([\w-]{1,60})\"?\s*=")
_MEMBER = re.compile(r"(\s*)\"((?:[^\"\\]|\\.){1,120})\"\s*:")


class RotorFileError(ValueError):
    """A file that is no rotor; the message is one line and says where in the file."""


def lines_of_toml(text: str) -> dict[str, int]:
    """Return the number of the line of every table and key, in the usual way of writing TOML.

    A key is named as "load.start" and, in the second of several tables [[disks]], as
    "disks[1].mass".
    """
    found: dict[str, int] = {}
    counts: dict[str, int] = {}
    table = ""
    for number, line in enumerate(text.splitlines(), 1):
        if header := _HEADER.match(line):
            table = header[2].replace('"', "")
            if header[1] == "[[":
                counts[table] = counts.get(table, -1) + 1
                table = f"{table}[{counts[table]}]"
            found.setdefault(table, number)
        elif key := _KEY.match(line):
            found.setdefault(f"{table}.{key[1]}" if table else key[1], number)
    return found


def lines_of_json(text: str) -> dict[str, int]:
    """Return the number of the line of every member and of the members in it, one a line."""
    found: dict[str, int] = {}
    path: list[tuple[int, str]] = []
    for number, line in enumerate(text.splitlines(), 1):
        if member := _MEMBER.match(line):
            indent = len(member[1])
            path = [step for step in path if step[0] < indent][:3]
            path.append((indent, member[2]))
            found.setdefault(".".join(name for _, name in path), number)
    return found
