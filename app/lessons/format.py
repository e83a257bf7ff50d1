"""A lesson's file: TOML between +++ lines, then Markdown with steps; see docs/lessons.md."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ..state import State
from .drafts import PARTS, Draft, read_drafts
from .markdown import inline, render
from .questions import Question, case_inputs, read_question
from .show_block import Show, read_show
from .tables import LessonError, Table, set_inputs

__all__ = ["LONGEST_FILE", "Lesson", "Step", "parse"]

LONGEST_FILE = 100_000
"""Largest number of characters of a lesson's file."""


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
    show : Show
        What is on the screen, and what the student moves.
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
    show: Show
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
    return Step(
        title=inline(draft.title),
        predict=render(draft.parts["predict"]),
        question=question,
        try_=render(draft.parts["try"]),
        see=render(draft.parts["see"]),
        before=before,
        after=after,
        has_set=bool(draft.in_try),
        show=read_show(*(draft.show or ({}, here)), before, after),
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
