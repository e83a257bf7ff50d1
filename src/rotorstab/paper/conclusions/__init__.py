"""The paper's five conclusions, one file each: as statements on Bolotin's regions and on growth.

`conclusion_…` asks in which sense it holds of Bolotin's regions on our numbers. Whether a rotor in
such a region is unstable is another question once it spins: `survival_…` asks Floquet.
"""

from collections.abc import Callable

from ...charts.figure import Statement
from .a_boundary_modes import conclusion_a, survival_a
from .b_shear_and_spin import conclusion_b, survival_b
from .c_static_load import conclusion_c, survival_c
from .d_follower_load import conclusion_d, survival_d
from .e_load_type import conclusion_e, survival_e

__all__ = ["CONCLUSIONS", "FLOQUET_CONCLUSIONS"]

CONCLUSIONS: dict[str, Callable[[], Statement]] = {
    "a": conclusion_a,
    "b": conclusion_b,
    "c": conclusion_c,
    "d": conclusion_d,
    "e": conclusion_e,
}
"""By its letter: what Bolotin's regions say of a conclusion."""

FLOQUET_CONCLUSIONS: dict[str, Callable[[], Statement]] = {
    "a": survival_a,
    "b": survival_b,
    "c": survival_c,
    "d": survival_d,
    "e": survival_e,
}
"""By its letter: what Floquet says of a conclusion."""
