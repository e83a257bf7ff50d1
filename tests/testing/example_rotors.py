"""Rotors, one-degree-of-freedom systems and a reference integrator for the Floquet tests."""

import numpy as np
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from rotorstab import BASE_CASE, ShaftDisk, System, critical_load, lumped
from rotorstab.model.modal import state_matrix

P = float(critical_load(BASE_CASE.shear))
W = 0.6466913


def one_dof(elastic=1.0, geometric=1.0, spin=0.0, external=0.0, internal=0.0):
    """z̈ − j·spin·ż + … for z = x + jy; `spin` is also Ω̄ of the rotating damping."""
    return System(
        mass=[[1.0]],
        gyroscopic=[[1.0]],
        external_damping=[[external]],
        internal_damping=[[internal]],
        elastic=[[elastic]],
        geometric=[[geometric]],
        spin_speed=spin,
    )


def reference_growth(system, static, pulsating, theta, tolerance=1e-12):
    """ln max|μ|/T by DOP853 on the physical equations."""
    size, period = 2 * system.size, 2 * np.pi / theta

    def rate(t, z):
        load = static + pulsating * system.pulsation.at(theta * t)
        return (1j * state_matrix(system, system.stiffness(load)) @ z.reshape(size, size)).ravel()

    start = np.eye(size, dtype=complex).ravel()
    run = solve_ivp(rate, (0, period), start, "DOP853", rtol=tolerance, atol=tolerance)
    return np.log(np.abs(np.linalg.eigvals(run.y[:, -1].reshape(size, size))).max()) / period


def random_lumped(seed):
    """One rotor, its static load and critical load, from a seed."""
    rng = np.random.default_rng(seed)
    inertia = rng.uniform(0.3, 1.5)
    rotor = ShaftDisk(
        shear=rng.uniform(0, 0.05),
        disk_mass=rng.uniform(2, 8),
        diametral_inertia=inertia,
        polar_inertia=rng.uniform(0, 2) * inertia,
    )
    load = float(critical_load(rotor.shear))
    system = lumped(rotor, rng.uniform(0, 3), tangency=rng.choice([0.0, 0.4, 1.0]))
    return system, rng.uniform(0, 0.6) * load, load


@st.composite
def lumped_systems(draw):
    """Any lumped rotor, linear or exact, damped or not."""
    inertia = draw(st.floats(0.3, 1.5))
    rotor = ShaftDisk(
        shear=draw(st.floats(0, 0.05)),
        disk_mass=draw(st.floats(2, 8)),
        diametral_inertia=inertia,
        polar_inertia=inertia * draw(st.floats(0, 2)),
    )
    damped = draw(st.booleans())
    return lumped(
        rotor,
        draw(st.floats(0, 3)),
        tangency=draw(st.sampled_from([0.0, 0.3, 1.0])),
        external_damping=draw(st.floats(0, 0.05)) if damped else 0.0,
        internal_damping=draw(st.floats(0, 0.02)) if damped else 0.0,
        stiffness=draw(st.sampled_from(["linear", "exact"])),
    )
