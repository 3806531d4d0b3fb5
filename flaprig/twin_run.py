"""What a run of the twin returns: the fluid's loads, the servos' work, how well they followed."""

from __future__ import annotations

import os
from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from flaprig.aero.histories import Histories
from flaprig.aero.result import Result, averaged_cycles
from flaprig.aero.rigid_motion import wing_axes
from flaprig.aero.simulate import reference_force
from flaprig.energy import EnergyBalance, solid_energy
from flaprig.files import write_table
from flaprig.motor_histories import MotorHistories
from flaprig.rig import Axis, Rig, Sensor, coordinates, readings
from flaprig.strokes.stroke import Motion, Stroke
from flaprig.twin_log import StepLog

Array = NDArray[np.float64]

# parts of a six-axis wrench, with their units
_PARTS = ("force_x_N", "force_y_N", "force_z_N", "torque_x_Nm", "torque_y_Nm", "torque_z_Nm")


@dataclass(frozen=True, eq=False)
class TwinRun:
    """A run of the rig. Row k of every history is the step that begins at time[k].

    Attributes:
        result: loads and coefficients of the motion really made; the coefficients divide by the
            reference force of the stroke asked for.
        motors: commands, torques, currents and temperatures of the servos.
        energy: balance of every cycle.
        fluid_wrench: of the fluid on the wing, wing frame, about its origin [N, N m]. Shape (n, 6).
        load_cell: of the wing on its mount, in the cell's frame [N, N m]. Shape (n, 6).
        time_step: of MuJoCo in [s]: the one asked for, made to divide the cycle.
    """

    result: Result
    motors: MotorHistories
    energy: EnergyBalance
    fluid_wrench: Array
    load_cell: Array
    time_step: float

    def tracking_error(self, axis: Axis | str) -> Array:
        """Angle reached minus angle asked for, in [rad], over the averaged cycles. Shape (m,)."""
        name = Axis(axis).value
        asked, reached = getattr(self.motors, f"{name}_command"), getattr(self.motors, name)
        return self.result.averaged(reached - asked)

    def columns(self) -> dict[str, Array]:
        """All histories by name with unit: those of result and motors, both wrenches."""
        wrenches = {
            f"{name}_{part}": values[:, i]
            for name, values in (("fluid", self.fluid_wrench), ("load_cell", self.load_cell))
            for i, part in enumerate(_PARTS)
        }
        return self.result.histories.columns() | self.motors.columns() | wrenches

    def summary(self) -> dict[str, float | list[int] | list[float]]:
        """The result's summary, the servos' and the balance, with SI units in the names."""
        servos: dict[str, float | list[int] | list[float]] = {}
        for axis in Axis:
            servos |= self._servo_summary(axis)
        balance: dict[str, float | list[int] | list[float]] = {
            "motor_work_J": self.energy.motor_work.tolist(),
            "fluid_work_J": self.energy.fluid_work.tolist(),
            "energy_residual_relative": self.energy.relative_residual.tolist(),
            "time_step_s": self.time_step,
        }
        return {**self.result.summary(), **servos, **balance}

    def _servo_summary(self, axis: Axis) -> dict[str, float]:
        error = self.tracking_error(axis)

        def averaged(name: str) -> Array:
            return np.asarray(self.result.averaged(getattr(self.motors, f"{axis}_{name}")))

        torque, power = averaged("motor_torque"), averaged("motor_power")
        numbers = {
            f"rms_{axis}_tracking_error_rad": np.sqrt(np.mean(error**2)),
            f"peak_{axis}_tracking_error_rad": np.abs(error).max(),
            f"peak_{axis}_motor_torque_Nm": np.abs(torque).max(),
            f"p99_{axis}_motor_torque_Nm": np.percentile(np.abs(torque), 99),
            f"rms_{axis}_motor_torque_Nm": np.sqrt(np.mean(torque**2)),
            f"mean_{axis}_motor_power_W": power.mean(),
            f"peak_{axis}_motor_power_W": np.abs(power).max(),
            f"peak_{axis}_current_A": np.abs(averaged("current")).max(),
            f"peak_{axis}_temperature_degC": averaged("temperature").max(),
        }
        return {name: float(value) for name, value in numbers.items()}

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write all histories: CSV or NPZ by the path's ending, units in the header.

        The NPZ also holds the summary as JSON text. Written to a temporary file, then renamed.

        Raises:
            ValueError: an ending that is neither .csv nor .npz.
            OSError: the folder does not exist or cannot be written.
        """
        write_table("TwinRun.save", path, self.columns(), self.summary())


def gather(
    rig: Rig,
    model: mujoco.MjModel,
    stroke: Stroke,
    motion: Motion,
    log: StepLog,
    steps_per_cycle: int,
    cycles: int,
) -> TwinRun:
    """A run's raw log as histories, coefficients and balance."""
    sensors = {name: log.sensors[:, part] for name, part in readings(model).items()}
    force = reference_force(rig.wing, stroke, rig.fluid)
    histories = _histories(model, motion, log, sensors[Sensor.AERO])
    return TwinRun(
        result=Result(histories, force, steps_per_cycle, averaged_cycles(cycles)),
        motors=_motor_histories(rig, model, motion, log),
        energy=_balance(model, log, histories.power, cycles),
        fluid_wrench=sensors[Sensor.AERO][:, :6],
        load_cell=sensors[Sensor.LOAD_CELL],
        time_step=model.opt.timestep,
    )


