"""The plugins and the rig as built, once for all tests in this folder."""

from __future__ import annotations

import mujoco
import pytest

from flaprig.native import library
from flaprig.rig import Rig


@pytest.fixture(scope="session", autouse=True)
def _plugins() -> None:
    try:
        library.load()
    except ImportError as error:
        if "is missing" not in str(error):
            raise
        pytest.skip(str(error))


@pytest.fixture(scope="module")
def compiled() -> mujoco.MjModel:
    """The rig as built."""
    return Rig.load().compile()
