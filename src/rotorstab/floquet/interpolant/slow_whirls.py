"""The four slowest whirls of a system of more than two coordinates, as a system of two.

A load that pulsates slowly couples fast whirls weakly to slow ones, and their multipliers pass each
other on the unit circle almost unchanged. Those of the four slowest whirls then have a polynomial
of their own, of degree four, and a chart of finite elements is found about as fast as one of two
coordinates, tongues of every order included.
"""

from __future__ import annotations

import numpy as np

from ..._types import AnyArray, Array, Complex
from ...model.system import System
from .panels import Panel
from .sampling import ERROR_POWER, MAP_LEVELS, NodeSampler, PanelSamples, probes
from .slow_basis import slow_systems

__all__ = ["InseparableWhirls", "SlowSampler"]

_SLOW = 4
_LARGEST_GROWTH = 1e-6  # ln |product of the four multipliers| above which one has met a fast one
_DECAY_RANGE = 0.5, 0.1  # the same with damping, a part of the decay and an amount
_CHECKS_PER_NODE = 4  # periods at which the largest load is checked, for each node in T
# The steps keep the structure of a motion, so nearly all of their error turns multipliers along the
# unit circle, and this part or less changes the modulus, without damping and with it.
_OFF_CIRCLE = {False: 0.06, True: 0.1}
_REDUCTION = 0.5  # factor on the estimated error of the reduction to slow whirls
_LARGEST_ERROR = 2e-4  # of the interpolation: beyond it the functions are not smooth


class InseparableWhirls(ValueError):
    """The four slowest whirls have tongues together with faster ones in the range of a chart."""


