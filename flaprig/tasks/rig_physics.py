"""The rig as dm_control's Physics, with named readings."""

from __future__ import annotations

import copy
import importlib
from functools import cached_property
from typing import Any, ClassVar, Self

import mujoco
import numpy as np
from dm_control.mujoco import Physics
from dm_control.mujoco.engine import Contexts
from dm_control.mujoco.wrapper import MjModel, MjrContext
from dm_control.rl.control import PhysicsError
from numpy.typing import NDArray

from flaprig.render import gl
from flaprig.rig import Controls, Sensor, controls, coordinates, readings
from flaprig.tasks.copies import packed, unpacked

Array = NDArray[np.float64]

# lift, drag and power in the sensor of the fluid
_LIFT, _DRAG, _POWER = 6, 7, 8
# dm_control's classes that draw, by the name of the library
_RENDERERS = {
    "egl": ("pyopengl.egl_renderer", "EGLContext"),
    "osmesa": ("pyopengl.osmesa_renderer", "OSMesaContext"),
    "glfw": ("glfw_renderer", "GLFWContext"),
}


class RigPhysics(Physics):
    """The rig; arrays of two are sweep, then pitch, and are the caller's own.

    MuJoCo's sensors are those of the last step's beginning. A step that MuJoCo gives up in is
    remembered in `failure` and not raised: one episode's end is not the program's. Copies and
    pickles step like the original, bit for bit, and share nothing with it.
    """

    # MuJoCo's own order of a step: the other one kicks after a reset and after a copy
    legacy_step: bool = False
    # why MuJoCo or the task gave up since the last reset
    failure: str | None = None
    # what a copy takes along beside MuJoCo's data
    _kept: ClassVar[tuple[str, ...]] = ("legacy_step", "failure")

    @classmethod
    def of(cls, model: mujoco.MjModel) -> Self:
        """Physics of a compiled rig."""
        physics: Self = cls.from_model(MjModel(model))
        return physics

    def __getstate__(self) -> tuple[bytes, dict[str, Any]]:
        return packed(self.data), {name: getattr(self, name) for name in self._kept}

    def __setstate__(self, state: tuple[bytes, dict[str, Any]]) -> None:
        data, kept = state
        super().__setstate__(unpacked(data))
        self._take_over(unpacked(data).ptr, kept)

    def copy(self, share_model: bool = False) -> Self:
        """As Physics: the same state, which steps like this one."""
        made: Self = super().copy(share_model)
        kept = {name: getattr(self, name) for name in self._kept}
        made._take_over(self.data.ptr, copy.deepcopy(kept))
        return made

    def __copy__(self) -> Self:
        return self.copy()

    def _take_over(self, data: mujoco.MjData, kept: dict[str, Any]) -> None:
        # Physics computes what follows from the state anew, with the motors off
        mujoco.mj_copyData(self.data.ptr, self.model.ptr, data)
        for name, value in kept.items():
            setattr(self, name, value)

    def _make_rendering_contexts(self) -> None:
        """As Physics, with a library that works here; dm_control takes the first it can import.

        Raises:
            RuntimeError: none works; the sentence says what to install.
        """
        name = gl.backend()
        if name not in _RENDERERS:
            raise RuntimeError(f"no OpenGL library draws pictures here: {gl.ADVICE}")
        room, kind = _RENDERERS[name]
        renderer = getattr(importlib.import_module(f"dm_control._render.{room}"), kind)
        size = self.model.vis.global_
        context = renderer(max_width=size.offwidth, max_height=size.offheight)
        self._contexts = Contexts(gl=context, mujoco=MjrContext(self.model, context))

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
