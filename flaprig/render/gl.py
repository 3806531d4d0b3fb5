"""Which OpenGL MuJoCo can draw with on this machine, and how to get one where there is none."""

from __future__ import annotations

import os
import subprocess
import sys
from functools import cache

# values of MUJOCO_GL with which MuJoCo must not draw
_OFF = ("disable", "disabled", "off", "false", "0")
# what to install where nothing draws
ADVICE = (
    "for a video of the rig install the Debian packages libegl1 and libgl1-mesa-dri, or libosmesa6"
)
# makes a small picture and fails where that is impossible
_TRIAL = """
import importlib, sys, mujoco
context = importlib.import_module("mujoco." + sys.argv[1]).GLContext(16, 16)
context.make_current()
mujoco.MjrContext(mujoco.MjModel.from_xml_string("<mujoco/>"), mujoco.mjtFontScale.mjFONTSCALE_50)
print("drawn", flush=True)
"""
# the longest that a working library was seen to need, times ten [s]
_TRIAL_TIME = 20.0


def has_display() -> bool:
    """Whether windows can be opened: an X or Wayland display, or a desktop that is always there."""
    if sys.platform == "linux":
        return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))
    return True


def backend() -> str | None:
    """Name of the library that draws pictures in memory, or None where none works.

    The user's MUJOCO_GL decides where it is set; else the first that passes a trial in a process
    of its own, so that a broken library cannot take this one with it.
    """
    chosen = os.environ.get("MUJOCO_GL", "").lower().strip()
    if chosen in _OFF:
        return None
    names = [chosen] if chosen in ("egl", "osmesa", "glfw", "cgl") else _candidates()
    return next((name for name in names if works(name)), None)


def _candidates() -> list[str]:
    if sys.platform == "darwin":
        return ["cgl"]
    return ["egl", "osmesa", *(["glfw"] if has_display() else [])]


@cache
def works(name: str) -> bool:
    """Whether a new process can draw with this library."""
    variables = os.environ | {"MUJOCO_GL": name}
    variables.pop("PYOPENGL_PLATFORM", None)
    command = [sys.executable, "-c", _TRIAL, name]
    try:
        done = subprocess.run(
            command, env=variables, capture_output=True, text=True, timeout=_TRIAL_TIME, check=False
        )
    except (OSError, subprocess.TimeoutExpired):
        return False
    # some libraries fail only while they are unloaded, after the picture is made
    return "drawn" in done.stdout
