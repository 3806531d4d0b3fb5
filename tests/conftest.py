"""What every test stands on: headless rendering, repeatable property tests, the folders."""

from __future__ import annotations

import os
import sys
from ctypes.util import find_library
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

ROOT = Path(__file__).resolve().parents[1]

# no window in a test; MuJoCo and dm_control read this on import, so it is set before any test
os.environ.setdefault("MPLBACKEND", "Agg")
if sys.platform == "linux" and not os.environ.get("DISPLAY"):
    for name in ("EGL", "OSMesa"):
        if find_library(name):
            os.environ.setdefault("MUJOCO_GL", name.lower())

# the same examples in every run, and no deadline: two cores may be busy with other tests
settings.register_profile(
    "flaprig", derandomize=True, deadline=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("flaprig")


@pytest.fixture(scope="session")
def root() -> Path:
    """The folder of the repository."""
    return ROOT


@pytest.fixture(scope="session")
def shared() -> Path:
    """The folder of measurements beside the repository; skips where there is none."""
    folder = ROOT.parent / "shared"
    if not folder.is_dir():
        pytest.skip("the folder of measurements, ../shared, is not here")
    return folder
