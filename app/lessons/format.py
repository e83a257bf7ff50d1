"""A lesson's file: TOML between +++ lines, then Markdown with steps. docs/lessons.md describes it."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from markdown_it.token import Token

from ..state import State
from .expressions import DEFAULT_CASE, Condition, Expression, read_condition, read_expression
from .markdown import inline, render, tokens
from .quantities import LARGEST_LOAD, find

__all__ = ["LONGEST_FILE", "Choice", "Lesson", "LessonError", "Question", "Step", "parse"]

LONGEST_FILE = 100_000  # characters
_MOST_STEPS = 30
_LONGEST_LINE = 600
_PARTS = ("predict", "try", "see")
_BLOCKS = ("set", "question", "show")
_CHARTS = ("instability", "load-frequency", "campbell")
_PERCENT = re.compile(r"(\d{1,3}(?:\.\d{1,3})?) ?%")


class LessonError(ValueError):
    """What is wrong with a lesson's file, and in which line."""

    def __init__(self, line: int, reason: str) -> None:
        super().__init__(f"line {line}: {reason}")
        self.line = line
        self.reason = reason


@dataclass(frozen=True)
class Choice:
    """One answer to choose; it is right if its condition holds."""

    text: str
    when: Condition
    hint: str = ""


@dataclass(frozen=True)
class Question:
    """A question of one of three kinds: a number, a choice, or a goal to reach on the chart.

    Parameters
    ----------
    ask, hint : str
        HTML.
    answer : Expression or None
        Of a number.
    choices : tuple of Choice
        Of a choice.
    goal : Condition or None
        Of a goal: it must hold for the inputs as the student has set them.
    tolerance : float
        Absolute, or a share if `relative`.
    range : (float, float) or None
        Of a number that is sensible.
    unit : str
        Shown behind a number.
    cases : mapping
        Inputs that differ from those after Try, by the case's name.
    line : int
        Where it stands in the file.
    """

    ask: str
    hint: str
    answer: Expression | None
    choices: tuple[Choice, ...]
    goal: Condition | None
    tolerance: float
    relative: bool
    range: tuple[float, float] | None
    unit: str
    cases: Mapping[str, Mapping[str, Any]]
    line: int

    @property
    def kind(self) -> str:
        """What sort of question it is."""
        return "number" if self.answer else "goal" if self.goal else "choice"


