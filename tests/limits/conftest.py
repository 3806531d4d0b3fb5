"""Shared by the tests of limits: random strokes and limits, and the paper's rig."""

from __future__ import annotations

import numpy as np
import pytest

from flaprig.limits import PAPER_KINEMATICS, JointLimits, Limits, peaks, rig_limits
from flaprig.motors import RIG_MOTORS
from flaprig.strokes import FourierStroke, SunTangStroke


def random_stroke(rng, frequency=None):
    """Up to four harmonics of any phase, amplitudes up to 1.2 rad."""
    count = rng.integers(1, 5)
    size = np.array([1.0, 0.5, 0.2, 0.1])[:count]
    terms = [rng.normal(size=count) * size for _ in range(4)]
    frequency = rng.uniform(0.05, 2.0) if frequency is None else frequency
    return FourierStroke.normalized(frequency, *terms, *rng.uniform(0.05, 1.2, 2))


def random_limits(rng, stroke, least, most, position=(-1.4, 1.4)):
    """Random shares of what a stroke needs."""
    joints = {}
    for joint, need in peaks(stroke).items():
        shares = rng.uniform(least, most, 3)
        needs = (need.velocity, need.acceleration, need.jerk)
        joints[joint] = JointLimits(position, *(shares * needs))
    return Limits(**joints)


@pytest.fixture(name="random_stroke", scope="session")
def random_stroke_fixture():
    return random_stroke


@pytest.fixture(name="random_limits", scope="session")
def random_limits_fixture():
    return random_limits


@pytest.fixture(scope="session")
def rig():
    """Limits of the rig with the paper's accelerations."""
    return rig_limits(RIG_MOTORS).with_accelerations(PAPER_KINEMATICS)


@pytest.fixture(scope="session")
def sine():
    """The paper's sinusoidal stroke."""
    return SunTangStroke(0.2, np.pi / 3, np.pi / 4)
