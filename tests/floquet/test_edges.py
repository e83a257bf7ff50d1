"""True edges of tongues."""

import numpy as np
import pytest

from rotorstab import BASE_CASE, ShaftDisk, lumped
from rotorstab.floquet.point import growth_rate
from rotorstab.floquet.resonance import resonances
from rotorstab.floquet.tongues.edges import tongue_edges
from rotorstab.floquet.tongues.tracking import tongue_centres
from tests.testing.example_rotors import P


@pytest.mark.parametrize("tangency", [0.0, 1.0])
def test_growth_starts_at_the_edges(tangency):
    system = lumped(BASE_CASE, 2.0, tangency)
    loads = np.array([0.0, 0.05, 0.15]) * P
    edges = tongue_edges(system, 0.5 * P, loads)
    assert edges.names == tuple(r.name for r in resonances(system, 0.5 * P, 0.1).tongues)
    assert (edges.status == "tongue").all()
    for k in range(len(edges.names)):
        assert edges.left[k, 0] == edges.right[k, 0] == edges.centre[k, 0]
        for i in (1, 2):
            for edge, side in ((edges.left[k, i], -1), (edges.right[k, i], 1)):
                inside, outside = growth_rate(
                    system, 0.5 * P, loads[i], edge - side * np.array([1e-6, -1e-6])
                )
                assert inside > 1e-6
                assert outside < 1e-7


def test_edges_with_damping_and_bad_input():
    system = lumped(BASE_CASE, 2.0, external_damping=0.01)
    edges = tongue_edges(system, 0.5 * P, np.array([0.0, 0.02, 0.2]) * P, ("1B+1F",))
    assert edges.status[0].tolist() == ["stable", "stable", "tongue"]
    for edge in (edges.left[0, 2], edges.right[0, 2]):
        assert abs(growth_rate(system, 0.5 * P, 0.2 * P, edge)) < 1e-8
    with pytest.raises(ValueError, match="`names` must be among"):
        tongue_edges(system, 0.5 * P, [0.2 * P], ("1B+7F",))
    with pytest.raises(ValueError, match="rising"):
        tongue_edges(system, 0.5 * P, [0.2, 0.1])


@pytest.mark.parametrize(
    ("rotor", "speed", "static", "loads", "names"),
    [
        (
            ShaftDisk(
                0.06414582208782306, 1.4268327502209017, 0.79820235513062, 0.18152406682427535
            ),
            0.8071165377616252,
            0.6016221108670108,
            [0.581636, 0.596942],
            ("1B+2F", "2B+1F"),
        ),
        (
            ShaftDisk(
                0.049364997495538424, 2.9389630859839513, 1.2801897000084455, 0.45986354046214367
            ),
            3.1453915158695236,
            0.1568379388469431,
            [0.119006],
            ("2B+1F", "1B+2F"),
        ),
    ],
)
def test_a_narrow_gap_to_the_next_tongue_is_not_jumped(rotor, speed, static, loads, names):
    """Gaps of 1e-4 to 5e-4 of θ̄; nothing between two edges is stable, all beyond them is."""
    law, tangency = ("exact", 0.0) if speed > 1 else ("linear", 0.5)
    system = lumped(rotor, speed, tangency, stiffness=law)
    edges = tongue_edges(system, static, loads, names)
    drawn = np.argwhere(edges.status == "tongue")
    assert len(drawn) >= len(loads)
    for k, i in drawn:
        left, right = edges.left[k, i], edges.right[k, i]
        share = (np.arange(800) + 0.5) / 800
        assert (growth_rate(system, static, loads[i], left + share * (right - left)) > 1e-6).all()
        beyond = np.array([left * (1 - 1e-5), right * (1 + 1e-5)])
        assert (growth_rate(system, static, loads[i], beyond) < 1e-9).all()


def test_a_tongue_once_lost_stays_lost():
    """Where another vertex takes its place at the root no centre is reported."""
    row = resonances(lumped(BASE_CASE, 2.0), 0.5 * P, P)["1B+1F"]

    def measure(load, theta):
        apart = (theta / row.centre - 1) / 0.01
        own = -((apart - 20 * load**2) ** 2)
        return np.where(load < 0.6, own, np.where(np.abs(apart) < 3, -(apart**2), apart**2))

    loads = np.array([0.1, 0.5, 0.7, 1.0])
    centre = tongue_centres(measure, loads, (row,))[0]
    assert centre[:2] == pytest.approx(row.centre * (1 + 0.2 * loads[:2] ** 2), rel=1e-6)
    assert np.isnan(centre[2:]).all()
