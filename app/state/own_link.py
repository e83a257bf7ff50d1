"""The rotor of the page Your rotor in an address: its file, compressed."""

from __future__ import annotations

import base64
import binascii
import zlib
from collections.abc import Mapping, Sequence
from functools import lru_cache

from rotorstab import Rotor
from rotorstab.rotors.rotor_file import rotor_to_toml

from .own_file import OpenedRotor, open_rotor

__all__ = ["OWN_KEY", "packed", "packed_of", "unpacked"]

OWN_KEY = "own"
"""Its key in the address."""
LONGEST = 4000
"""Largest number of characters that a rotor takes in an address: some forty sections."""
_MOST_BYTES = 60_000  # of the file that an address holds
_UNREADABLE = "the rotor of this link cannot be read: it was cut, or changed"


@lru_cache(maxsize=64)
def packed(rotor: Rotor) -> str:
    """Return a rotor as a text for an address, empty if it is too large for one."""
    data = zlib.compress(rotor_to_toml(rotor).encode(), 9)
    text = base64.urlsafe_b64encode(data).decode().rstrip("=")
    return text if len(text) <= LONGEST else ""


def packed_of(arguments: Mapping[str, Sequence[bytes | str]]) -> str:
    """Return the text of a rotor in an address, empty where there is none that can be one."""
    found = arguments.get(OWN_KEY, ())
    if len(found) != 1:
        return ""
    text = found[0].decode("ascii", "replace") if isinstance(found[0], bytes) else found[0]
    return text if len(text) <= LONGEST else ""


def unpacked(text: str) -> OpenedRotor:
    """Return the rotor of a text from an address; nobody vouches for it."""
    try:
        data = base64.b64decode(text + "=" * (-len(text) % 4), altchars=b"-_", validate=True)
        unpacker = zlib.decompressobj()
        found = unpacker.decompress(data, _MOST_BYTES)
    except (binascii.Error, ValueError, zlib.error):
        return OpenedRotor(None, _UNREADABLE)
    if not unpacker.eof:
        return OpenedRotor(None, _UNREADABLE)
    return open_rotor(found.decode("utf-8", "replace"))
