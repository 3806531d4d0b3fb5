"""The torque that a motion needs, from inverse dynamics of the rig in fluid without a memory.

The air is the quasi-steady model's: added mass and the load at the given rates, no wake. mj_inverse
takes M with the fluid's added mass in it, and passive forces with the rest of the load, buoyancy
too where the rig has it.
"""

from __future__ import annotations

import mujoco
import numpy as np
from numpy.typing import NDArray

from flaprig.aero.models import QuasiSteady
from flaprig.rig import Rig, coordinates
from flaprig.strokes.stroke import Motion

Array = NDArray[np.float64]


def needed_torques(rig: Rig, motion: Motion) -> Array:
    """Torques of the sweep and the pitch servo in each step of a motion, in [N m]. Shape (n, 2).

    Args:
        rig: plate, fluid and servos; its air is replaced unless it is quasi-steady already.
        motion: at the n + 1 ends of n equal steps. A step's acceleration is the change of its rate.
    """
    air = rig.model if isinstance(rig.model, QuasiSteady) else QuasiSteady()
    model = rig.with_(model=air).compile()
    data = mujoco.MjData(model)
    angle, rate = coordinates(model)
    angles = np.column_stack([motion.sweep, motion.pitch])
    rates = np.column_stack([motion.sweep_rate, motion.pitch_rate])
    accelerations = np.diff(rates, axis=0) / np.diff(motion.time)[:, None]
    torque = np.empty_like(accelerations)
    for k, acceleration in enumerate(accelerations):
        data.qpos[angle], data.qvel[rate], data.qacc[rate] = angles[k], rates[k], acceleration
        mujoco.mj_inverse(model, data)
        torque[k] = data.qfrc_inverse[rate]
    return torque
