"""The names in a rig's file: bodies, joints, sites, sensors and servos, with their addresses.

The only place that knows the names used in models/rig.xml.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import mujoco
import numpy as np
from numpy.typing import NDArray

from flaprig import _checks as check


class Body(StrEnum):
    """Bodies that move."""

    ARM = "arm"
    WING = "wing"


class Axis(StrEnum):
    """The two motions, in the order of qpos: names of the joints and of their servos."""

    SWEEP = "sweep"
    PITCH = "pitch"


class Site(StrEnum):
    """Frames on the wing."""

    WING_FRAME = "wing_frame"
    LOAD_CELL = "load_cell"


class Sensor(StrEnum):
    """What the rig measures.

    AERO: force xyz [N] and torque xyz [N m] of the moving fluid, without buoyancy, in the wing
    frame about its origin, lift and drag [N], power given to the fluid [W]. LOAD_CELL: force and
    torque that the wing exerts on its mount, weight and buoyancy in them, in the cell's frame.
    Encoders in [rad], velocities in [rad/s], torques in [N m]. MuJoCo reads the torques before its
    integrator corrects stiff servos: those of the step taken, a tenth of the peak away at 5 ms, are
    in `TwinRun.motors`.
    """

    AERO = "aero"
    LOAD_CELL = "load_cell"
    SWEEP_ENCODER = "sweep_encoder"
    PITCH_ENCODER = "pitch_encoder"
    SWEEP_VELOCITY = "sweep_velocity"
    PITCH_VELOCITY = "pitch_velocity"
    SWEEP_TORQUE = "sweep_torque"
    PITCH_TORQUE = "pitch_torque"


class Geom(StrEnum):
    """What changes with the wing: the plate, and shaft, cell and clamp drawn at its root."""

    PLATE = "plate"
    SHAFT = "shaft"
    CELL = "cell"
    CLAMP = "clamp"


class Camera(StrEnum):
    """Fixed views."""

    ISO = "iso"
    TOP = "top"
    TIP = "tip"


# housing of the servo that rides on the arm, whose geom may have the servo's mass
PITCH_SERVO = "pitch_servo"
# the fluid's plugin instance, and the keyframe at the start of a stroke
AIR = "air"
START = "start"
# the servo's inputs: position, velocity and torque feedforward
INPUTS = int(
    mujoco.mjtCtrlInput.mjINPUT_POS
    | mujoco.mjtCtrlInput.mjINPUT_VEL
    | mujoco.mjtCtrlInput.mjINPUT_FF
)


@dataclass(frozen=True)
class Controls:
    """Where the set points of the servos are in `data.ctrl`, in the order sweep, pitch.

    Attributes:
        position: addresses of the angles in [rad]. Shape (2,).
        velocity: addresses of the rates in [rad/s]. Shape (2,).
        torque: addresses of the torque feedforwards in [N m]. Shape (2,).
    """

    position: NDArray[np.int64]
    velocity: NDArray[np.int64]
    torque: NDArray[np.int64]


def controls(model: mujoco.MjModel) -> Controls:
    """Addresses of the set points, from `actuator_ctrladr`: each servo has three.

    dm_control's name index is wrong for servos of several inputs and must not be used.

    Raises:
        ValueError: the model has no servo of that name, or it takes other inputs.
    """
    first = np.array([_first_control(model, axis) for axis in Axis])
    return Controls(position=first, velocity=first + 1, torque=first + 2)


def coordinates(model: mujoco.MjModel) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Addresses of sweep and pitch in qpos and in qvel. Two arrays of shape (2,)."""
    joints = [model.joint(axis) for axis in Axis]
    return (
        np.array([joint.qposadr[0] for joint in joints]),
        np.array([joint.dofadr[0] for joint in joints]),
    )


def readings(model: mujoco.MjModel) -> dict[Sensor, slice]:
    """Where each sensor's numbers are in `data.sensordata`.

    The load cell's are six: MuJoCo gives all sensors of one plugin the same room.
    """
    found = {}
    for name in Sensor:
        sensor = model.sensor(name)
        start, width = int(sensor.adr[0]), int(sensor.dim[0])
        found[name] = slice(start, start + (6 if name is Sensor.LOAD_CELL else width))
    return found


def _first_control(model: mujoco.MjModel, axis: Axis) -> int:
    number = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_ACTUATOR, axis)
    if number < 0:
        raise check.fail("controls", "model", f"one with an actuator named {axis}", "none")
    if model.actuator_ctrlspec[number] != INPUTS:
        allowed = f"one whose actuator {axis} has the inputs pos vel ff"
        raise check.fail("controls", "model", allowed, int(model.actuator_ctrlspec[number]))
    return int(model.actuator_ctrladr[number])
