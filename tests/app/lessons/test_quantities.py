"""What a lesson's quantities depend on."""

import math

import pytest

from app.lessons.evaluation import evaluate
from app.lessons.quantities import QUANTITIES
from app.state import State

PARTS = {"<mode>": "1F", "<pair>": "1B+1F", "<n>": "1", "<way>": "forward", "<name>": "shear"}
# with damping a tongue begins at a threshold, which lies between the two values of β_d here
INPUTS = State().inputs() | {
    "external_damping": 0.05,
    "marker_frequency": 1.6,
    "marker_factor": 0.6,
}


def value(name, **changes):
    return evaluate(name, INPUTS | changes)


@pytest.mark.parametrize("quantity", QUANTITIES, ids=lambda quantity: quantity.form)
def test_a_quantity_says_whether_it_depends_on_the_marked_points_load_alone(quantity):
    name = quantity.form
    for part, word in PARTS.items():
        name = name.replace(part, word)
    first = value(name)
    assert not math.isnan(first)
    by_factor = value(name, marker_factor=0.01) != first
    by_frequency = value(name, marker_frequency=9.0) != first
    assert quantity.at_factor == (by_factor and not by_frequency)
