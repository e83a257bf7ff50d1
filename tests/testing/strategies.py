"""Random rotors for property tests, within the ranges of the dashboard."""

from hypothesis import strategies as st

import rotorstab as rs


def between(low, high):
    return st.floats(low, high, allow_subnormal=False)


shears = between(0.0, 0.1)
tangencies = st.sampled_from([0.0, 0.5, 1.0])
spin_speeds = st.one_of(st.just(0.0), between(0.01, 4.0))

rotors = st.builds(
    rs.ShaftDisk,
    shear=st.one_of(st.just(0.0), shears),
    disk_mass=between(0.5, 20.0),
    diametral_inertia=between(0.01, 3.0),
    polar_inertia=st.one_of(st.just(0.0), between(0.01, 6.0)),
)
