"""Rigid motions that theory knows, as the native air wants them: flight, heave, pitch.

The wing flies along world -x; heave is up, pitch is nose up about the wing frame's y axis.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from flaprig.aero.air import Air, WingLoads
from flaprig.aero.models import UVLM
from flaprig.aero.rigid_motion import RigidMotion
from flaprig.fluid import Fluid
from flaprig.wing import Wing

Array = NDArray[np.float64]

# unit density, so that loads are coefficients but for 1/2 U^2 S
FLUID = Fluid(density=1.0, kinematic_viscosity=1e-6)
# aspect ratio of the two-dimensional limit: wing tips change the lift by about 2/SECTION
SECTION = 1000.0


def flight(
    time: ArrayLike,
    speed: float = 1.0,
    heave: tuple[ArrayLike, ArrayLike, ArrayLike] = (0, 0, 0),
    pitch: tuple[ArrayLike, ArrayLike, ArrayLike] = (0, 0, 0),
) -> RigidMotion:
    """Motion at the instants `time` [s]; heave [m] and pitch [rad] with their two derivatives.

    Any of the six may be a number or an array of the shape of time; speed is constant [m/s].
    """
    n = np.size(time)
    h, h1, h2, a, a1, a2 = (np.broadcast_to(np.asarray(x, float), n) for x in (*heave, *pitch))
    zero, one, cos, sin = np.zeros(n), np.ones(n), np.cos(a), np.sin(a)
    rows = [[cos, zero, sin], [zero, one, zero], [-sin, zero, cos]]
    rotation = np.moveaxis(np.array(rows), -1, 0).copy()
    # velocity and acceleration of the axis in wing components: R^T v and its derivative
    v_w = np.stack([zero - speed, zero, h1], axis=-1)
    a_w = np.stack([zero, zero, h2], axis=-1)
    spin, spin_rate = np.stack([zero, a1, zero], -1), np.stack([zero, a2, zero], -1)
    v = np.einsum("nji,nj->ni", rotation, v_w)
    v_rate = np.einsum("nji,nj->ni", rotation, a_w) - np.cross(spin, v)
    position = np.stack([-speed * np.asarray(time, float), zero, h], axis=-1)
    return RigidMotion(position, rotation, np.hstack([v, spin]), np.hstack([v_rate, spin_rate]))


def steady(count: int, step: float, speed: float = 1.0, angle: float = 0.0) -> RigidMotion:
    """Level flight at an angle of attack [rad], after a sudden start."""
    return flight(step * np.arange(count), speed, pitch=(angle, 0, 0))


def lift_of(loads: WingLoads, motion: RigidMotion, part: str = "total") -> Array:
    """Upward force [N] of wing loads. Shape (n,)."""
    return np.einsum("nj,nj->n", motion.rotation[:, 2], getattr(loads, part)[:, :3])


def lattice_air(
    wing: Wing, chordwise: int, spanwise: int, step: float, rows: int, **settings: Any
) -> Air:
    """Vortex lattice around a wing in fluid of density 1 kg/m3, all of the wake kept, suction off.

    Args:
        wing: the wing.
        chordwise: panels along the chord.
        spanwise: panels along the span.
        step: wake step in [s].
        rows: rows of wake kept.
        settings: fields of UVLM that differ.
    """
    plain = {"suction_efficiency": 0.0, "core": 0.001, "wake_detail": 0.0, "wake_fade": 0.0}
    model = UVLM(chordwise=chordwise, spanwise=spanwise, **plain | settings)
    return Air(wing, FLUID, model, 1.0, wake_step=repr(float(step)), wake_rows=str(rows))


def rectangle(aspect_ratio: float) -> Wing:
    """A rectangle of chord 1 m whose pitch axis is the quarter chord."""
    return Wing.rectangular(span=aspect_ratio, chord=1.0)


def section_air(chordwise: int, step: float, rows: int, **settings: Any) -> Air:
    """The two-dimensional limit: one strip of aspect ratio 1000."""
    return lattice_air(
        rectangle(SECTION), chordwise, 1, step, rows, **{"tip_inset": 0.0} | settings
    )


def ticks(air: Air, motion: RigidMotion, step: float) -> tuple[WingLoads, Array]:
    """Loads of each step, and the bound circulation (n, chordwise, spanwise) after it."""
    parts, bound = [], []
    for i in range(len(motion)):
        parts.append(air.run(motion.part(slice(i, i + 1)), step))
        bound.append(air.native.bound_circulation(air.state))
    names = ("base", "extra", "added_mass")
    loads = (np.concatenate([getattr(p, name) for p in parts]) for name in names)
    return WingLoads(*loads), np.array(bound)
