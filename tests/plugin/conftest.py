"""The plugins, once for all tests in this folder."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import mujoco
import pytest

from flaprig.native import library


@pytest.fixture(scope="session", autouse=True)
def _plugins() -> None:
    try:
        library.load()
    except ImportError as error:
        if "is missing" not in str(error):
            raise
        pytest.skip(str(error))


@pytest.fixture(autouse=True)
def _no_log_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """MuJoCo writes its warnings into MUJOCO_LOG.TXT where the process stands."""
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def told() -> Iterator[list[str]]:
    """What MuJoCo warns of while the test runs; dm_control has a handler that comes back."""
    texts: list[str] = []
    before = mujoco.get_mju_user_warning()
    mujoco.set_mju_user_warning(texts.append)
    yield texts
    mujoco.set_mju_user_warning(before)
