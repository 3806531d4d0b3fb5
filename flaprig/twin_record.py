"""From a run's raw log to a TwinRun: histories, coefficients and the balance of energy."""

from __future__ import annotations

from math import ceil

import mujoco
import numpy as np
from numpy.typing import NDArray

from flaprig.aero.buoyancy import buoyant_energy, buoyant_torque
from flaprig.aero.histories import Histories
from flaprig.aero.loads import side_force, sweep_direction, upward
from flaprig.aero.result import Result, averaged_cycles
from flaprig.aero.simulate import reference_force
from flaprig.energy import EnergyBalance, solid_energy
from flaprig.motor_record import motor_histories
from flaprig.rig import Rig, Sensor, coordinates, readings
from flaprig.set_points import SetPoints
from flaprig.strokes.stroke import Motion, Stroke
from flaprig.twin_log import StepLog
from flaprig.twin_run import TwinRun

Array = NDArray[np.float64]


def settled_cycles(cycles: int, joined: float) -> tuple[int, int]:
    """First and last cycle of the means: the usual ones, less those that hold the start.

    Args:
        cycles: of the run.
        joined: when the stroke was caught up with, in cycles.
    """
    first, last = averaged_cycles(cycles)
    return min(max(first, ceil(joined) + 1), last), last


def gather(
    rig: Rig,
    model: mujoco.MjModel,
    stroke: Stroke,
    points: SetPoints,
    control: Array,
    log: StepLog,
    cycles: int,
    told: tuple[str, ...] = (),
) -> TwinRun:
    """A run's raw log as histories, coefficients and balance."""
    sensors = {name: log.sensors[:, part] for name, part in readings(model).items()}
    force = reference_force(rig.wing, stroke, rig.fluid)
    histories = _histories(model, points.motion, log, sensors[Sensor.AERO])
    if rig.buoyancy:
        torque = buoyant_torque(rig.wing, rig.fluid, histories.pitch, gravity(model))
        histories = histories.with_buoyancy(torque)
    averaged = settled_cycles(cycles, points.joined_at * stroke.frequency)
    return TwinRun(
        result=Result(histories, force, len(control) // cycles, averaged).doubted(stroke),
        motors=motor_histories(rig, model, points.motion, control, log),
        servos=rig.motors,
        commanded=points.motion,
        asked=stroke,
        projection=points.projection,
        joined_at=points.joined_at,
        energy=balance(rig, model, log, histories.power, cycles),
        fluid_wrench=sensors[Sensor.AERO][:, :6],
        load_cell=sensors[Sensor.LOAD_CELL],
        time_step=model.opt.timestep,
        told=told,
    )


def _histories(model: mujoco.MjModel, motion: Motion, log: StepLog, aero: Array) -> Histories:
    """The fluid's loads, in the pose of each step's beginning."""
    angle, rate = coordinates(model)
    sweep, pitch = log.qpos[:-1, angle].T
    sweep_rate, pitch_rate = log.qvel[:-1, rate].T
    step = model.opt.timestep
    acceleration = np.diff(log.qvel[:, rate[0]]) / step
    # as of prescribed motion: the sensor's own drag is against the motion through the fluid
    drag = sweep_direction(sweep_rate, acceleration, step) * side_force(aero[:, :3], pitch)
    return Histories(
        time=motion.time[:-1],
        sweep=sweep,
        pitch=pitch,
        sweep_rate=sweep_rate,
        pitch_rate=pitch_rate,
        lift=upward(aero[:, :3], pitch),
        drag=drag,
        # torque about z; the pitch axis is -span
        sweep_torque=upward(aero[:, 3:6], pitch),
        pitch_torque=-aero[:, 4],
        power=aero[:, 8],
    )


def gravity(model: mujoco.MjModel) -> float:
    """Size of gravity in a rig's model in [m/s2]; 0 where it is switched off."""
    off = model.opt.disableflags & int(mujoco.mjtDisableBit.mjDSBL_GRAVITY)
    return 0.0 if off else float(-model.opt.gravity[2])


def balance(
    rig: Rig, model: mujoco.MjModel, log: StepLog, power: Array, parts: int
) -> EnergyBalance:
    """Where the motors' work went in each of so many equal parts of a run.

    Args:
        rig: whose plate and fluid they are.
        model: as it ran.
        log: of the run of n steps.
        power: given to the moving fluid in [W]. Shape (n,).
        parts: usually the cycles.
    """
    step, velocity = model.opt.timestep, log.mean_qvel
    edges = np.linspace(0, len(velocity), parts + 1).astype(int)
    stored = np.array([solid_energy(model, log.qpos[k], log.qvel[k]) for k in edges])
    if rig.buoyancy:
        pitch = log.qpos[edges, coordinates(model)[0][1]]
        stored[:, 1] += buoyant_energy(rig.wing, rig.fluid, pitch, gravity(model))

    def work(power: Array) -> Array:
        return np.asarray(power.reshape(parts, -1).sum(axis=1) * step)

    return EnergyBalance(
        motor_work=work(np.einsum("nj,nj->n", log.generalized_force, velocity)),
        fluid_work=work(power),
        kinetic=np.diff(stored[:, 0]),
        potential=np.diff(stored[:, 1]),
        losses=work(-np.einsum("nj,nj->n", log.loss_force, velocity)),
    )
