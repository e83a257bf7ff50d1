"""Questions of a lesson: a number, a choice, or a goal to reach on the chart."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from ..reading.user_error import UserError
from .expressions import DEFAULT_CASE, Condition, Expression, read_condition, read_expression
from .markdown import inline
from .situation import LARGEST_LOAD
from .tables import Table, set_inputs

__all__ = ["Choice", "Question", "case_inputs", "read_question"]

_PERCENT = re.compile(r"(\d{1,3}(?:\.\d{1,3})?) ?%")


@dataclass(frozen=True)
class Choice:
    """One of the answers of a choice; it is right if its condition holds."""

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
        The right number, if the question asks for one.
    choices : tuple of Choice
        Empty unless the question is a choice.
    goal : Condition or None
        What must hold for the inputs as the student has set them, if the question is a goal.
    tolerance : float
        Absolute, or a share of the answer if `relative`.
    relative : bool
    range : (float, float) or None
        Smallest and largest number that the student may give.
    unit : str
        Shown after a number.
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
        """The kind of the question: "number", "choice" or "goal"."""
        return "number" if self.answer else "goal" if self.goal else "choice"


def _tolerance(values: Mapping[str, Any], table: Table, number: bool) -> tuple[float, bool]:
    value = values.get("tolerance", "2 %" if number else "1 %")
    if isinstance(value, str) and (found := _PERCENT.fullmatch(value.strip())):
        share = float(found[1]) / 100
        if 0 < share <= 0.5:
            return share, True
    elif (
        number
        and isinstance(value, int | float)
        and not isinstance(value, bool)
        and 0 < value < 1e6
    ):
        return float(value), False
    raise table.error(
        "tolerance",
        'tolerance must be a share such as "5 %", up to 50 %'
        + (", or a number above 0" if number else ""),
    )


def _range(values: Mapping[str, Any], table: Table) -> tuple[float, float] | None:
    if "range" not in values:
        return None
    match values["range"]:
        case [int() | float() as low, int() | float() as high] if -1e6 < low < high < 1e6:
            return float(low), float(high)
    raise table.error("range", "range must be two numbers, the smaller first")


_KEYS = {
    "answer": ("ask", "hint", "answer", "tolerance", "range", "unit", "cases"),
    "choices": ("ask", "hint", "choices", "tolerance", "cases"),
    "goal": ("ask", "hint", "goal", "tolerance", "cases"),
}


def read_question(values: dict[str, Any], table: Table) -> Question:
    """Return the question of a block; LessonError names what is wrong with it and its line."""
    asked = [key for key in _KEYS if key in values]
    if len(asked) != 1:
        raise table.error("ask", "a question has one of answer, choices, goal")
    (target,) = asked
    table.only(values, _KEYS[target], "this question")
    answer, goal, choices = None, None, []
    if target == "choices":
        choices = list(_choices(values["choices"], table))
    else:
        text = table.line_of_text(values, target)
        try:
            if target == "answer":
                answer = read_expression(text)
            else:
                goal = read_condition(text)
        except UserError as error:
            raise table.error(target, f"{target}: {error}") from None
    cases = _cases(values, table)
    terms = [*(answer.terms if answer else ()), *(goal.terms if goal else ())]
    terms += [term for choice in choices for term in choice.when.terms]
    for term in terms:
        if term.case not in ("before", DEFAULT_CASE, *cases):
            raise table.error(target, f"{target}: there is no case {term.case!r}")
    tolerance, relative = _tolerance(values, table, target == "answer")
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


def _cases(values: Mapping[str, Any], table: Table) -> dict[str, Any]:
    cases = values.get("cases", {})
    if not isinstance(cases, dict) or not all(isinstance(case, dict) for case in cases.values()):
        raise table.error("cases", "cases must be tables of parameters")
    if {"before", DEFAULT_CASE} & set(cases):
        raise table.error("cases", "the cases before and after are made by the step itself")
    return cases


def _choices(entries: Any, table: Table) -> Iterator[Choice]:
    if not isinstance(entries, list) or not 2 <= len(entries) <= 8:
        raise table.error("choices", "choices must be a list of two to eight")
    for entry in entries:
        if not isinstance(entry, dict):
            raise table.error("choices", "each choice is a table with text and when")
        table.only(entry, ("text", "when", "hint"), "a choice")
        what = "a choice's "
        text = table.line_of_text(entry, "text", what=what + "text")
        when = table.line_of_text(entry, "when", what=what + "when")
        hint = table.line_of_text(entry, "hint", needed=False, what=what + "hint")
        try:
            yield Choice(inline(text), read_condition(when), inline(hint))
        except UserError as error:
            raise table.error("choices", f"choices: {error}") from None


def case_inputs(
    case: Mapping[str, Any], after: Mapping[str, Any], table: Table | None = None
) -> tuple[dict[str, Any], float | None]:
    """Return the inputs of a case, and its own static load or None.

    `after` are the inputs after Try, from which those of the case differ.
    """
    table = table or Table("", 0)
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
    return set_inputs(values, after, table), None if load is None else float(load)
