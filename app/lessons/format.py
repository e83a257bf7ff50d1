"""A lesson's file: TOML between +++ lines, then Markdown with steps; see docs/lessons.md."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ..state import State
from .drafts import PARTS, Draft, read_drafts
from .markdown import inline, render
from .quantities import find
from .questions import Question, case_inputs, read_question
from .tables import LessonError, Table, set_inputs

__all__ = ["LONGEST_FILE", "Lesson", "Step", "parse"]

LONGEST_FILE = 100_000
"""Largest number of characters of a lesson's file."""
_CHARTS = ("instability", "load-frequency", "campbell", "inspector")


@dataclass(frozen=True)
class Step:
    """One step of a lesson: Predict, Try and See.

    Parameters
    ----------
    title, predict, try_, see : str
        HTML.
    question : Question
    before, after : mapping
        Every input of `State` when the step begins, and after its Try.
    has_set : bool
        Whether Try sets any inputs.
    look : tuple of str
        Charts to look at.
    move : tuple of str
        Inputs that the student moves.
    given, watch : tuple of str
        Quantities shown with Predict, and with Try.
    cover : bool
        Whether the charts to look at are covered until the question is answered.
    line : int
        Of the file, where the step begins.
    """

    title: str
    predict: str
    question: Question
    try_: str
    see: str
    before: Mapping[str, Any]
    after: Mapping[str, Any]
    has_set: bool
    look: tuple[str, ...]
    move: tuple[str, ...]
    given: tuple[str, ...]
    watch: tuple[str, ...]
    cover: bool
    line: int


@dataclass(frozen=True)
class Lesson:
    """A lesson as it is shown."""

    key: str
    title: str
    summary: str
    minutes: int
    intro: str
    steps: tuple[Step, ...]


def _list(values: Mapping[str, Any], key: str, table: Table) -> tuple[str, ...]:
    value = values.get(key, [])
    names = [value] if isinstance(value, str) else value
    if not isinstance(names, list) or len(names) > 8:
        raise table.error(key, f"{key} must be a list of up to eight names")
    for name in names:
        if not isinstance(name, str):
            raise table.error(key, f"{key} must be a list of names")
        if not _is_known(key, name):
            raise table.error(key, f"{key}: there is no {name[:60]!r}")
    return tuple(names)


def _is_known(key: str, name: str) -> bool:
    """Whether a name can stand in a list of a show block."""
    if key == "look":
        return name in _CHARTS
    if key == "move":
        return name in State().inputs()
    return find(name) is not None


def _flag(values: Mapping[str, Any], key: str, table: Table) -> bool:
    value = values.get(key, False)
    if not isinstance(value, bool):
        raise table.error(key, f"{key} must be true or false")
    return value


def _front(lines: list[str]) -> tuple[Table, int]:
    """Return the front matter and the number of lines that it takes."""
    if not lines or lines[0].strip() != "+++":
        raise LessonError(1, "the file must begin with a line +++")
    for number, line in enumerate(lines[1:], 1):
        if line.strip() == "+++":
            return Table("\n".join(lines[1:number]), 2), number + 1
    raise LessonError(1, "the parameters have no closing line +++")


def _step(draft: Draft, on: Mapping[str, Any]) -> Step:
    for part in PARTS:
        if part not in draft.parts:
            raise LessonError(draft.line, f"this step has no part ### {part.capitalize()}")
    if draft.question is None:
        raise LessonError(draft.line, "this step has no question")
    here = Table("", draft.line)
    before = dict(on)
    for values, table in draft.before_try:
        before = set_inputs(values, before, table)
    after = before
    for values, table in draft.in_try:
        after = set_inputs(values, after, table)
    question = read_question(*draft.question)
    for case in question.cases.values():
        case_inputs(case, after, draft.question[1])
    shown, table = draft.show or ({}, here)
    return Step(
        title=inline(draft.title),
        predict=render(draft.parts["predict"]),
        question=question,
        try_=render(draft.parts["try"]),
        see=render(draft.parts["see"]),
        before=before,
        after=after,
        has_set=bool(draft.in_try),
        look=_list(shown, "look", table),
        move=_list(shown, "move", table),
        given=_list(shown, "given", table),
        watch=_list(shown, "watch", table),
        cover=_flag(shown, "cover", table),
        line=draft.line,
    )


def parse(text: str, key: str) -> Lesson:
    """Return the lesson of a file's text.

    Parameters
    ----------
    text : str
    key : str
        The file's name without its ending: the lesson's place in an address.

    Raises
    ------
    LessonError
        With the line and the reason.
    """
    if len(text) > LONGEST_FILE:
        raise LessonError(1, f"the file is longer than {LONGEST_FILE} characters")
    lines = text.removeprefix("\ufeff").replace("\r\n", "\n").split("\n")
    table, start = _front(lines)
    front = table.read()
    table.only(front, ("title", "summary", "minutes", "parameters"), "the front matter")
    intro, drafts = read_drafts("\n".join(lines[start:]), start)
    if not drafts:
        raise LessonError(start, "the lesson has no step: a line that begins with ##")
    inputs = _parameters(front, table)
    steps = []
    for draft in drafts:
        step = _step(draft, inputs)
        steps.append(step)
        inputs = dict(step.after)
    return Lesson(
        key,
        table.line_of_text(front, "title"),
        table.line_of_text(front, "summary"),
        _minutes(front, table),
        render(intro),
        tuple(steps),
    )


def _minutes(front: Mapping[str, Any], table: Table) -> int:
    minutes = front.get("minutes", 10)
    if isinstance(minutes, bool) or not isinstance(minutes, int) or not 1 <= minutes <= 240:
        raise table.error("minutes", "minutes must be a whole number from 1 to 240")
    return minutes


def _parameters(front: Mapping[str, Any], table: Table) -> dict[str, Any]:
    """Return the inputs with which the first step begins."""
    parameters = front.get("parameters", {})
    if not isinstance(parameters, dict):
        raise table.error("parameters", "parameters must be a table")
    # without a marker of its own: the one that the page places would give answers away
    start = State().inputs() | {"marker": False, "marker_follows": False}
    return set_inputs(parameters, start, table)
