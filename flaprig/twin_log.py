"""Steps a MuJoCo model along commands and writes down what belongs to each step taken.

After `mj_step` the positions and velocities are the new ones, while M, the bias and the passive
forces are still those of the step's beginning; `qacc` is the step's acceleration under no implicit
integrator, (v_new - v_old)/dt is. So torques follow from M (v_new - v_old)/dt, M with the fluid's
added mass in it.
"""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from flaprig.aero.air import Progress

Array = NDArray[np.float64]

# how often progress is told
_TOLD = 100


@dataclass(frozen=True, eq=False)
class StepLog:
    """Raw arrays of a run of n steps; row k is the step from k to k + 1.

    Attributes:
        qpos: at the instants 0 to n. Shape (n + 1, nq).
        qvel: at the instants 0 to n. Shape (n + 1, nv).
        generalized_force: what motors gave on each degree of freedom [N m]. Shape (n, nv).
        loss_force: friction and stops on each degree of freedom [N m]. Shape (n, nv).
        sensors: sensordata of the step. Shape (n, nsensordata).
        activation: of the actuators at the step's end. Shape (n, na).
    """

    qpos: Array
    qvel: Array
    generalized_force: Array
    loss_force: Array
    sensors: Array
    activation: Array

    @property
    def mean_qvel(self) -> Array:
        """Mean velocity of each step. Shape (n, nv)."""
        return 0.5 * (self.qvel[1:] + self.qvel[:-1])


def empty_log(model: mujoco.MjModel, steps: int) -> StepLog:
    """Room for a run."""
    nv = model.nv
    widths = (model.nq, nv, nv, nv, model.nsensordata, model.na)
    rows = (steps + 1, steps + 1, steps, steps, steps, steps)
    return StepLog(*(np.zeros(shape) for shape in zip(rows, widths, strict=True)))


def drive(
    model: mujoco.MjModel, data: mujoco.MjData, control: Array, progress: Progress | None = None
) -> StepLog:
    """Step once per row of the controls, from the state that `data` is in.

    Args:
        model: the model; its integrator must be implicitfast or Euler.
        data: the state to begin with.
        control: actuator inputs. Shape (n, nu).
        progress: called with the fraction done.

    Raises:
        FloatingPointError: MuJoCo warned, as it does before it resets a state that is not finite.
    """
    steps = len(control)
    log = empty_log(model, steps)
    log.qpos[0], log.qvel[0] = data.qpos, data.qvel
    mujoco.mj_forward(model, data)
    # warnings of an earlier run are not ours
    data.warning.number[:] = 0
    slope, often = damping(model), max(1, steps // _TOLD)
    for k in range(steps):
        data.ctrl[:] = control[k]
        mujoco.mj_step(model, data)
        if data.warning.number.any():
            raise _stopped(data, k * model.opt.timestep)
        _write(model, data, log, k, slope)
        if progress is not None and ((k + 1) % often == 0 or k + 1 == steps):
            progress((k + 1) / steps)
    return log


def damping(model: mujoco.MjModel) -> Array:
    """Viscous friction of each degree of freedom in [N m s/rad], joints and gears. Shape (nv,)."""
    found = model.dof_damping.copy()
    for i in np.flatnonzero(model.actuator_damping):
        if model.actuator_trntype[i] == mujoco.mjtTrn.mjTRN_JOINT:
            dof = model.jnt_dofadr[model.actuator_trnid[i, 0]]
            found[dof] += model.actuator_gear[i, 0] ** 2 * model.actuator_damping[i]
    return found


def _write(model: mujoco.MjModel, data: mujoco.MjData, log: StepLog, k: int, slope: Array) -> None:
    log.qpos[k + 1], log.qvel[k + 1] = data.qpos, data.qvel
    log.sensors[k], log.activation[k] = data.sensordata, data.act
    change = log.qvel[k + 1] - log.qvel[k]
    force = log.generalized_force[k]
    mujoco.mj_mulM(model, data, force, change / model.opt.timestep)
    # friction acts on the new velocity: MuJoCo takes it implicitly, so in the log too
    implicit = slope * change
    force += data.qfrc_bias - data.qfrc_passive - data.qfrc_constraint + implicit
    log.loss_force[k] = data.qfrc_damper + data.qfrc_constraint - implicit


def _stopped(data: mujoco.MjData, time: float) -> FloatingPointError:
    number = int(np.flatnonzero(data.warning.number)[0])
    reason = mujoco.mjtWarning(number).name.removeprefix("mjWARN_")
    return FloatingPointError(
        f"Twin: MuJoCo gave up in the step at t = {time:.6g} s ({reason}, entry "
        f"{data.warning.lastinfo[number]}): the state is not finite or the model is overfull; a "
        "smaller time_step or softer motors usually cure it"
    )
