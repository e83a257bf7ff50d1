"""A spy on the solver: every number that the app hands to it is finite and within State's bounds.

`watch` wraps each function of `rotorstab` that a module of `app` calls by name, where the app looks
it up. The bounds are State's own; a load is judged against State's factors times the largest load
that a factor can refer to, a frequency against the largest fundamental frequency.
"""

import dataclasses
import functools
import importlib
import inspect
import pkgutil

import numpy as np

import app
from app.results.limits import MOST_NODES
from app.state import State
from rotorstab import ResonanceTable, ShaftDisk, System, critical_load, flutter_load, lumped
from rotorstab import fundamental_frequency as frequency_of

# modules of the app whose calls are not watched: see `entry_points`
NOT_WATCHED = ("app.main", "app.app_hooks", "app.background.settling", "app.lessons.__main__")
# modules of the library that draw, write or judge; what they get has been through the solver
LEFT_OUT = (
    "rotorstab.floquet.criterion",
    "rotorstab.charts",
    "rotorstab.drawing.screen",
    "rotorstab.drawing.tables",
    "rotorstab.paper",
)


class Unclamped(AssertionError):
    """The solver was handed a number that no input can give."""


def _bounds(name):
    return State.param[name].bounds


def _references():
    """The largest load that factors refer to and the largest ω_n, over corners of the bounds."""
    loads, frequencies = [], []
    for shear in (*_bounds("shear"), 0.02):
        for mass in _bounds("disk_mass"):
            for inertia in _bounds("diametral_inertia"):
                rotor = ShaftDisk(shear, mass, inertia, 0.0)
                system = lumped(rotor, 0.0, 1.0)
                flutter = flutter_load(system)
                loads += [float(critical_load(shear)), flutter if np.isfinite(flutter) else 0.0]
                frequencies.append(frequency_of(system))
    return 1.5 * max(loads), 1.5 * max(frequencies)


LOAD, FREQUENCY = _references()
FREE = 1e6  # nothing that the app derives from its inputs is larger
LIMITS = {
    name: _bounds(name)
    for name in (
        "shear",
        "disk_mass",
        "diametral_inertia",
        "polar_inertia",
        "spin_speed",
        "tangency",
        "external_damping",
        "internal_damping",
        "seed",
        "periods",
    )
} | {
    "static_load": (-2 * LOAD, 2 * LOAD),
    "load": (-6 * LOAD, 6 * LOAD),
    "loads": (-6 * LOAD, 6 * LOAD),
    "pulsating_load": (0.0, 2 * LOAD),
    "pulsating_loads": (0.0, 2 * LOAD),
    "excitation_frequency": (0.0, 40 * FREQUENCY),
    "excitation_frequencies": (0.0, 40 * FREQUENCY),
    "spin_speeds": _bounds("spin_speed"),
}
LIMITS |= {"low": (0.0, 40 * FREQUENCY), "high": (0.0, 40 * FREQUENCY), "top": (0.0, 2 * LOAD)}
LIMITS |= {"most_work": (0.0, float(max(MOST_NODES.values())))}
LIMITS |= {name: (0.0, 1e300) for name in ("youngs_modulus", "shear_modulus", "density")}


def check(name, value, depth=0, limits=LIMITS):
    """Raise where a number in a value is not finite or out of its range."""
    if isinstance(value, ResonanceTable):
        return  # an answer of the solver: a pair without a tongue has an infinite threshold
    if isinstance(value, ShaftDisk):
        for field in ("shear", "disk_mass", "diametral_inertia", "polar_inertia"):
            check(field, getattr(value, field))
    elif isinstance(value, System):
        for field in ("spin_speed", "tangency"):
            check(field, getattr(value, field))
        for field in ("mass", "gyroscopic", "external_damping", "internal_damping", "elastic"):
            check(f"matrix {field}", getattr(value, field))
    elif dataclasses.is_dataclass(value) and not isinstance(value, type) and depth < 3:
        for field in dataclasses.fields(value):
            check(field.name, getattr(value, field.name), depth + 1, limits)
    elif isinstance(value, dict):
        for key, one in value.items():
            check(str(key), one, depth + 1, limits)
    elif isinstance(value, list | tuple):
        for one in value:
            check(name, one, depth + 1, limits)
    elif isinstance(value, np.ndarray) or (
        isinstance(value, int | float | complex | np.number) and not isinstance(value, bool)
    ):
        numbers = np.atleast_1d(np.asarray(value))
        if numbers.dtype.kind not in "iufc":
            return
        low, high = limits.get(name, (-FREE, FREE)) if limits else (-1e300, 1e300)
        parts = numbers.real if numbers.dtype.kind == "c" else numbers
        if not np.isfinite(numbers).all():
            raise Unclamped(f"{name} is not finite: {value!r:.200}")
        slack = 1e-9 * max(abs(low), abs(high))
        if (parts < low - slack).any() or (parts > high + slack).any():
            raise Unclamped(f"{name} is outside [{low:g}, {high:g}]: {value!r:.200}")


def spied(function, seen, found, limits=LIMITS):
    """The function, after a look at what it is given."""
    parameters = inspect.signature(function)

    @functools.wraps(function)
    def wrapper(*args, **kwargs):
        seen[function.__name__] = seen.get(function.__name__, 0) + 1
        try:
            for name, value in parameters.bind(*args, **kwargs).arguments.items():
                check(name, value, limits=limits)
        except Unclamped as error:
            # the app answers any exception with words: the spy keeps its own account
            found.append(f"{function.__name__}: {error}")
            raise
        return function(*args, **kwargs)

    return wrapper


def entry_points():
    """(module, name, function) of every solver function that a module of the app calls by name."""
    points = []
    for info in pkgutil.walk_packages(app.__path__, "app."):
        # the entry points of a server change Bokeh in this process, and app.background.settling
        # hands a function by name to another one
        if info.name in NOT_WATCHED:
            continue
        module = importlib.import_module(info.name)
        for name, one in vars(module).items():
            home = getattr(one, "__module__", "") or ""
            solver = home.startswith("rotorstab") and not home.startswith(LEFT_OUT)
            if solver and not inspect.isclass(one) and callable(one):
                points.append((module, name, one))
    return points


def watch(replace=setattr):
    """Wrap every entry point; return {function: calls} and the list of violations, both live."""
    seen, found = {}, []
    for module, name, function in entry_points():
        replace(module, name, spied(function, seen, found))
    # data in SI may be anything that is finite: what comes of it is judged by State
    shaft = spied(ShaftDisk.from_si, seen, found, limits=None)
    replace(ShaftDisk, "from_si", staticmethod(shaft))
    return seen, found
