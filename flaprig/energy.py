"""Where the motors' work went, cycle by cycle: into the fluid, into motion and height, into losses.

Work is torque times the mean velocity of the step: with constant inertia it then equals the change
of kinetic energy exactly, whatever the step (the discrete gradient of a quadratic form).
"""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class EnergyBalance:
    """Energies of each cycle in [J]; all arrays of shape (cycles,).

    The work on the fluid holds the kinetic energy of its added mass, so that the kinetic energy
    here is that of plate, arm and rotors alone.

    Attributes:
        motor_work: mechanical work of the motors on their rotors.
        fluid_work: work of the wing on the moving fluid.
        kinetic: gain of kinetic energy of everything solid.
        potential: gain of potential energy (weight less buoyancy, springs).
        losses: work into friction of joints and gears, and into the joint stops.
    """

    motor_work: Array
    fluid_work: Array
    kinetic: Array
    potential: Array
    losses: Array

    @property
    def residual(self) -> Array:
        """Motor work that went nowhere [J]: the error of the time steps. Shape (cycles,)."""
        return self.motor_work - self.fluid_work - self.kinetic - self.potential - self.losses

    @property
    def relative_residual(self) -> Array:
        """Residual over the motor work of the same cycle. Shape (cycles,)."""
        return self.residual / self.motor_work


def solid_energy(model: mujoco.MjModel, qpos: Array, qvel: Array) -> tuple[float, float]:
    """Kinetic energy without the fluid's added mass, and potential energy, in [J]."""
    data = mujoco.MjData(model)
    data.qpos[:] = qpos
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    # without the passive stage, where the plugin adds the fluid's mass
    mujoco.mj_makeM(model, data)
    momentum = np.zeros(model.nv)
    mujoco.mj_mulM(model, data, momentum, np.ascontiguousarray(qvel))
    mujoco.mj_energyPos(model, data)
    return 0.5 * float(momentum @ qvel), float(data.energy[0])
