"""The digital twin: the rig's servos follow a stroke in MuJoCo, and the fluid answers.

Each servo gets the stroke's position at the beginning of a step and the stroke's rate at its end:
implicitfast takes position forces at the old state and rate forces at the new one, so a motor that
follows perfectly is asked for nothing, whatever the time step.
"""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from flaprig import _checks as check
from flaprig.aero.air import Progress
from flaprig.rig import Axis, Rig, controls, coordinates
from flaprig.strokes.stroke import Motion, Stroke
from flaprig.twin_log import drive
from flaprig.twin_run import TwinRun, gather

__all__ = ["Twin", "TwinRun"]

Array = NDArray[np.float64]

# MuJoCo steps of the usual length [s]
TIME_STEP = 0.002
# longest and shortest step accepted [s]
LEAST_STEP, MOST_STEP = 1e-6, 0.02
# what a servo rig can mean by a frequency [Hz]
LEAST_FREQUENCY, MOST_FREQUENCY = 1e-3, 100.0
# steps of one run: some hundred bytes each are kept
MOST_STEPS = 5_000_000
# smallest half sweep amplitude [rad]: the coefficients divide by its square
LEAST_AMPLITUDE = 1e-6


@dataclass(frozen=True)
class Twin:
    """A rig ready to run strokes.

    Attributes:
        rig: the rig; the frequency that its wake is set for is replaced by the stroke's.
        time_step: of MuJoCo in [s], 1e-6 to 0.02. A run takes the nearest step that divides the
            cycle, and at least one step for each step of the wake; see TwinRun.time_step.
        feedforward: whether the servos are also given the torque that the stroke needs in fluid
            without a wake. Off: a servo of the shop has no model of the water.

    Raises:
        ValueError: an attribute of the wrong type or out of its range.
    """

    rig: Rig
    time_step: float = TIME_STEP
    feedforward: bool = False

    def __post_init__(self) -> None:
        if not isinstance(self.rig, Rig):
            raise check.fail("Twin", "rig", "a Rig, as Rig.load() gives it", self.rig)
        step = check.in_range("Twin", "time_step", self.time_step, LEAST_STEP, MOST_STEP, "s")
        object.__setattr__(self, "time_step", step)
        if not isinstance(self.feedforward, bool):
            raise check.fail("Twin", "feedforward", "True or False", self.feedforward)

    def run(self, stroke: Stroke, cycles: int = 3, progress: Progress | None = None) -> TwinRun:
        """Let the servos follow a stroke, from standstill at its first posture in still fluid.

        A rig is put in place before it starts, and nothing moves then: a stroke that begins with a
        rate is caught up with within the first tenths of a second, as by the real servo.

        Args:
            stroke: what the servos are asked for.
            cycles: number of cycles, 1 to 1000; means leave out the first two where there are more.
            progress: called with the fraction done.

        Raises:
            ValueError: a stroke that leaves the joints' range, or a number out of range.
            FloatingPointError: MuJoCo gave up; says when.
            ImportError: the plugin library is missing or does not fit MuJoCo.
        """
        _check_stroke(stroke)
        cycles = check.whole("Twin.run", "cycles", cycles, 1, 1000)
        steps = self.steps_per_cycle(stroke)
        if cycles * steps > MOST_STEPS:
            allowed = f"at most {MOST_STEPS // steps} with {steps} steps in each"
            raise check.fail("Twin.run", "cycles", allowed, cycles)
        model = self.compile(stroke)
        motion = stroke.motion(np.arange(cycles * steps + 1) / (steps * stroke.frequency))
        _check_range(model, motion)
        control = _controls(model, motion)
        if self.feedforward:
            control[:, controls(model).torque] = _still_fluid_torques(model, motion)
        log = drive(model, _at_rest(model, motion), control, progress)
        rig = self.rig.with_(frequency=stroke.frequency)
        return gather(rig, model, stroke, motion, log, steps, cycles)

    def steps_per_cycle(self, stroke: Stroke) -> int:
        """MuJoCo steps in one cycle of the stroke: a whole number, no fewer than the wake's."""
        wanted = round(1.0 / (stroke.frequency * self.time_step))
        return max(wanted, self.rig.model.steps_per_cycle)

    def compile(self, stroke: Stroke) -> mujoco.MjModel:
        """The rig's model with the time step and the wake's clock for a stroke."""
        model = self.rig.with_(frequency=stroke.frequency).compile()
        model.opt.timestep = 1.0 / (stroke.frequency * self.steps_per_cycle(stroke))
        # the log reads torques as this integrator makes them
        model.opt.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
        return model


def _check_stroke(stroke: Stroke) -> None:
    owner = "Twin.run"
    if not isinstance(stroke, Stroke):
        raise check.fail(owner, "stroke", "a stroke, for instance a SunTangStroke", stroke)
    limits = (LEAST_FREQUENCY, MOST_FREQUENCY, "Hz")
    check.in_range(owner, "stroke.frequency", stroke.frequency, *limits)
    if not stroke.sweep_amplitude >= LEAST_AMPLITUDE:
        allowed = f"at least {LEAST_AMPLITUDE} rad (coefficients divide by the sweep's speed)"
        raise check.fail(owner, "stroke.sweep_amplitude", allowed, stroke.sweep_amplitude)


def _check_range(model: mujoco.MjModel, motion: Motion) -> None:
    """The stroke must stay inside the joints' stops."""
    for axis in Axis:
        joint, angle = model.joint(axis), getattr(motion, axis)
        low, high = joint.range if joint.limited[0] else (-np.inf, np.inf)
        worst = float(angle[np.argmax(np.maximum(low - angle, angle - high))])
        if not low <= worst <= high:
            allowed = (
                f"within the joint's range, {low:.4f} to {high:.4f} rad "
                f"({np.degrees(low):.0f} to {np.degrees(high):.0f} deg)"
            )
            raise check.fail("Twin.run", f"stroke's {axis}", allowed, round(worst, 4))


def _controls(model: mujoco.MjModel, motion: Motion) -> Array:
    """Set points of every step. Shape (n, nu)."""
    where = controls(model)
    table = np.zeros((motion.time.size - 1, model.nu))
    table[:, where.position] = np.column_stack([motion.sweep, motion.pitch])[:-1]
    table[:, where.velocity] = np.column_stack([motion.sweep_rate, motion.pitch_rate])[1:]
    return table


def _at_rest(model: mujoco.MjModel, motion: Motion) -> mujoco.MjData:
    """The rig standing at the motion's first posture, in fluid without a wake."""
    data = mujoco.MjData(model)
    data.qpos[coordinates(model)[0]] = motion.sweep[0], motion.pitch[0]
    return data


def _still_fluid_torques(model: mujoco.MjModel, motion: Motion) -> Array:
    """Inverse dynamics of the motion without a wake, in [N m]. Shape (n, 2).

    mj_inverse uses the M that holds the fluid's added mass already: nothing is to be added.
    """
    data = mujoco.MjData(model)
    angle, rate = coordinates(model)
    table = np.empty((motion.time.size - 1, 2))
    for k in range(len(table)):
        data.qpos[angle] = motion.sweep[k], motion.pitch[k]
        data.qvel[rate] = motion.sweep_rate[k], motion.pitch_rate[k]
        data.qacc[rate] = motion.sweep_acceleration[k], motion.pitch_acceleration[k]
        mujoco.mj_inverse(model, data)
        table[k] = data.qfrc_inverse[rate]
    return table
