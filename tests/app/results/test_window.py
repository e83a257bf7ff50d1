"""The window of a growth map: what is drawn in it, and what is left out."""

import numpy as np
import pytest

from app.results.limits import Detail
from app.results.model import Model
from app.results.window import Window, floquet_map, window_outlines
from rotorstab import BASE_CASE
from tests.testing.example_rotors import P, W


@pytest.mark.parametrize("options", [{}, {"external_damping": 0.01}, {"law": "exact"}])
def test_every_model_has_edges_but_for_slow_loads(options):
    model = Model(BASE_CASE, **options)
    assert window_outlines(Window(model, 2.0, 0.0, 0.5 * P, W, 3 * W, 0.5 * P))
    assert window_outlines(Window(model, 2.0, 0.0, 0.5 * P, 0.1 * W, 0.3 * W, 0.5 * P)) == ()


def test_a_finer_map_holds_all_that_a_coarser_one_does():
    window = Window(Model(BASE_CASE), 2.0, 0.0, 0.5 * P, 0.0, 6 * W, P)
    coarse, full, refined = (floquet_map(window, detail) for detail in Detail)
    assert coarse.growth.growth.size < full.growth.growth.size
    assert (coarse.outlines, full.outlines) == ((), ())
    assert len(refined.outlines) > 3
    assert full.growth.refined == 0 < refined.growth.refined
    assert (full.growth.error >= refined.growth.error).all()
    np.testing.assert_array_equal(full.mask, refined.mask)
