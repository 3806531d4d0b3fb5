"""What a stroke would need of the servos if it were made exactly: inverse dynamics.

The fluid's torques are those of the prescribed motion in the rig's own model of the fluid; plate,
arm and rotors are MuJoCo's, in a fluid of no density.
"""

from __future__ import annotations

from dataclasses import replace

import mujoco
import numpy as np
from numpy.typing import NDArray

from flaprig.aero.models import QuasiSteady
from flaprig.aero.result import Result
from flaprig.rig import Rig, coordinates
from flaprig.strokes.stroke import Stroke

Array = NDArray[np.float64]

# density of a fluid that does nothing [kg/m3]
_NOTHING = 1e-9


def asked_torques(rig: Rig, stroke: Stroke, prescribed: Result) -> Array:
    """Torques of the sweep and the pitch servo over the averaged cycles in [N m]. Shape (m, 2).

    Args:
        rig: the rig.
        stroke: made exactly.
        prescribed: loads of the fluid along it.
    """
    empty = replace(rig.fluid, density=_NOTHING, wind=(0.0, 0.0, 0.0))
    model = rig.with_(fluid=empty, model=QuasiSteady(strips=1)).compile()
    data = mujoco.MjData(model)
    angle, rate = coordinates(model)
    motion = stroke.motion(prescribed.averaged(prescribed.time))
    angles = np.column_stack([motion.sweep, motion.pitch])
    rates = np.column_stack([motion.sweep_rate, motion.pitch_rate])
    accelerations = np.column_stack([motion.sweep_acceleration, motion.pitch_acceleration])

    torque = np.empty_like(angles)
    for k, acceleration in enumerate(accelerations):
        data.qpos[angle], data.qvel[rate], data.qacc[rate] = angles[k], rates[k], acceleration
        mujoco.mj_inverse(model, data)
        # a stop that the stroke would go through is no need of the motor
        torque[k] = (data.qfrc_inverse + data.qfrc_constraint)[rate]

    fluid = [prescribed.averaged(h) for h in (prescribed.sweep_torque, prescribed.pitch_torque)]
    return torque - np.column_stack(fluid)
