"""What the displaced fluid does to the plate at rest and in motion alike (Archimedes).

The force rho V g is vertical and so turns nothing about the sweep axis; about the pitch axis its
arm is that of the plate's centre. It is no part of lift, drag or power, which belong to the motion:
a load cell that was tared in the tank does not read it either.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from flaprig.fluid import GRAVITY, Fluid
from flaprig.wing import Wing

Array = NDArray[np.float64]


def buoyant_force(wing: Wing, fluid: Fluid, gravity: float = GRAVITY) -> float:
    """Weight of the fluid that the plate displaces, rho V g, in [N]."""
    return fluid.density * wing.volume * gravity


def buoyant_torque(wing: Wing, fluid: Fluid, pitch: Array, gravity: float = GRAVITY) -> Array:
    """Torque about the pitch axis along +pitch, rho V g x sin(pitch), in [N m]. Shape of pitch.

    Args:
        wing: the plate; x is how far its centre lies behind the pitch axis.
        fluid: what it displaces.
        pitch: from the vertical in [rad].
        gravity: in [m/s2].
    """
    return np.asarray(buoyant_force(wing, fluid, gravity) * wing.centroid[0] * np.sin(pitch))


def buoyant_energy(wing: Wing, fluid: Fluid, pitch: Array, gravity: float = GRAVITY) -> Array:
    """Potential energy of the buoyant force, rho V g x cos(pitch), in [J]. Shape of pitch."""
    return np.asarray(buoyant_force(wing, fluid, gravity) * wing.centroid[0] * np.cos(pitch))
