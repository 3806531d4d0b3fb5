"""The digital twin: the rig's servos follow a stroke in MuJoCo, and the fluid answers.

The stroke goes onto the joints' limits, through Ruckig from rest, and over the link to the servos.
Each servo gets the angle of a step's beginning and the rate of its end: implicitfast takes position
forces at the old state and rate forces at the new one, so a motor that follows perfectly is asked
for nothing, whatever the time step.
"""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from flaprig import _checks as check
from flaprig.aero.air import Progress
from flaprig.feedforward import needed_torques
from flaprig.limits import Limits
from flaprig.motor_record import aim_address
from flaprig.rig import Axis, Rig, controls, coordinates
from flaprig.servo_link import PERFECT, ServoLink
from flaprig.set_points import Own, SetPoints, check_stops, own_limits, set_points
from flaprig.strokes.stroke import Motion, Stroke, check_stroke
from flaprig.twin_log import drive
from flaprig.twin_record import gather
from flaprig.twin_run import TOLD, TwinRun

__all__ = ["Own", "ServoLink", "Twin", "TwinRun"]

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
        feedforward: whether the servos are also given the torque that the motion needs, by a
            quasi-steady model of the air (docs/servo_lag.md). Without it they are two to eight
            times as far off, up to 0.2 deg at 0.2 Hz; a servo of the shop has no such model.
        limits: what the joints can do. A stroke beyond them is replaced by the nearest one within,
            and every run begins with a jerk-limited start (its time steps are then 1e-5 s or more).
            Own.RIG: the rig's own, from its servos, wing, fluid and stops. None: the stroke as it
            is, all at once.
        link: what the servos hear of their set points.

    Raises:
        ValueError: an attribute of the wrong type or out of its range.
    """

    rig: Rig
    time_step: float = TIME_STEP
    feedforward: bool = True
    limits: Limits | Own | None = Own.RIG
    link: ServoLink = PERFECT

    def __post_init__(self) -> None:
        if not isinstance(self.rig, Rig):
            raise check.fail("Twin", "rig", "a Rig, as Rig.load() gives it", self.rig)
        step = check.in_range("Twin", "time_step", self.time_step, LEAST_STEP, MOST_STEP, "s")
        object.__setattr__(self, "time_step", step)
        if not isinstance(self.feedforward, bool):
            raise check.fail("Twin", "feedforward", "True or False", self.feedforward)
        if not isinstance(self.limits, Limits | Own | None):
            raise check.fail("Twin", "limits", "a Limits, Own.RIG or None", self.limits)
        if not isinstance(self.link, ServoLink):
            raise check.fail("Twin", "link", "a ServoLink", self.link)

    def run(self, stroke: Stroke, cycles: int = 3, progress: Progress | None = None) -> TwinRun:
        """Let the servos follow a stroke, from standstill at its first posture in still fluid.

        The stroke's time begins with the run: within limits it is caught up with in the first
        tenths of a second (TwinRun.joined_at), and no cycle is added for that.

        Args:
            stroke: what the rig is asked for.
            cycles: number of cycles, 1 to 1000; means leave out the first two where there are more.
            progress: called with the fraction done.

        Raises:
            ValueError: a number out of range, or set points that leave the joints' stops.
            RuntimeError: the limits leave no way onto the stroke.
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
        points, control = self.commands(model, stroke, cycles)
        log = drive(model, at_rest(model, points.motion), control, progress)
        rig = self.rig.running(stroke)
        told = (*self.rounded(model.opt.timestep), *clipped(model, control))
        return gather(rig, model, stroke, points, control, log, cycles, told)

    def rounded(self, time_step: float) -> tuple[str, ...]:
        """Sentences on times that were rounded to whole steps, or steps to the cycle.

        Args:
            time_step: of the run in [s].
        """
        found = []
        if abs(time_step / self.time_step - 1.0) > TOLD:
            found.append(
                f"the time step is {time_step:.6g} s instead of {self.time_step:.6g} s: it divides "
                "the cycle, and the wake has a row a step at most"
            )
        for name, least in (("update_interval", 1), ("delay", 0)):
            asked = getattr(self.link, name)
            made = max(least, round(asked / time_step)) * time_step
            if asked > 0.0 and abs(made - asked) > TOLD * asked:
                words = name.replace("_", " ")
                found.append(f"the link's {words} is {made:.4g} s instead of {asked:.4g} s")
        return tuple(found)

    def commands(
        self, model: mujoco.MjModel, stroke: Stroke, cycles: int
    ) -> tuple[SetPoints, Array]:
        """What the servos are to do, and `data.ctrl` of every step. Shape of the latter (n, nu).

        Args:
            model: as `compile` makes it for the stroke.
            stroke: what the rig is asked for.
            cycles: number of cycles.

        Raises:
            ValueError: set points that leave the joints' stops, or limits that cannot be used.
            RuntimeError: the limits leave no way onto the stroke.
        """
        steps, time_step = self.steps_per_cycle(stroke), model.opt.timestep
        limits = own_limits(self.rig, model) if isinstance(self.limits, Own) else self.limits
        points = set_points(stroke, limits, time_step, cycles * steps)
        check_stops(model, points.motion)
        torque = self._torques(points, steps) if self.feedforward else None
        return points, _controls(model, points.motion, self.link, torque)

    def _torques(self, points: SetPoints, steps: int) -> Array:
        """Feedforward of every step; the cycles after the start share one. Shape (n, 2)."""
        motion = points.motion
        step = np.arange(motion.time.size - 1)
        first = int(np.searchsorted(motion.time, points.joined_at)) + 1
        once = min(first + steps, step.size)
        part = Motion(*(getattr(motion, name)[: once + 1] for name in Motion.__dataclass_fields__))
        torque = needed_torques(self.rig, part)
        if not self.link.velocity:
            # the servo brakes on its whole rate then
            motors = self.rig.motors
            brakes = np.array([motors.sweep.damping, motors.pitch.damping])
            torque += brakes * np.column_stack([part.sweep_rate, part.pitch_rate])[1:]
        return torque[np.where(step < once, step, first + (step - first) % steps)]

    def steps_per_cycle(self, stroke: Stroke) -> int:
        """MuJoCo steps in one cycle of the stroke: a whole number, no fewer than the wake's."""
        wanted = round(1.0 / (stroke.frequency * self.time_step))
        return max(wanted, self.rig.model.steps_per_cycle)

    def compile(self, stroke: Stroke) -> mujoco.MjModel:
        """The rig's model with the time step and the wake's clock for a stroke."""
        model = self.rig.running(stroke).compile()
        model.opt.timestep = 1.0 / (stroke.frequency * self.steps_per_cycle(stroke))
        # the log reads torques as this integrator makes them
        model.opt.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
        return model


