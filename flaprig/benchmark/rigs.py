"""The rig in MuJoCo with and without air, stepped along the sinusoid."""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from flaprig.aero.models import UVLM, QuasiSteady
from flaprig.benchmark.benchmark import STROKE
from flaprig.rig import Rig, controls

Array = NDArray[np.float64]

# MuJoCo steps for which a set point is held: in between nothing is Python
HELD = 25


def wet(model: UVLM | QuasiSteady, steps: int) -> mujoco.MjModel:
    """The rig in water.

    Args:
        model: of the air.
        steps: of MuJoCo in a cycle of the sinusoid.
    """
    return _clocked(Rig.load().with_(model=model).running(STROKE).compile(), steps)


def bare(steps: int) -> mujoco.MjModel:
    """The rig without plugin: neither its forces nor its two sensors are there."""
    spec = Rig.load().spec()
    for sensor in list(spec.sensors):
        if sensor.type == mujoco.mjtSensor.mjSENS_PLUGIN:
            spec.delete(sensor)
    for body in spec.bodies:
        if body.plugin.active:
            body.plugin.active, body.plugin.name = False, ""
    for instance in list(spec.plugins):
        spec.delete(instance)
    return _clocked(spec.compile(), steps)


def _clocked(model: mujoco.MjModel, steps: int) -> mujoco.MjModel:
    model.opt.timestep = STROKE.period / steps
    return model


@dataclass(frozen=True, eq=False)
class Driven:
    """A rig whose servos are told the sinusoid.

    Attributes:
        model: of the rig.
        data: its state, which goes on from call to call.
        table: inputs of the servos, each held for HELD steps. Shape (n, nu).
    """

    model: mujoco.MjModel
    data: mujoco.MjData
    table: Array

    @classmethod
    def of(cls, model: mujoco.MjModel) -> Driven:
        """The rig at rest at the stroke's first posture."""
        data = mujoco.MjData(model)
        mujoco.mj_resetDataKeyframe(model, data, 0)
        count = max(1, round(STROKE.period / model.opt.timestep / HELD))
        motion = STROKE.motion(np.arange(count) * HELD * model.opt.timestep)
        where, table = controls(model), np.zeros((count, model.nu))
        table[:, where.position] = np.column_stack([motion.sweep, motion.pitch])
        table[:, where.velocity] = np.column_stack([motion.sweep_rate, motion.pitch_rate])
        return cls(model, data, table)

    @property
    def steps(self) -> int:
        """MuJoCo steps in `cycle`."""
        return HELD * len(self.table)

    def cycle(self) -> None:
        """Step through one cycle."""
        for inputs in self.table:
            self.data.ctrl[:] = inputs
            mujoco.mj_step(self.model, self.data, HELD)