@dataclass(frozen=True)
class Step:
    """One predict, try, see; its texts are HTML.

    Parameters
    ----------
    before, after : mapping
        Every input of `State` when the step begins, and after its Try.
    look, move, given, watch : tuple of str
        Charts to look at, inputs to move, quantities shown with Predict and with Try.
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
    entry: list[tuple[dict[str, Any], _Table]] = field(default_factory=list)
    attempt: list[tuple[dict[str, Any], _Table]] = field(default_factory=list)
    question: tuple[dict[str, Any], _Table] | None = None
    show: tuple[dict[str, Any], _Table] | None = None


@dataclass(frozen=True)
class _Table:
    """A piece of TOML and where it stands, to name the line of a fault."""

    text: str
    line: int  # of its first line

    def read(self) -> dict[str, Any]:
        try:
            return tomllib.loads(self.text)
        except tomllib.TOMLDecodeError as error:
            found = re.search(r"at line (\d+)", str(error))
            at = int(found[1]) - 1 if found else self.text.count("\n")
            reason = re.sub(r" \(at .*\)$", "", str(error))
            raise LessonError(self.line + at, f"TOML: {reason[:200]}") from None
        except (ValueError, RecursionError) as error:
            raise LessonError(self.line, f"TOML: {str(error)[:200]}") from None

    def where(self, key: str) -> int:
        for number, line in enumerate(self.text.splitlines()):
            if re.match(rf"\s*\[*\s*{re.escape(key)}\b", line):
                return self.line + number
        return self.line

    def error(self, key: str, reason: str) -> LessonError:
        return LessonError(self.where(key), reason)

    def only(self, values: Mapping[str, Any], allowed: tuple[str, ...], what: str) -> None:
        for key in values:
            if key not in allowed:
                raise self.error(key, f"{what} has no {key[:40]!r}; known: {', '.join(allowed)}")

    def line_of_text(
        self, values: Mapping[str, Any], key: str, needed: bool = True, what: str = ""
    ) -> str:
        value = values.get(key, None if needed else "")
        if not isinstance(value, str) or (needed and not value.strip()):
            raise self.error(key, f"{what or key} must be a text")
        if len(value) > _LONGEST_LINE:
            raise self.error(key, f"{what or key} is longer than {_LONGEST_LINE} characters")
        return value.strip()


def _inputs(given: Mapping[str, Any], on: Mapping[str, Any], table: _Table) -> dict[str, Any]:
    """Return all inputs after some were set; what the page would refuse is an error."""
    state = State(**on)
    refused = state.change(given)
    if refused:
        name, why = next(iter(refused.items()))
        raise table.error(name, f"{name}: {why}")
    return state.inputs()


def _tolerance(values: Mapping[str, Any], table: _Table, number: bool) -> tuple[float, bool]:
    value = values.get("tolerance", "2 %" if number else "1 %")
    if isinstance(value, str) and (found := _PERCENT.fullmatch(value.strip())):
        share = float(found[1]) / 100
        if 0 < share <= 0.5:
            return share, True
    elif number and isinstance(value, int | float) and not isinstance(value, bool):
        if 0 < value < 1e6:
            return float(value), False
    raise table.error(
        "tolerance",
        'tolerance must be a share such as "5 %", up to 50 %'
        + (", or a number above 0" if number else ""),
    )


def _range(values: Mapping[str, Any], table: _Table) -> tuple[float, float] | None:
    if "range" not in values:
        return None
    match values["range"]:
        case [int() | float() as low, int() | float() as high] if -1e6 < low < high < 1e6:
            return float(low), float(high)
    raise table.error("range", "range must be two numbers, the smaller first")


def _question(values: dict[str, Any], table: _Table) -> Question:
    kinds = [key for key in ("answer", "choices", "goal") if key in values]
    if len(kinds) != 1:
        raise table.error("ask", "a question has one of answer, choices, goal")
    (kind,) = kinds
    allowed = {
        "answer": ("ask", "hint", "answer", "tolerance", "range", "unit", "cases"),
        "choices": ("ask", "hint", "choices", "tolerance", "cases"),
        "goal": ("ask", "hint", "goal", "tolerance", "cases"),
    }[kind]
    table.only(values, allowed, "this question")
    answer, goal, choices = None, None, []
    try:
        if kind == "answer":
            answer = read_expression(table.line_of_text(values, "answer"))
        elif kind == "goal":
            goal = read_condition(table.line_of_text(values, "goal"))
    except LessonError:
        raise
    except ValueError as error:
        raise table.error(kind, f"{kind}: {error}") from None
    if kind == "choices":
        choices = list(_choices(values["choices"], table))
    cases = values.get("cases", {})
    if not isinstance(cases, dict) or not all(isinstance(one, dict) for one in cases.values()):
        raise table.error("cases", "cases must be tables of parameters")
    if {"before", DEFAULT_CASE} & set(cases):
        raise table.error("cases", "the cases before and after are made by the step itself")
    used = [*(answer.terms if answer else ()), *(goal.terms if goal else ())]
    used += [term for one in choices for term in one.when.terms]
    for term in used:
        if term.case not in ("before", DEFAULT_CASE, *cases):
            raise table.error(kind, f"{kind}: there is no case {term.case!r}")
    tolerance, relative = _tolerance(values, table, kind == "answer")
    return Question(
        ask=inline(table.line_of_text(values, "ask")),
        hint=inline(table.line_of_text(values, "hint")),
        answer=answer,
        choices=tuple(choices),
        goal=goal,
        tolerance=tolerance,
        relative=relative,
        range=_range(values, table),
        unit=inline(table.line_of_text(values, "unit", needed=False)),
        cases=cases,
        line=table.line,
    )


def _choices(given: Any, table: _Table) -> Iterator[Choice]:
    if not isinstance(given, list) or not 2 <= len(given) <= 8:
        raise table.error("choices", "choices must be a list of two to eight")
    for one in given:
        if not isinstance(one, dict):
            raise table.error("choices", "each choice is a table with text and when")
        table.only(one, ("text", "when", "hint"), "a choice")
        what = "a choice's "
        text = table.line_of_text(one, "text", what=what + "text")
        when = table.line_of_text(one, "when", what=what + "when")
        hint = table.line_of_text(one, "hint", needed=False, what=what + "hint")
        try:
            yield Choice(inline(text), read_condition(when), inline(hint))
        except ValueError as error:
            raise table.error("choices", f"choices: {error}") from None


def _list(values: Mapping[str, Any], key: str, table: _Table) -> tuple[str, ...]:
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


def _front(lines: list[str]) -> tuple[_Table, int]:
    """Return the front matter and the number of the line after it."""
    if not lines or lines[0].strip() != "+++":
        raise LessonError(1, "the file must begin with a line +++")
    for number, line in enumerate(lines[1:], 1):
        if line.strip() == "+++":
            return _Table("\n".join(lines[1:number]), 2), number + 1
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
            _gather(drafts[-1], block.info.strip(), _Table(block.content, line + 1))
            continue
        if drafts and not drafts[-1].parts:
            raise LessonError(line, "a step's text belongs under ### Predict, ### Try or ### See")
        into.append(block)
    return intro, drafts


def _gather(draft: _Draft, kind: str, table: _Table) -> None:
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
        table.only(values, ("look", "move", "given", "watch"), "a show block")
        draft.show = values, table


def _step(draft: _Draft, on: Mapping[str, Any]) -> Step:
    for part in _PARTS:
        if part not in draft.parts:
            raise LessonError(draft.line, f"this step has no part ### {part.capitalize()}")
    if draft.question is None:
        raise LessonError(draft.line, "this step has no question")
    here = _Table("", draft.line)
    before = dict(on)
    for values, table in draft.entry:
        before = _inputs(values, before, table)
    after = before
    for values, table in draft.attempt:
        after = _inputs(values, after, table)
    question = _question(*draft.question)
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
        line=draft.line,
    )


def case_inputs(
    case: Mapping[str, Any], after: Mapping[str, Any], table: _Table | None = None
) -> tuple[dict[str, Any], float | None]:
    """Return the inputs of a case, and its own steady load if it has one."""
    table = table or _Table("", 0)
    values = dict(case)
    load = values.pop("load", None)
    if load is not None and (
        isinstance(load, bool)
        or not isinstance(load, int | float)
        or not -LARGEST_LOAD <= load <= LARGEST_LOAD
    ):
        raise table.error(
            "load", f"load must be a number from {-LARGEST_LOAD:g} to {LARGEST_LOAD:g}"
        )
    return _inputs(values, after, table), None if load is None else float(load)


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
    inputs = _inputs(parameters, State().inputs(), table)
    intro, drafts = _drafts("\n".join(lines[start:]), start)
    if not drafts:
        raise LessonError(start, "the lesson has no step: a line that begins with ##")
    steps = []
    for draft in drafts:
        step = _step(draft, inputs)
        steps.append(step)
        inputs = dict(step.after)
    return Lesson(key, title, summary, minutes, render(intro), tuple(steps))
