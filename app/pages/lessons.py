"""Lessons: the list, and the lesson that runs beside the live charts of other pages."""

from __future__ import annotations

import logging
import math
from collections.abc import Mapping
from itertools import pairwise
from typing import Any

from markupsafe import Markup

from ..lessons import Lesson, Step, Unanswerable, grade, library
from ..lessons.evaluation import evaluate
from ..lessons.grading import number_text, solver_answer
from ..lessons.markdown import plain
from ..lessons.quantities import find
from ..lessons.show_block import POINT_PARTS
from ..live.controls import ONLY_WITH, field
from ..results.limits import Detail
from ..state import SYMBOLS, State
from .base import Page, Reply

__all__ = ["Lessons", "cards", "describe"]

_LOG = logging.getLogger("rotorstab.app")
_NO_ANSWER = "The solver has no answer here. Go on with “Show me”."


def cards() -> list[dict[str, Any]]:
    """Return what the list shows of each lesson."""
    known = library()
    return [
        {
            "key": lesson.key,
            "title": plain(lesson.title),
            "summary": plain(lesson.summary),
            "minutes": lesson.minutes,
            "steps": len(lesson.steps),
            "foreign": lesson.key in known.foreign,
        }
        for lesson in known.lessons.values()
    ]


def _label(name: str) -> str:
    """Return a quantity's label as HTML."""
    found = find(name)
    assert found is not None  # the parser knows every name
    quantity, parts = found
    if name.startswith("parameter."):
        return str(plain(f"{State.param[parts[0]].label} {SYMBOLS.get(parts[0], '')}".strip()))
    return str(plain(quantity.label.format(*parts)))


def _present_value(name: str, inputs: Mapping[str, Any]) -> str:
    """Return a quantity's present value as text."""
    try:
        value = evaluate(name, inputs)
    except ValueError:
        return "—"
    if math.isnan(value):
        return "—"
    quantity, _ = find(name) or (None, ())
    if quantity is not None and quantity.flag:
        return "yes" if value else "no"
    text = number_text(value if abs(value) > 1e-9 else 0.0)
    if quantity is not None and quantity.at_factor:
        text += f" at β_d = {number_text(inputs['marker_factor'])}"
    return text


def _asked(step: Step) -> list[str]:
    """Return the quantities of the answer that the page hides, since they would give it away."""
    answer, given = step.question.answer, step.show.given
    return [term.name for term in answer.terms if term.name not in given] if answer else []


def _control(name: str, step: Step) -> dict[str, Any]:
    """Return the declaration of a control, with the step's own range and choices."""
    found, show = field(name), step.show
    if name in show.sliders:
        found |= dict(zip(("low", "high", "step"), show.sliders[name], strict=True))
    # a choice that shows another input is offered where the student may move that one, too
    closed = {
        choice
        for other, (owner, choice) in ONLY_WITH.items()
        if owner == name and other not in show.move
    } - {step.before[name], step.after[name]}
    if closed:
        found["options"] = [option for option in found["options"] if option[0] not in closed]
    return found


def _is_marked(step: Step) -> bool:
    return bool(step.before["marker"] or step.after["marker"])


def _free(step: Step) -> list[str]:
    """Return the inputs that the student may change on the charts themselves."""
    show = step.show
    # a panel of the marked point without a point asks for one
    places = not _is_marked(step) and any(part in show.look for part in POINT_PARTS)
    point = ("marker", "marker_frequency", "marker_factor") if places else ()
    return list(dict.fromkeys((*show.move, *point)))


def describe(lesson: Lesson, index: int) -> dict[str, Any]:
    """Return one step as plain values for the browser, without its answer."""
    step = lesson.steps[index]
    question = step.question
    keys = list(library().lessons)
    return {
        "key": lesson.key,
        "title": str(plain(lesson.title)),
        "number": keys.index(lesson.key) + 1 if lesson.key in keys else 0,
        "next": dict(pairwise(keys)).get(lesson.key, ""),
        "step": index,
        "titles": [str(Markup(other.title).striptags()) for other in lesson.steps],
        "intro": lesson.intro if index == 0 else "",
        "heading": step.title,
        "predict": step.predict,
        "kind": question.kind,
        "ask": question.ask,
        "choices": [choice.text for choice in question.choices],
        "unit": question.unit,
        "range": list(question.range) if question.range else None,
        "try": step.try_,
        "has_set": step.has_set,
        "see": step.see,
        "look": list(step.show.look),
        "charts": len(step.show.charts),
        "cover": list(step.show.cover),
        "move": [_control(name, step) for name in step.show.move],
        "free": _free(step),
        "marked": _is_marked(step),
        "asked": _asked(step),
        "given": [[name, _label(name)] for name in step.show.given],
        "watch": [[name, _label(name)] for name in step.show.watch],
    }


