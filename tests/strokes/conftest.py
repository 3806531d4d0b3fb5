"""Shared by the stroke tests: a numerical derivative that knows nothing of the formulas."""

from __future__ import annotations

import numpy as np
import pytest

# sixth-order central difference: offset in steps, weight
STENCIL = ((-3, -1 / 60), (-2, 9 / 60), (-1, -45 / 60), (1, 45 / 60), (2, -9 / 60), (3, 1 / 60))


def derivative(stroke, name, time, step):
    """Rate of change of one quantity of the motion, from its values around time."""
    values = (weight * getattr(stroke.motion(time + n * step), name) for n, weight in STENCIL)
    return sum(values) / step


def assert_consistent(stroke, time, tolerance, step=1e-4):
    """Rates are derivatives of angles, and accelerations of rates, over the scale of each."""
    motion, step = stroke.motion(time), step * stroke.period
    for angle in ("sweep", "pitch"):
        for low, high, order in (("", "_rate", 1), ("_rate", "_acceleration", 2)):
            expected = derivative(stroke, angle + low, time, step)
            scale = np.abs(expected).max() + stroke.frequency**order
            error = np.abs(getattr(motion, angle + high) - expected).max() / scale
            assert error < tolerance, (angle + high, error)


@pytest.fixture(name="assert_consistent", scope="session")
def assert_consistent_fixture():
    return assert_consistent
