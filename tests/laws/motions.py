"""Rigid motions and lattices that theory knows, and a world turned as a whole."""

import numpy as np

from flaprig.aero.rigid_motion import RigidMotion
from flaprig.validation import flight as known
from flaprig.validation.flight import FLUID, SECTION, flight, lift_of, section_air, steady, ticks

__all__ = [
    "FLUID",
    "SECTION",
    "flight",
    "lattice_air",
    "lift_of",
    "section_air",
    "steady",
    "ticks",
    "turned",
]


def lattice_air(aspect_ratio, *args, **settings):
    """Air of a rectangle of chord 1 m in a fluid of density 1 kg/m3, suction off."""
    return known.lattice_air(known.rectangle(aspect_ratio), *args, **settings)


def turned(motion, rotation):
    """The same motion in a world turned as a whole by a rotation matrix."""
    return RigidMotion(
        motion.position @ rotation.T,
        np.ascontiguousarray(rotation @ motion.rotation),
        motion.twist,
        motion.twist_rate,
    )
