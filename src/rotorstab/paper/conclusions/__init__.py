"""The paper's five conclusions, one file each: as statements on Bolotin's regions and on growth.

`conclusion_…` asks in which sense it holds of Bolotin's regions on our numbers. Whether a rotor in
such a region is unstable is another question once it spins: `confirmation_…` asks Floquet.
"""

from collections.abc import Callable

from ...charts.figure import Statement
from .a_boundary_modes import conclusion_a, confirmation_a
from .b_shear_and_spin import conclusion_b, confirmation_b
from .c_static_load import conclusion_c, confirmation_c
from .d_follower_load import conclusion_d, confirmation_d
from .e_load_type import conclusion_e, confirmation_e

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
    "a": confirmation_a,
    "b": confirmation_b,
    "c": confirmation_c,
    "d": confirmation_d,
    "e": confirmation_e,
}
"""By its letter: what Floquet says of a conclusion."""