class Lessons(Page):
    """The list of lessons, and the answers of the lesson beside the charts of other pages."""

    key = "lessons"
    title = "Lessons"
    takes = frozenset({"lesson", "lesson-set", "lesson-answer", "lesson-show", "lesson-end"})

    def __init__(self) -> None:
        super().__init__()
        self._running: tuple[Lesson, int] | None = None
        self._before: dict[str, Any] = {}  # the inputs that are restored when the lesson ends

    def compute(self, state: State, detail: Detail = Detail.FULL) -> dict[str, Any]:
        """Return no charts of its own."""
        return {}

    @property
    def step(self) -> Step | None:
        """The step that is running, or None."""
        return None if self._running is None else self._running[0].steps[self._running[1]]

    @property
    def teaches(self) -> bool:
        """Whether a lesson is running."""
        return self._running is not None

    def handle(self, message: Mapping[str, Any], state: State) -> Reply:
        """Begin a step, set the inputs of its Try, grade an answer, show it, or end the lesson."""
        message_type, step = message.get("type"), self.step
        if message_type == "lesson":
            return self._begin(message, state)
        if message_type == "lesson-end":
            self._running = None
            state.change(self._before)
            self._before = {}
            return Reply()
        elif step is None:
            return Reply()
        elif message_type == "lesson-set":
            state.change(step.after)
            return Reply({"lesson_set": True})
        elif message_type == "lesson-answer":
            return Reply({"lesson_answer": self._grade(step, message.get("value"), state)})
        elif message_type == "lesson-show":
            recalled = message.get("recall") is True
            return Reply({"lesson_answer": {**_shown_answer(step), "recalled": recalled}})
        return Reply()

    def _begin(self, message: Mapping[str, Any], state: State) -> Reply:
        key, index = message.get("lesson"), message.get("step")
        lesson = library().lessons.get(key) if isinstance(key, str) else None
        if lesson is None:
            return Reply({"lesson": None, "toast": "There is no such lesson on this server."})
        if self._running is None and not message.get("keep"):
            self._before = state.inputs()
        last = len(lesson.steps) - 1
        asked = int(index) if isinstance(index, int) and index >= 0 else 0
        self._running = lesson, min(asked, last)
        if not message.get("keep"):
            step = lesson.steps[self._running[1]]
            # the text of a step that was done before speaks of what its Try sets
            state.change(step.after if message.get("done") else step.before)
        answer: dict[str, Any] = {"lesson": describe(*self._running)}
        if asked > last:
            answer["toast"] = f"This lesson has {last + 1} steps: this is the last one."
        return Reply(answer, reset_view=not message.get("keep"))

    def _grade(self, step: Step, value: Any, state: State) -> dict[str, Any]:
        try:
            graded = grade(step, value, state.inputs())
        except Unanswerable:
            _LOG.exception("a question without an answer: %s", step.title)
            return {"right": False, "counted": False, "words": _NO_ANSWER, "show": None}
        # the charts show what the text speaks of; a goal was reached with the student's own values
        moved = graded.right and step.question.kind != "goal"
        return {
            "right": graded.right,
            "counted": graded.counted,
            "words": graded.words,
            "show": dict(step.after) if moved else None,
        }

    def sidebar_answer(self, state: State) -> dict[str, Any]:
        """Return the present values of the quantities that the running step shows."""
        step = self.step
        if step is None:
            return {}
        inputs = state.inputs()
        return {
            "lesson_numbers": {
                name: _present_value(name, inputs) for name in (*step.show.given, *step.show.watch)
            }
        }


def _shown_answer(step: Step) -> dict[str, Any]:
    """Return the solver's answer in the form of a grade."""
    try:
        words = solver_answer(step)
    except Unanswerable:
        words = "The solver has no answer here."
    return {
        "right": False,
        "counted": True,
        "words": words,
        "shown": True,
        "show": dict(step.after),
    }
