"""The servos' histories of a run, from its raw log."""

from __future__ import annotations

import mujoco
import numpy as np
from numpy.typing import NDArray

from flaprig.motor_histories import MotorHistories
from flaprig.motors import Motor
from flaprig.rig import Axis, Rig, controls, coordinates
from flaprig.strokes.stroke import Motion
from flaprig.twin_log import StepLog

Array = NDArray[np.float64]


def motor_histories(
    rig: Rig, model: mujoco.MjModel, motion: Motion, control: Array, log: StepLog
) -> MotorHistories:
    """Both servos of a run.

    Args:
        rig: whose motors they are.
        model: as it ran.
        motion: the set points before the link.
        control: inputs of every step. Shape (n, nu).
        log: of the run.
    """
    angle, rate = coordinates(model)
    where = controls(model)
    found: dict[str, Array] = {"time": motion.time[:-1]}
    for i, axis in enumerate(Axis):
        motor: Motor = getattr(rig.motors, axis)
        torque = log.generalized_force[:, rate[i]]
        told = control[:, where.position[i]]
        told_rate = control[:, where.velocity[i]]
        told_torque = control[:, where.torque[i]]
        address = aim_address(model, axis)
        aim = told if address is None else log.activation[:, address]
        warmth = log.activation[:, temperature_address(model, axis)]
        begin, end = log.qvel[:-1, rate[i]], log.qvel[1:, rate[i]]
        # the rate is that of the step's end, as the integrator takes it
        demand = motor.stiffness * (aim - log.qpos[:-1, angle[i]])
        demand += motor.damping * (told_rate - end) + told_torque
        # the law before the integrator, which is what the supply limits; the winding counts as cold
        volts = motor.resistance / motor.torque_constant * (demand + motor.damping * (end - begin))
        volts += motor.torque_constant * begin
        found |= {
            f"{axis}": log.qpos[:-1, angle[i]],
            f"{axis}_command": getattr(motion, axis)[:-1],
            f"{axis}_rate_command": getattr(motion, f"{axis}_rate")[1:],
            f"{axis}_set_point": told,
            f"{axis}_rate_set_point": told_rate,
            f"{axis}_feedforward": told_torque,
            f"{axis}_demand": demand,
            f"{axis}_voltage": volts,
            f"{axis}_motor_torque": torque,
            f"{axis}_motor_power": torque * log.mean_qvel[:, rate[i]],
            # the rotor's inertia is in M, so this is the torque of the current
            f"{axis}_current": torque / motor.torque_constant,
            f"{axis}_temperature": motor.ambient_temperature + warmth,
        }
    return MotorHistories(**found)


def aim_address(model: mujoco.MjModel, axis: Axis) -> int | None:
    """Where in `data.act` a servo with a slew rate has its moving aim; None for one without."""
    servo = model.actuator(axis)
    return int(servo.actadr[0]) if servo.actnum[0] == 2 else None


def temperature_address(model: mujoco.MjModel, axis: Axis) -> int:
    """Where in `data.act` a servo has its winding's rise above ambient: its last state."""
    servo = model.actuator(axis)
    return int(servo.actadr[0] + servo.actnum[0] - 1)
