"""flaprig.load_plugins, and what MuJoCo says without it."""

from __future__ import annotations

import subprocess
import sys

import pytest

import flaprig
from flaprig._paths import RIG_XML
from flaprig.native import library


def python(code: str) -> subprocess.CompletedProcess[str]:
    """In a process that has loaded nothing yet."""
    return subprocess.run(
        [sys.executable, "-W", "ignore", "-c", code, str(RIG_XML)], capture_output=True, text=True
    )


def test_is_public_and_may_be_called_again() -> None:
    assert "load_plugins" in flaprig.__all__
    assert flaprig.load_plugins() == flaprig.load_plugins() == library.load()


@pytest.mark.parametrize("way", ["MjModel.from_xml_path", "MjSpec.from_file"])
def test_mujocos_own_error_names_the_call(way: str) -> None:
    done = python(f"import sys, mujoco, flaprig; mujoco.{way}(sys.argv[1])")
    assert done.returncode == 1
    assert "plugin flaprig (first call flaprig.load_plugins()) not found" in done.stderr
    called = python(
        f"import sys, mujoco, flaprig; flaprig.load_plugins(); mujoco.{way}(sys.argv[1])"
    )
    assert called.returncode == 0, called.stderr


def test_import_loads_nothing() -> None:
    done = python("import sys, flaprig; flaprig.load_plugins; print('mujoco' in sys.modules)")
    assert done.stdout.strip() == "False", done.stderr
