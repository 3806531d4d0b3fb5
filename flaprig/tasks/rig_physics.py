"""The rig as dm_control's Physics, with named readings."""

from __future__ import annotations

from functools import cached_property
from typing import Any, Self

import mujoco
import numpy as np
from dm_control.mujoco import Physics
from dm_control.mujoco.wrapper import MjModel
from dm_control.rl.control import PhysicsError
from numpy.typing import NDArray

from flaprig.rig import Controls, Sensor, controls, coordinates, readings

Array = NDArray[np.float64]

# lift, drag and power in the sensor of the fluid
_LIFT, _DRAG, _POWER = 6, 7, 8


class RigPhysics(Physics):
    """The rig; arrays of two are sweep, then pitch, and are the caller's own.

    MuJoCo's sensors are those of the last step's beginning. A step that MuJoCo gives up in is
    remembered in `failure` and not raised: one episode's end is not the program's.
    """

    # why MuJoCo gave up since the last reset
    failure: str | None = None

    @classmethod
    def of(cls, model: mujoco.MjModel) -> Self:
        """Physics of a compiled rig."""
        physics: Self = cls.from_model(MjModel(model))
        return physics

    def reset(self, keyframe_id: int | None = None) -> None:
        """As Physics, and forget the failure."""
        self.failure = None
        super().reset(keyframe_id)

    def step(self, nstep: int = 1) -> None:
        """As Physics; what MuJoCo gives up on ends in `failure`."""
        try:
            super().step(nstep)
        except PhysicsError as error:
            self.failure = " ".join(str(error).split())

    def angles(self) -> Array:
        """Sweep and pitch in [rad]. Shape (2,)."""
        return np.array(self.data.qpos[self._coordinates[0]])

    def rates(self) -> Array:
        """In [rad/s]. Shape (2,)."""
        return np.array(self.data.qvel[self._coordinates[1]])

    def set_motion(self, angles: Any, rates: Any) -> None:
        """Put the joints into a posture in [rad] that moves in [rad/s]."""
        self.data.qpos[self._coordinates[0]] = angles
        self.data.qvel[self._coordinates[1]] = rates

    def push(self, torques: Array) -> None:
        """Torques in [N m] from outside on both joints, until the next ones."""
        self.data.qfrc_applied[self._coordinates[1]] = torques

    @property
    def controls(self) -> Controls:
        """Where the servos' set points are in `data.ctrl`; never use dm_control's names there."""
        return self._controls

    def lift(self) -> float:
        """Upward force of the fluid in [N]."""
        return float(self._read(Sensor.AERO)[_LIFT])

    def drag(self) -> float:
        """Force of the fluid against the sweep in [N]."""
        return float(self._read(Sensor.AERO)[_DRAG])

    def power(self) -> float:
        """Given to the fluid in [W]."""
        return float(self._read(Sensor.AERO)[_POWER])

    def torques(self) -> Array:
        """Of both servos in [N m], as MuJoCo's sensors read them. Shape (2,)."""
        sensors = (Sensor.SWEEP_TORQUE, Sensor.PITCH_TORQUE)
        return np.concatenate([self._read(sensor) for sensor in sensors])

    def _read(self, sensor: Sensor) -> Array:
        return np.array(self.data.sensordata[self._readings[sensor]])

    @cached_property
    def _coordinates(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        return coordinates(self.model.ptr)

    @cached_property
    def _readings(self) -> dict[Sensor, slice]:
        return readings(self.model.ptr)

    @cached_property
    def _controls(self) -> Controls:
        return controls(self.model.ptr)
