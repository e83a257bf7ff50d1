"""A view that is described outside the browser: a link, its query, or a rotor file."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path
from urllib.parse import parse_qs, urlsplit

from rotorstab.charts.sheet import Sheet

from ..pages.explore import Explore
from ..state import State
from ..state.address import from_arguments, named_problems, pins_from_arguments, to_query
from ..state.rotor_file import LARGEST_FILE, read_rotor_file
from ..words.refusals import user_message
from .picture import view_sheet
from .report import page_address

__all__ = ["described_sheet"]

_MOST_KEYS = 100
_LONGEST_SHOWN = 60


def described_sheet(text: str) -> Sheet:
    """Return the Explore view that a text describes, as a sheet.

    Parameters
    ----------
    text : str
        A link as *Copy link* gives it, the query of one, or the path of a rotor file, which ends
        in .toml. What a query leaves out has its default.

    Raises
    ------
    ValueError
        With one line for the user, where any part of the text is not understood or out of range,
        or where these inputs have no answer.
    OSError
        Where the rotor file cannot be read.
    """
    address, query, state = "", "", State()
    if text.casefold().endswith(".toml"):
        _read_file(text, state)
    else:
        address, query = _split(text)
    page = Explore()
    _read_query(query, state, page)
    link = f"{address}?{to_query(state.inputs(), page.pin_inputs())}"
    while (problem := page.restore_next_pin()) is not None:
        if problem:
            raise ValueError(f"a pin of the link has no answer: {problem}")
    try:
        while (need := page.need(state)) is not None:
            need.keep(need.function(*need.arguments))
        return view_sheet(page, state, link)
    except ValueError as error:
        raise ValueError(user_message(error)) from error


def _split(text: str) -> tuple[str, str]:
    """Return the address and the query of a link; a bare query has no address."""
    if "://" not in text:
        return "", text.removeprefix("?")
    with suppress(ValueError):  # of an address that is none
        parts = urlsplit(text)
        address = page_address(f"{parts.scheme}://{parts.netloc}{parts.path}")
        if address:
            return address, parts.query
    raise ValueError(f"{text[:_LONGEST_SHOWN]!r} is not a link to the dashboard")


def _read_query(query: str, state: State, page: Explore) -> None:
    """Set the inputs and the pins of a query; refuse it if any part of it is not understood."""
    if not query:
        return
    try:
        arguments = parse_qs(
            query, keep_blank_values=True, strict_parsing=True, max_num_fields=_MOST_KEYS
        )
    except ValueError:
        raise ValueError(
            f"{query[:_LONGEST_SHOWN]!r} is neither a link, nor a query such as as=0.5&spin=2, "
            "nor a rotor file that ends in .toml"
        ) from None
    values, doubtful = from_arguments(arguments)
    refused = state.change(values)
    pins, bad_pins = pins_from_arguments(arguments, state.inputs())
    if problems := named_problems([*doubtful, *bad_pins], refused):
        raise ValueError(f"the link is not understood: {problems}")
    page.set_address_pins(pins)


def _read_file(path: str, state: State) -> None:
    """Set the inputs of a rotor file; refuse it if it sets one out of range."""
    with Path(path).open("rb") as file:
        data = file.read(LARGEST_FILE + 1)
    try:
        values, left_out = read_rotor_file(data.decode("utf-8-sig"))
    except UnicodeDecodeError:
        raise ValueError(f"{path} is not a text in UTF-8") from None
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None
    if left_out:
        raise ValueError(f"{path}: {'; '.join(left_out)}")
    state.change(values)