class SlowSampler(NodeSampler):
    """Computes the polynomial of the four slowest whirls at nodes in period and load.

    The four multipliers are those in whose eigenvectors the slow whirls participate most: the
    participation factors |v_ki w_ik| do not depend on how the whirls are scaled. Their product c₄
    is divided out, so that c₄ = 1 remains. The functions are Re c₁, Im c₁, c₂ without damping,
    else c₁, c₂, c₃ and ln|c₄|/4.

    Parameters
    ----------
    system : System
        Of more than two coordinates, at one spin speed.
    static_load, largest_load : float
        As for `NodeSampler`.

    Notes
    -----
    What a fast multiplier does to a slow one as it passes is left out; it is of the order of the
    width of the tongue of the two. Where a node lies in such a tongue, `sample` raises
    `InseparableWhirls`.

    References
    ----------
    I. J. Pérez-Arriaga, G. C. Verghese, F. C. Schweppe, Selective modal analysis with applications
    to electric power systems, IEEE Trans. Power Apparatus and Systems PAS-101 (1982) 3117
    (participation factors).
    """

    def __init__(self, system: System, static_load: float, largest_load: float) -> None:
        super().__init__(system, static_load, largest_load)
        self._rougher: SlowSampler | None = None
        self._gain = 0.0
        frequencies = self.basis.frequencies
        self.closed_form = True
        self.whirls = np.sort(np.argsort(np.abs(frequencies.real), kind="stable")[:_SLOW])
        slow = frequencies[self.whirls]
        self.drift = complex(slow.real.mean())
        self.excess = 0.0
        self._decay = float(slow.imag.sum())

    @classmethod
    def reduced(cls, system: System, static_load: float, largest_load: float) -> SlowSampler:
        """Return the sampler of a system reduced to what its slow whirls need; see `slow_basis`."""
        found = slow_systems(system, static_load, largest_load, _SLOW)
        sampler = cls(found.reduced, static_load, largest_load)
        if found.rougher is not None:
            sampler._rougher = cls(found.rougher, static_load, largest_load)
            sampler._gain = found.gain
        return sampler

    def mean_growth(self, functions: AnyArray, periods: Array) -> Array | float:
        """Return ln|c₄|/4, which was divided out of the multipliers."""
        return 0.0 if self.system.is_reversible else functions[3].real

    def sample(self, panel: Panel, periods: Array) -> PanelSamples:
        """Return the functions in one panel; raise an error where they are not smooth."""
        found = super().sample(panel, periods)
        if found.interpolation_error.max() > _LARGEST_ERROR:
            raise InseparableWhirls("slow and fast whirls change places in this chart")
        if panel.period_nodes:
            # tongues between the nodes are widest at the largest load
            columns = periods[panel.columns]
            period = columns[:: max(1, len(columns) // (_CHECKS_PER_NODE * panel.period_nodes))]
            load = np.array([self.largest_load])
            self._functions(self._processed(period, load, MAP_LEVELS[0] * panel.steps), period)
        return found

    def _coefficients(self, period: Array, load: Array, steps: int) -> tuple[AnyArray, Array]:
        """Return the functions (3 or 4, T nodes, load nodes) and their errors (3 or 4, load)."""
        fine, rough = MAP_LEVELS[:2]
        values = self._functions(self._processed(period, load, fine * steps), period)
        at = probes(period)
        gap = self._functions(self._processed(period[at], load, rough * steps), period[at])
        gap = np.abs(gap - values[:, at]) / ((fine / rough) ** 4 - 1)
        stretch = period.max() / period[at, None]
        error = (gap * stretch**ERROR_POWER).max(axis=1)
        error *= _OFF_CIRCLE[not self.system.is_reversible]
        if self._rougher is not None:
            y = self._rougher._processed(period[at], load, fine * steps)
            gap = np.abs(self._rougher._functions(y, period[at]) - values[:, at])
            error += _REDUCTION * self._gain * gap.max(axis=1)
        return values, error

    def _functions(self, propagator: Complex, period: Array) -> AnyArray:
        """Return the functions of propagators (T nodes, load nodes, 2n, 2n)."""
        if not np.isfinite(propagator).all():
            raise InseparableWhirls("the growth within one period is too strong")
        slow = self._slow_multipliers(propagator)
        product = slow.prod(axis=-1)
        size = np.log(np.abs(product))
        self._check(size, period)
        # the loads fall; without pulsation the phase is 4 drift T
        turn = np.angle(product * np.exp(-4j * self.drift.real * period)[:, None])
        turn = np.unwrap(turn[:, ::-1], axis=1)[:, ::-1] + 4 * self.drift.real * period[:, None]
        z = slow * np.exp(-(size + 1j * turn) / 4)[..., None]
        c1 = z.sum(axis=-1)
        c2 = (c1 * c1 - (z * z).sum(axis=-1)) / 2
        if self.system.is_reversible:
            return np.array([c1.real, c1.imag, c2.real])
        return np.array([c1, c2, (1 / z).sum(axis=-1), size / 4])

    def _slow_multipliers(self, propagator: Complex) -> Complex:
        """Return the multipliers (..., 4) of the slow whirls."""
        if not self.system.is_reversible:
            mu, right = np.linalg.eig(propagator)
        else:
            # μ = (1 + jt)/(1 − jt), see `reversed_growth`
            t, right = np.linalg.eig(np.linalg.solve(propagator.real, propagator.imag))
            mu = (1 + 1j * t) / (1 - 1j * t)
        left = np.swapaxes(np.linalg.inv(right), -1, -2)
        factors = np.abs(right * left)
        share = factors[..., self.whirls, :].sum(axis=-2) / factors.sum(axis=-2)
        pick = np.argsort(-share, axis=-1)[..., :_SLOW]
        return np.asarray(np.take_along_axis(mu, pick, -1))

    def _check(self, size: Array, period: Array) -> None:
        """Raise an error where a slow multiplier has met a fast one; `size` is ln|c₄|."""
        decay = self._decay * period[:, None]
        allowed: Array | float = _LARGEST_GROWTH
        if self.system.is_damped:
            allowed = _DECAY_RANGE[0] * np.abs(decay) + _DECAY_RANGE[1]
        if (np.abs(size + decay) > allowed).any():
            raise InseparableWhirls("slow and fast whirls have a tongue together in this chart")
