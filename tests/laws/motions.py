"""Rigid motions that theory knows, as the native air wants them: flight, heave, pitch.

The wing flies along world -x; heave is up, pitch is nose up about the wing frame's y axis.
"""

from __future__ import annotations

import numpy as np

from flaprig.aero.air import Air, WingLoads
from flaprig.aero.models import UVLM
from flaprig.aero.rigid_motion import RigidMotion
from flaprig.fluid import Fluid
from flaprig.wing import Wing

# unit density, so that loads are coefficients but for 1/2 U^2 S
FLUID = Fluid(density=1.0, kinematic_viscosity=1e-6)
# aspect ratio of the two-dimensional limit: wing tips change the lift by about 2/SECTION
SECTION = 1000.0


def flight(time, speed=1.0, heave=(0, 0, 0), pitch=(0, 0, 0)):
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


def steady(count, step, speed=1.0, angle=0.0):
    """Level flight at an angle of attack [rad], after a sudden start."""
    return flight(step * np.arange(count), speed, pitch=(angle, 0, 0))


def turned(motion, rotation):
    """The same motion in a world turned as a whole by a rotation matrix."""
    return RigidMotion(
        motion.position @ rotation.T,
        np.ascontiguousarray(rotation @ motion.rotation),
        motion.twist,
        motion.twist_rate,
    )


def lift_of(loads, motion, part="total"):
    """Upward force [N] of wing loads. Shape (n,)."""
    return np.einsum("nj,nj->n", motion.rotation[:, 2], getattr(loads, part)[:, :3])


def lattice_air(aspect_ratio, chordwise, spanwise, step, rows, **settings):
    """Uvlm air of a rectangle of chord 1 m in a fluid of density 1 kg/m3, suction off.

    step is the wake step [s], rows the wake's length; settings are fields of UVLM.
    """
    wing = Wing.rectangular(span=aspect_ratio, chord=1.0)
    settings = {"suction_efficiency": 0.0, "core": 0.001} | settings
    model = UVLM(chordwise=chordwise, spanwise=spanwise, **settings)
    return Air(wing, FLUID, model, 1.0, wake_step=repr(float(step)), wake_rows=str(rows))


def section_air(chordwise, step, rows, **settings):
    """The two-dimensional limit: one strip of aspect ratio 1000."""
    return lattice_air(SECTION, chordwise, 1, step, rows, tip_inset=0.0, **settings)


def ticks(air, motion, step):
    """Loads of each step, and the bound circulation (n, chordwise, spanwise) after it."""
    parts, bound = [], []
    for i in range(len(motion)):
        parts.append(air.run(motion.part(slice(i, i + 1)), step))
        bound.append(air.native.bound_circulation(air.state))
    names = ("base", "extra", "added_mass")
    loads = (np.concatenate([getattr(p, name) for p in parts]) for name in names)
    return WingLoads(*loads), np.array(bound)
