"""Prescribed motion: a wing driven along a stroke, without rigid bodies (paper, section 2.2)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from flaprig import _checks as check
from flaprig.aero.air import Air, Progress, WingLoads
from flaprig.aero.buoyancy import buoyant_torque
from flaprig.aero.histories import Histories
from flaprig.aero.models import UVLM, AirModel
from flaprig.aero.result import Result, averaged_cycles
from flaprig.aero.rigid_motion import RigidMotion
from flaprig.fluid import WATER, Fluid
from flaprig.strokes.stroke import Motion, Stroke
from flaprig.wing import Wing

Array = NDArray[np.float64]

# smallest half sweep amplitude [rad]: the coefficients divide by its square
LEAST_AMPLITUDE = 1e-6


def mean_speed(wing: Wing, stroke: Stroke) -> float:
    """Mean speed at R2 over a cycle, 4 f phi0 R2 with phi0 the half amplitude, in [m/s]."""
    return 4.0 * stroke.frequency * stroke.sweep_amplitude * wing.radius_of_second_moment


def reference_force(wing: Wing, stroke: Stroke, fluid: Fluid) -> float:
    """0.5 rho U^2 S in [N], U the mean speed at R2."""
    return 0.5 * fluid.density * mean_speed(wing, stroke) ** 2 * wing.area


def simulate(
    wing: Wing,
    stroke: Stroke,
    model: AirModel | None = None,
    fluid: Fluid = WATER,
    cycles: int = 5,
    substeps: int = 1,
    progress: Progress | None = None,
    buoyancy: bool = False,
) -> Result:
    """Loads on a wing that follows a stroke exactly, beginning in still fluid.

    Args:
        wing: the wing, its frame on the sweep axis.
        stroke: sweep and pitch.
        model: the air; UVLM() when None.
        fluid: the fluid.
        cycles: number of cycles, 1 to 1000.
        substeps: instants reported per model step, between which the wake stands still.
        progress: called with the fraction done.
        buoyancy: whether the pitch torque has that of the displaced fluid in it, as the servo in
            the tank feels it (the weight of the plate, which is of no fluid, is not in it). Lift,
            drag and power are those of the motion either way.

    Raises:
        ValueError: a value out of range.
        FloatingPointError: the loads are not finite; says from which time on.
    """
    model = UVLM() if model is None else model
    check.whole("simulate", "cycles", cycles, 1, 1000)
    check.whole("simulate", "substeps", substeps, 1, 1000)
    check.flag("simulate", "buoyancy", buoyancy)
    steps = model.steps_per_cycle * substeps
    motion = prescribed(stroke, cycles, steps)
    rigid = RigidMotion.from_stroke(motion)
    air = Air(wing, fluid, model, stroke.frequency, stroke.sweep_amplitude)
    loads = air.run(rigid, 1.0 / (steps * stroke.frequency), progress)
    return result_of(wing, stroke, fluid, motion, rigid, loads, cycles, buoyancy)


def prescribed(stroke: Stroke, cycles: int, steps: int) -> Motion:
    """The stroke at equal steps from time 0.

    Raises:
        ValueError: a stroke without sweep, by whose speed the coefficients divide.
    """
    if not stroke.sweep_amplitude >= LEAST_AMPLITUDE:
        allowed = f"at least {LEAST_AMPLITUDE} rad (coefficients divide by the sweep's speed)"
        raise check.fail("simulate", "stroke.sweep_amplitude", allowed, stroke.sweep_amplitude)
    return stroke.motion(np.arange(cycles * steps) / (steps * stroke.frequency))


def result_of(
    wing: Wing,
    stroke: Stroke,
    fluid: Fluid,
    motion: Motion,
    rigid: RigidMotion,
    loads: WingLoads,
    cycles: int,
    buoyancy: bool = False,
) -> Result:
    """What the loads along a prescribed stroke mean, with the displaced fluid's where asked for.

    Raises:
        FloatingPointError: the loads are not finite; says from which time on.
    """
    _require_finite(loads, motion.time)
    histories = stroke_histories(motion, rigid, loads)
    if buoyancy:
        histories = histories.with_buoyancy(buoyant_torque(wing, fluid, motion.pitch))
    force = reference_force(wing, stroke, fluid)
    return Result(histories, force, motion.time.size // cycles, averaged_cycles(cycles))


def _require_finite(loads: WingLoads, time: Array) -> None:
    bad = np.flatnonzero(~np.isfinite(loads.total).all(axis=1))
    if bad.size:
        raise FloatingPointError(
            f"simulate: the loads are not finite from t = {time[bad[0]]:.6g} s on; "
            "a larger core or more steps_per_cycle usually cures a wake that blows up"
        )


def stroke_histories(motion: Motion, rigid: RigidMotion, loads: WingLoads) -> Histories:
    """Lift, drag, torques and power of wing loads along a stroke."""
    lift, drag = _lift_drag(motion, rigid, loads.total)
    extra = _lift_drag(motion, rigid, loads.extra)
    added = _lift_drag(motion, rigid, loads.added_mass)
    # torque about z; the pitch axis is -span
    sweep_torque = np.einsum("nj,nj->n", rigid.rotation[:, 2], loads.total[:, 3:])
    pitch_torque = -loads.total[:, 4]
    power = -(sweep_torque * motion.sweep_rate + pitch_torque * motion.pitch_rate)
    return Histories(
        motion.time,
        motion.sweep,
        motion.pitch,
        motion.sweep_rate,
        motion.pitch_rate,
        lift,
        drag,
        sweep_torque,
        pitch_torque,
        power,
        extra[0],
        extra[1],
        added[0],
        added[1],
    )


def _lift_drag(motion: Motion, rigid: RigidMotion, loads: Array) -> tuple[Array, Array]:
    """Upward force, and force against the sweep (paper, eq. 12)."""
    force = np.einsum("nij,nj->ni", rigid.rotation, loads[:, :3])
    along = -force[:, 0] * np.sin(motion.sweep) + force[:, 1] * np.cos(motion.sweep)
    return force[:, 2], -np.sign(motion.sweep_rate) * along