def clipped(model: mujoco.MjModel, control: Array) -> list[str]:
    """Sentences on servos whose range of controls in the file cuts what they are told.

    Args:
        model: of the rig.
        control: inputs of every step. Shape (n, nu).
    """
    found, where = [], controls(model)
    for i, axis in enumerate(Axis):
        inputs = {
            "angle [rad]": where.position[i],
            "rate [rad/s]": where.velocity[i],
            "torque [N m]": where.torque[i],
        }
        for words, address in inputs.items():
            told, (low, high) = control[:, address], model.actuator_ctrlrange[address]
            if model.actuator_ctrllimited[address] and (told.min() < low or told.max() > high):
                most = f"{np.abs(told).max():.4g}"
                found.append(
                    f"the {axis} servo was told a set point of {words} up to {most}, which its "
                    f"ctrlrange of {low:.4g} to {high:.4g} cut"
                )
    return found


def _check_stroke(stroke: Stroke) -> None:
    owner = "Twin.run"
    check_stroke(owner, stroke)
    limits = (LEAST_FREQUENCY, MOST_FREQUENCY, "Hz")
    check.in_range(owner, "stroke.frequency", stroke.frequency, *limits)
    if not stroke.sweep_amplitude >= LEAST_AMPLITUDE:
        allowed = f"at least {LEAST_AMPLITUDE} rad (coefficients divide by the sweep's speed)"
        raise check.fail(owner, "stroke.sweep_amplitude", allowed, stroke.sweep_amplitude)


def at_rest(model: mujoco.MjModel, motion: Motion) -> mujoco.MjData:
    """The rig standing at the motion's first posture, in fluid without a wake."""
    data = mujoco.MjData(model)
    posture = motion.sweep[0], motion.pitch[0]
    data.qpos[coordinates(model)[0]] = posture
    for axis, angle in zip(Axis, posture, strict=True):
        aim = aim_address(model, axis)
        if aim is not None:
            data.act[aim] = angle
    return data


def _controls(
    model: mujoco.MjModel, motion: Motion, link: ServoLink, torque: Array | None
) -> Array:
    """Inputs of every step, as the servos hear them. Shape (n, nu)."""
    where = controls(model)
    heard = link.heard(motion.time.size - 1, model.opt.timestep)
    table = np.zeros((heard.size, model.nu))
    angles = np.column_stack([motion.sweep, motion.pitch])[heard]
    table[:, where.position] = link.rounded(angles)
    if link.velocity:
        rates = np.column_stack([motion.sweep_rate, motion.pitch_rate])
        table[:, where.velocity] = rates[heard + 1]
    if torque is not None:
        table[:, where.torque] = torque[heard]
    return table
