"""Reads the formulas that lessons give as answers. They are parsed and never executed as code.

    term        a number, or the name of a quantity, with or without a case: `whirl.1F@before`
    expression  a term, or two terms with + - * / between them
    condition   two expressions with < > = between them

Spaces separate the words: the + in `tongue.1B+1F.centre` is part of the name.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass

from ..reading.user_error import UserError
from .quantities import find

__all__ = ["Condition", "Expression", "Term", "read_condition", "read_expression"]

DEFAULT_CASE = "after"
"""The case of a quantity without one: the inputs after the step's Try."""
_LONGEST = 200  # characters
_NUMBER = re.compile(r"[-+]?\d{1,9}(\.\d{1,9})?")
_CASE = re.compile(r"[a-z][a-z0-9_]{0,30}")
_NOTHING = 1e-9  # difference below which two numbers near 0 are equal

Values = Callable[[str, str], float]
"""Returns the value of a quantity from its name and case."""


@dataclass(frozen=True)
class Term:
    """A number, or a quantity at a case."""

    name: str
    case: str = DEFAULT_CASE
    number: float = math.nan

    def value(self, values: Values) -> float:
        """Return the value of the term."""
        return values(self.name, self.case) if self.name else self.number


@dataclass(frozen=True)
class Expression:
    """One term, or two terms with an operator between them."""

    first: Term
    operator: str = ""
    second: Term | None = None

    @property
    def terms(self) -> tuple[Term, ...]:
        """The one or two terms."""
        return (self.first,) if self.second is None else (self.first, self.second)

    def value(self, values: Values) -> float:
        """Return the value of the expression; NaN for a division by zero."""
        first = self.first.value(values)
        if self.second is None:
            return first
        second = self.second.value(values)
        if self.operator == "+":
            return first + second
        if self.operator == "-":
            return first - second
        if self.operator == "*":
            return first * second
        return first / second if second else math.nan


@dataclass(frozen=True)
class Condition:
    """Two expressions with <, > or = between them."""

    left: Expression
    relation: str
    right: Expression

    @property
    def terms(self) -> tuple[Term, ...]:
        """The terms of both sides."""
        return (*self.left.terms, *self.right.terms)

    def holds(self, values: Values, tolerance: float) -> bool:
        """Whether the comparison is true.

        Sides that differ by less than `tolerance` times the larger one are equal.

        Raises
        ------
        UserError
            If a side has no value.
        """
        left, right = self.left.value(values), self.right.value(values)
        if math.isnan(left) or math.isnan(right):
            raise UserError("a side of the comparison has no value")
        larger = max(abs(left), abs(right))
        equal = left == right or abs(left - right) <= max(tolerance * larger, _NOTHING)
        if self.relation == "=":
            return equal
        return not equal and (left > right if self.relation == ">" else left < right)


def _term(word: str) -> Term:
    if _NUMBER.fullmatch(word):
        return Term("", number=float(word))
    name, at, case = word.partition("@")
    if find(name) is None:
        raise UserError(f"there is no quantity {name[:60]!r}")
    if at and not _CASE.fullmatch(case):
        raise UserError(f"{case[:60]!r} is no name of a case")
    return Term(name, case or DEFAULT_CASE)


def _words(text: str) -> list[str]:
    if len(text) > _LONGEST:
        raise UserError(f"longer than {_LONGEST} characters")
    return text.replace("−", "-").split()


def _expression(words: list[str]) -> Expression:
    if len(words) == 1:
        return Expression(_term(words[0]))
    if len(words) == 3 and words[1] in "+-*/":
        return Expression(_term(words[0]), words[1], _term(words[2]))
    raise UserError(
        f"{' '.join(words)[:60]!r} must be one quantity, or two with + - * / and spaces between"
    )


def read_expression(text: str) -> Expression:
    """Return the expression of a text; UserError says what is wrong with it."""
    return _expression(_words(text))


def read_condition(text: str) -> Condition:
    """Return the condition of a text; UserError says what is wrong with it."""
    words = _words(text)
    places = [index for index, word in enumerate(words) if word in ("<", ">", "=")]
    if len(places) != 1:
        raise UserError(f"{text[:60]!r} must compare two sides with one of < > =")
    (place,) = places
    return Condition(_expression(words[:place]), words[place], _expression(words[place + 1 :]))
