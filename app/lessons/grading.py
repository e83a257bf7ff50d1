"""The answers of questions, computed when asked for, and the grade of a student's answer."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from rotorstab._tolerances import DECIMAL_ROUNDING

from ..reading.numbers import TwoReadings, read_number
from ..reading.user_error import UserError
from ..words.refusals import user_message
from ..words.typography import with_unit
from .evaluation import evaluate
from .expressions import DEFAULT_CASE, Values
from .format import Lesson, Step
from .markdown import plain
from .questions import Question, case_inputs

__all__ = ["Grade", "Unanswerable", "grade", "number_text", "solution", "unanswerable"]

_LONGEST = 40
_NOT_A_NUMBER = "Write a number only, without unit, like 1.25."
_NOT_YET = "Choose an answer first."
_OTHERWISE = "Reached, but with other sliders than this step’s: leave those as they were."


class Unanswerable(ValueError):
    """A question that the solver has no answer to, with these parameters."""


@dataclass(frozen=True)
class Grade:
    """The grade of a student's answer.

    Parameters
    ----------
    right : bool
    words : str
        What the student reads, HTML.
    counted : bool
        Whether it counts as an attempt; what is no number does not.
    """

    right: bool
    words: str
    counted: bool = True


def number_text(value: float) -> str:
    """Return a number as the page writes it."""
    if math.isinf(value):
        return "∞" if value > 0 else "−∞"
    return f"{value:.4g}".replace("-", "−")


def _values(step: Step, after: Mapping[str, Any] | None = None) -> Values:
    """Return a function for quantities at a step's cases; `after` replaces the inputs after Try."""

    def value(name: str, case: str) -> float:
        load = None
        if case == "before":
            inputs: Mapping[str, Any] = step.before
        elif case == DEFAULT_CASE:
            inputs = step.after if after is None else after
        else:
            inputs, load = case_inputs(step.question.cases[case], step.after)
        return evaluate(name, inputs, load)

    return value


def solution(step: Step) -> float | int | None:
    """Return the number of a question, the index of its right choice, None for a goal.

    Raises
    ------
    Unanswerable
        If the solver has no number, not exactly one choice holds, or the step's own Try does
        not reach the goal.
    """
    try:
        return _solution(step.question, _values(step))
    except Unanswerable:
        raise
    except ValueError as error:
        raise Unanswerable(str(error)) from None


def _solution(question: Question, values: Values) -> float | int | None:
    if question.answer:
        value = question.answer.value(values)
        if not math.isfinite(value):
            raise Unanswerable("the solver has no number for this answer")
        if question.range and not question.range[0] <= value <= question.range[1]:
            raise Unanswerable(f"the answer, {number_text(value)}, is out of its range")
        return value
    if question.goal:
        if not question.goal.holds(values, question.tolerance):
            raise Unanswerable("the goal is not reached by what Try sets")
        return None
    right = [
        index
        for index, choice in enumerate(question.choices)
        if choice.when.holds(values, question.tolerance)
    ]
    if len(right) != 1:
        raise Unanswerable(f"{len(right)} choices are right, and it must be one")
    return right[0]


def unanswerable(lesson: Lesson) -> tuple[int, str] | None:
    """Return line and reason of the first question without an answer, None if all have one."""
    for step in lesson.steps:
        try:
            solution(step)
        except Unanswerable as error:
            return step.question.line, str(error)
    return None


def _number(value: Any) -> float | None:
    """Return the number of an answer, None where it is none."""
    if isinstance(value, bool):
        return None
    if isinstance(value, int | float):
        return float(value) if abs(value) < 1e300 else None
    if not isinstance(value, str) or len(value) > _LONGEST:
        return None
    try:
        return read_number(value.strip().rstrip("%"))
    except TwoReadings:
        raise
    except UserError:
        return None


def solver_answer(step: Step) -> str:
    """Return the solver's answer as HTML."""
    question, answer = step.question, solution(step)
    if question.kind == "number":
        assert answer is not None
        return f"The solver gives {with_unit(f'<b>{number_text(answer)}</b>', question.unit)}."
    if question.kind == "choice":
        assert isinstance(answer, int)
        return f"The solver’s answer: <b>{question.choices[answer].text}</b>."
    return "The sliders now stand where the goal is reached."


def grade(step: Step, value: Any, inputs: Mapping[str, Any]) -> Grade:
    """Return whether a student's answer is right, and what the student reads about it.

    Parameters
    ----------
    step : Step
    value : object
        What the browser sent: a number or its text, or a choice's index.
    inputs : mapping
        The page's inputs as the student has set them. A goal is tested with those that the step
        or its Try moves; the others count as they were when the step began.

    Raises
    ------
    Unanswerable
        If the solver has no answer.
    """
    if step.question.kind == "goal":
        return _grade_goal(step, inputs)
    answer = solution(step)
    assert answer is not None  # only a goal has no number
    try:
        number = _number(value)
    except TwoReadings as error:
        return Grade(False, str(plain(f"{error}.")), counted=False)
    if step.question.kind == "choice":
        return _grade_choice(step.question, number, answer)
    return _grade_number(step, number, answer)


def _grade_goal(step: Step, inputs: Mapping[str, Any]) -> Grade:
    question = step.question
    assert question.goal is not None
    try:
        tried = {name for name, value in step.after.items() if value != step.before[name]}
        moved = {name: inputs[name] for name in {*step.show.move, *tried}}
        if question.goal.holds(_values(step, {**step.before, **moved}), question.tolerance):
            return Grade(True, "You are there.")
        elsewhere = question.goal.holds(_values(step, inputs), question.tolerance)
    except ValueError as error:
        return Grade(False, str(plain(f"No answer: {user_message(error)}.")))
    return Grade(False, _OTHERWISE if elsewhere else question.hint)


def _grade_choice(question: Question, number: float | None, right: float) -> Grade:
    if number is None or not number.is_integer() or not 0 <= number < len(question.choices):
        return Grade(False, _NOT_YET, counted=False)
    if number == right:
        return Grade(True, "Yes.")
    return Grade(False, question.choices[int(number)].hint or question.hint)


def _grade_number(step: Step, number: float | None, right: float) -> Grade:
    question = step.question
    if number is None:
        return Grade(False, _NOT_A_NUMBER, counted=False)
    if question.range and not question.range[0] <= number <= question.range[1]:
        low, high = map(number_text, question.range)
        return Grade(False, f"A number from {low} to {high}, please.", counted=False)
    allowed = question.tolerance * (abs(right) if question.relative else 1.0)
    # a number at the very edge of the tolerance is right, whatever rounding adds
    if abs(number - right) <= allowed * (1 + DECIMAL_ROUNDING):
        return Grade(True, f"Yes. {solver_answer(step)}")
    return Grade(False, question.hint)
