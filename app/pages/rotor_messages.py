"""Answers to what the browser asks about the shaft in SI and rotor files."""

from __future__ import annotations

from base64 import b64encode

from ..reading.user_error import UserError
from ..state import SYMBOLS, State
from ..state.rotor_file import read_rotor_file, write_rotor_file
from .base import Reply

__all__ = ["open_rotor_file", "save_rotor_file", "use_shaft"]


def use_shaft(state: State) -> Reply:
    """Set the non-dimensional inputs from the shaft in SI."""
    errors = state.use_shaft()
    problem = "; ".join(f"{SYMBOLS.get(name, name)} {reason}" for name, reason in errors.items())
    return Reply({"shaft_error": problem})


def save_rotor_file(state: State) -> Reply:
    """Return the inputs as a rotor file to download."""
    data = b64encode(write_rotor_file(state).encode()).decode()
    name = "rotor.toml"
    file = {"name": name, "mime": "application/toml", "base64": data}
    return Reply({"file": file, "toast": f"{name} is ready", "shaft_error": ""})


def open_rotor_file(text: object, state: State) -> Reply:
    """Set the inputs from a rotor file; a bad file leaves every input as it was."""
    try:
        values, left_out = read_rotor_file(text if isinstance(text, str) else "")
    except UserError as error:
        return Reply({"shaft_error": str(error), "toast": "the rotor file was refused"})
    state.change(values)
    if left_out:
        notice = f"The rotor was taken, but not {'; '.join(left_out)}."
        return Reply({"shaft_notice": notice, "toast": "the rotor file was taken in part"})
    return Reply({"shaft_error": "", "toast": "the rotor file is open"})
