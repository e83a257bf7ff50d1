"""A lesson's file: TOML between +++ lines, then Markdown with steps; see docs/lessons.md."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from markdown_it.token import Token

from ..state import State
from .markdown import inline, render, tokens
from .quantities import find
from .questions import Question, case_inputs, read_question
from .tables import LessonError, Table, set_inputs

__all__ = ["LONGEST_FILE", "Lesson", "Step", "parse"]

LONGEST_FILE = 100_000  # characters
_MOST_STEPS = 30
_PARTS = ("predict", "try", "see")
_BLOCKS = ("set", "question", "show")
_CHARTS = ("instability", "load-frequency", "campbell", "inspector")


@dataclass(frozen=True)
class Step:
    """One predict, try, see; its texts are HTML.

    Parameters
    ----------
    before, after : mapping
        Every input of `State` when the step begins, and after its Try.
    look, move, given, watch : tuple of str
        Charts to look at, inputs to move, quantities shown with Predict and with Try.
    cover : bool
        Whether the charts to look at are covered until the question is answered.
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


@dataclass
class _Draft:
    """A step while its blocks are gathered."""

    title: str
    line: int
    parts: dict[str, list[Token]] = field(default_factory=dict)
    entry: list[tuple[dict[str, Any], Table]] = field(default_factory=list)
    attempt: list[tuple[dict[str, Any], Table]] = field(default_factory=list)
    question: tuple[dict[str, Any], Table] | None = None
    show: tuple[dict[str, Any], Table] | None = None


def _list(values: Mapping[str, Any], key: str, table: Table) -> tuple[str, ...]:
    value = values.get(key, [])
    names = [value] if isinstance(value, str) else value
    if not isinstance(names, list) or len(names) > 8:
        raise table.error(key, f"{key} must be a list of up to eight names")
    for name in names:
        if not isinstance(name, str):
            raise table.error(key, f"{key} must be a list of names")
        known = {
            "look": lambda one: one in _CHARTS,
            "move": lambda one: one in State().inputs(),
            "given": lambda one: find(one) is not None,
            "watch": lambda one: find(one) is not None,
        }[key](name)
        if not known:
            raise table.error(key, f"{key}: there is no {name[:60]!r}")
    return tuple(names)


def _flag(values: Mapping[str, Any], key: str, table: Table) -> bool:
    value = values.get(key, False)
    if not isinstance(value, bool):
        raise table.error(key, f"{key} must be true or false")
    return value


def _front(lines: list[str]) -> tuple[Table, int]:
    """Return the front matter and the number of the line after it."""
    if not lines or lines[0].strip() != "+++":
        raise LessonError(1, "the file must begin with a line +++")
    for number, line in enumerate(lines[1:], 1):
        if line.strip() == "+++":
            return Table("\n".join(lines[1:number]), 2), number + 1
    raise LessonError(1, "the parameters have no closing line +++")


def _drafts(text: str, offset: int) -> tuple[list[Token], list[_Draft]]:
    """Return the blocks of the introduction and of every step."""
    intro: list[Token] = []
    drafts: list[_Draft] = []
    into = intro
    blocks = tokens(text)
    index = 0
    while index < len(blocks):
        block = blocks[index]
        line = offset + (block.map[0] if block.map else 0) + 1
        if block.type == "heading_open" and block.level == 0 and block.tag in ("h1", "h2", "h3"):
            title = blocks[index + 1].content.strip()
            index += 3
            if block.tag == "h1":
                raise LessonError(line, "a step begins with ##; the title belongs to the top")
            if block.tag == "h2":
                if not title or len(title) > 200:
                    raise LessonError(line, "a step needs a title of up to 200 characters")
                if len(drafts) >= _MOST_STEPS:
                    raise LessonError(line, f"more than {_MOST_STEPS} steps")
                drafts.append(_Draft(title, line))
                continue
            part = title.lower()
            if not drafts or part not in _PARTS or part in drafts[-1].parts:
                raise LessonError(line, "a step has the parts ### Predict, ### Try, ### See, once")
            into = drafts[-1].parts[part] = []
            continue
        index += 1
        if block.type == "fence" and block.info.strip() in _BLOCKS and block.level == 0:
            if not drafts:
                raise LessonError(line, f"a {block.info.strip()} block belongs into a step")
            _gather(drafts[-1], block.info.strip(), Table(block.content, line + 1))
            continue
        if drafts and not drafts[-1].parts:
            raise LessonError(line, "a step's text belongs under ### Predict, ### Try or ### See")
        into.append(block)
    return intro, drafts


def _gather(draft: _Draft, kind: str, table: Table) -> None:
    values = table.read()
    if kind == "set":
        (draft.attempt if "try" in draft.parts else draft.entry).append((values, table))
    elif kind == "question":
        if draft.question:
            raise LessonError(table.line, "a step has one question")
        draft.question = values, table
    else:
        if draft.show:
            raise LessonError(table.line, "a step has one show block")
        table.only(values, ("look", "move", "given", "watch", "cover"), "a show block")
        draft.show = values, table


def _step(draft: _Draft, on: Mapping[str, Any]) -> Step:
    for part in _PARTS:
        if part not in draft.parts:
            raise LessonError(draft.line, f"this step has no part ### {part.capitalize()}")
    if draft.question is None:
        raise LessonError(draft.line, "this step has no question")
    here = Table("", draft.line)
    before = dict(on)
    for values, table in draft.entry:
        before = set_inputs(values, before, table)
    after = before
    for values, table in draft.attempt:
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
        has_set=bool(draft.attempt),
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
    title = table.line_of_text(front, "title")
    summary = table.line_of_text(front, "summary")
    minutes = front.get("minutes", 10)
    if isinstance(minutes, bool) or not isinstance(minutes, int) or not 1 <= minutes <= 240:
        raise table.error("minutes", "minutes must be a whole number from 1 to 240")
    parameters = front.get("parameters", {})
    if not isinstance(parameters, dict):
        raise table.error("parameters", "parameters must be a table")
    inputs = set_inputs(parameters, State().inputs(), table)
    intro, drafts = _drafts("\n".join(lines[start:]), start)
    if not drafts:
        raise LessonError(start, "the lesson has no step: a line that begins with ##")
    steps = []
    for draft in drafts:
        step = _step(draft, inputs)
        steps.append(step)
        inputs = dict(step.after)
    return Lesson(key, title, summary, minutes, render(intro), tuple(steps))
