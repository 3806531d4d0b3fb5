"""The plugins, once for all tests in this folder."""

from __future__ import annotations

from pathlib import Path

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
