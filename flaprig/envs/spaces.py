"""Spaces of the hovering environments, made once for the single and the vector environment."""

from __future__ import annotations

from typing import Any

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from flaprig.tasks.hover_settings import COEFFICIENTS, SAMPLES

# what gymnasium calls an element of a Box
Numbers = NDArray[np.floating[Any] | np.integer[Any]]


def action_space() -> spaces.Box:
    """Changes of the twelve coefficients, in steps of `step_size`."""
    return spaces.Box(-1.0, 1.0, (COEFFICIENTS,), np.float32)


def observation_space() -> spaces.Box:
    """Samples of sweep, then of pitch, over their amplitudes."""
    return spaces.Box(-1.0, 1.0, (2 * SAMPLES,), np.float32)
