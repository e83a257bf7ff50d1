"""What students read where the solver has no answer."""

import numpy as np
import pytest

from app.lessons.format import parse
from app.lessons.grading import grade
from app.reading.user_error import UserError
from app.session import Session
from app.state import State
from app.words.refusals import FAILED, user_message
from rotorstab import BASE_CASE, growth_rate, lumped, whirl_frequencies

LESSON = """+++
title = "Past the pole"
summary = "A goal that the sliders can miss by far."
+++
## Step
### Predict
Guess.
```question
goal = "growth > 0.3"
ask = "Make it grow."
hint = "Not yet."
```
### Try
```set
marker = true
marker_factor = 1.9
```
```show
move = ["shear", "law", "reference", "marker_factor", "diametral_inertia", "load_type"]
```
### See
Seen.
"""


def errors():
    """Errors of the solver and of Python that a page could meet."""
    exact = lumped(BASE_CASE, 1.0, stiffness="exact")
    for fail in (
        lambda: whirl_frequencies(exact, 50.0),
        lambda: growth_rate(exact, 20.0, 20.0, 1.0),
        lambda: whirl_frequencies(exact, np.inf),
        lambda: lumped(BASE_CASE, 1.0, tangency=7.0),
        lambda: str(10**5000),
        lambda: int("9" * 5000),
    ):
        with pytest.raises(ValueError) as caught:  # noqa: PT011
            fail()
        yield caught.value


def test_no_argument_s_name_and_no_advice_of_python_comes_through(caplog):
    words = [user_message(error) for error in errors()]
    assert not [one for one in words if "`" in one or "sys." in one or "got" in one]
    assert "the stiffness law ends: choose a smaller load" in words[0]
    assert words[0] == words[1]
    assert words[2:] == [FAILED] * 4
    assert "`tangency` must be in [0, 1], got 7" in caplog.text  # for whoever runs the server
    assert (
        user_message(UserError("This rotor has no flutter load."))
        == "This rotor has no flutter load."
    )


def test_a_page_whose_solver_refuses_says_so_in_words(monkeypatch):
    session = Session()
    error = next(iter(errors()))

    def refuse(*args, **kwargs):
        raise error

    monkeypatch.setattr(session.pages["explore"], "show", refuse)
    answer = session.respond({"type": "change", "values": {"spin_speed": 1.0}})
    assert answer["notice"] == user_message(error)
    assert answer["values"]["spin_speed"] == 1.0


def test_a_goal_past_the_pole_is_refused_in_words():
    step = parse(LESSON, "past-the-pole").steps[0]
    far = {"law": "exact", "shear": 0.05, "reference": "flutter", "diametral_inertia": 0.3}
    state = State(**step.after)
    assert state.change(far | {"load_type": "follower"}) == {}
    grown = grade(step, None, state.inputs())
    assert not grown.right
    assert "`" not in grown.words
    assert "choose a smaller load" in grown.words
