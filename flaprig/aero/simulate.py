"""Prescribed motion: a wing driven along a stroke, without rigid bodies (paper, section 2.2)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from flaprig import _checks as check
from flaprig.aero.air import Air, Progress, WingLoads
from flaprig.aero.buoyancy import buoyant_torque
from flaprig.aero.histories import Histories
from flaprig.aero.loads import side_force, sweep_direction, upward
from flaprig.aero.models import UVLM, AirModel
from flaprig.aero.result import Result, averaged_cycles
from flaprig.aero.rigid_motion import RigidMotion
from flaprig.fluid import WATER, Fluid
from flaprig.strokes.stroke import Motion, Stroke, check_stroke
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
        ValueError: an argument of the wrong type or out of its range.
        FloatingPointError: the loads are not finite; says from which time on.
    """
    owner = "simulate"
    model = UVLM() if model is None else model
    check_setup(owner, wing, model, fluid)
    check_stroke(owner, stroke)
    cycles = check.whole(owner, "cycles", cycles, 1, 1000)
    substeps = check.whole(owner, "substeps", substeps, 1, 1000)
    check.callback(owner, "progress", progress)
    check.flag(owner, "buoyancy", buoyancy)
    steps = model.steps_per_cycle * substeps
    motion = prescribed(stroke, cycles, steps)
    rigid = RigidMotion.from_stroke(motion)
    air = Air(wing, fluid, model, stroke.frequency, stroke.sweep_amplitude)
    loads = air.run(rigid, 1.0 / (steps * stroke.frequency), progress)
    return result_of(wing, stroke, fluid, motion, loads, cycles, buoyancy)


def check_setup(owner: str, wing: Wing, model: AirModel, fluid: Fluid) -> None:
    """Refuse what is no wing, no model of the fluid or no fluid.

    Raises:
        ValueError: one sentence that names the argument.
    """
    check.instance(owner, "wing", wing, Wing, "a Wing, for instance RIG_WING")
    words = "a model of the fluid, for instance UVLM() or QuasiSteady()"
    check.instance(owner, "model", model, AirModel, words)
    check.instance(owner, "fluid", fluid, Fluid, "a Fluid, for instance WATER")


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
    loads: WingLoads,
    cycles: int,
    buoyancy: bool = False,
) -> Result:
    """What the loads along a prescribed stroke mean, with the displaced fluid's where asked for.

    Raises:
        FloatingPointError: the loads are not finite; says from which time on.
    """
    _require_finite(loads, motion.time)
    steps = motion.time.size // cycles
    histories = stroke_histories(motion, loads, stroke.period / steps)
    if buoyancy:
        histories = histories.with_buoyancy(buoyant_torque(wing, fluid, motion.pitch))
    force = reference_force(wing, stroke, fluid)
    found = Result(histories, force, steps, averaged_cycles(cycles))
    return found.doubted(stroke)


def _require_finite(loads: WingLoads, time: Array) -> None:
    bad = np.flatnonzero(~np.isfinite(loads.total).all(axis=1))
    if bad.size:
        raise FloatingPointError(
            f"simulate: the loads are not finite from t = {time[bad[0]]:.6g} s on; "
            "a larger core or more steps_per_cycle usually cures a wake that blows up"
        )


def stroke_histories(motion: Motion, loads: WingLoads, step: float) -> Histories:
    """Lift, drag, torques and power of wing loads along a stroke at equal steps in [s]."""
    pitch, total = motion.pitch, loads.total
    direction = sweep_direction(motion.sweep_rate, motion.sweep_acceleration, step)

    def drag(wrench: Array) -> Array:
        return direction * side_force(wrench[:, :3], pitch)

    sweep_torque = upward(total[:, 3:], pitch)
    # the pitch axis is -span
    pitch_torque = -total[:, 4]
    return Histories(
        time=motion.time,
        sweep=motion.sweep,
        pitch=pitch,
        sweep_rate=motion.sweep_rate,
        pitch_rate=motion.pitch_rate,
        lift=upward(total[:, :3], pitch),
        drag=drag(total),
        sweep_torque=sweep_torque,
        pitch_torque=pitch_torque,
        power=-(sweep_torque * motion.sweep_rate + pitch_torque * motion.pitch_rate),
        lift_extra=upward(loads.extra[:, :3], pitch),
        drag_extra=drag(loads.extra),
        lift_added_mass=upward(loads.added_mass[:, :3], pitch),
        drag_added_mass=drag(loads.added_mass),
    )