def _histories(model: mujoco.MjModel, motion: Motion, log: StepLog, aero: Array) -> Histories:
    """The fluid's loads, in the pose of each step's beginning."""
    angle, rate = coordinates(model)
    sweep, pitch = log.qpos[:-1, angle].T
    sweep_rate, pitch_rate = log.qvel[:-1, rate].T
    up = wing_axes(sweep, pitch)[:, 2]
    return Histories(
        time=motion.time[:-1],
        sweep=sweep,
        pitch=pitch,
        sweep_rate=sweep_rate,
        pitch_rate=pitch_rate,
        lift=aero[:, 6],
        drag=aero[:, 7],
        # torque about z; the pitch axis is -span
        sweep_torque=np.einsum("nj,nj->n", up, aero[:, 3:6]),
        pitch_torque=-aero[:, 4],
        power=aero[:, 8],
    )


def _motor_histories(
    rig: Rig, model: mujoco.MjModel, motion: Motion, log: StepLog
) -> MotorHistories:
    angle, rate = coordinates(model)
    found: dict[str, Array] = {"time": motion.time[:-1]}
    for i, axis in enumerate(Axis):
        motor = getattr(rig.motors, axis)
        torque = log.generalized_force[:, rate[i]]
        warmth = log.activation[:, model.actuator(axis).actadr[0]]
        found |= {
            f"{axis}": log.qpos[:-1, angle[i]],
            f"{axis}_command": getattr(motion, axis)[:-1],
            f"{axis}_rate_command": getattr(motion, f"{axis}_rate")[1:],
            f"{axis}_motor_torque": torque,
            f"{axis}_motor_power": torque * log.mean_qvel[:, rate[i]],
            # the rotor's inertia is in M, so this is the torque of the current
            f"{axis}_current": torque / motor.torque_constant,
            f"{axis}_temperature": motor.ambient_temperature + warmth,
        }
    return MotorHistories(**found)


def _balance(model: mujoco.MjModel, log: StepLog, power: Array, cycles: int) -> EnergyBalance:
    step, velocity = model.opt.timestep, log.mean_qvel
    edges = np.linspace(0, len(velocity), cycles + 1).astype(int)
    stored = np.array([solid_energy(model, log.qpos[k], log.qvel[k]) for k in edges])

    def work(power: Array) -> Array:
        return np.asarray(power.reshape(cycles, -1).sum(axis=1) * step)

    return EnergyBalance(
        motor_work=work(np.einsum("nj,nj->n", log.generalized_force, velocity)),
        fluid_work=work(power),
        kinetic=np.diff(stored[:, 0]),
        potential=np.diff(stored[:, 1]),
        losses=work(-np.einsum("nj,nj->n", log.loss_force, velocity)),
    )
