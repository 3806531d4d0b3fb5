"""Loads the MuJoCo plugin library libflaprig_air into the process, once.

MuJoCo keeps one process-wide table of plugins (`mj_loadPluginLibrary`, `mjp_registerPlugin`): the
library goes in once, must match MuJoCo to the last digit, and a second copy of it is fatal. Each
of these becomes one sentence here, before MuJoCo sees the file.
"""

from __future__ import annotations

import ctypes
import os
import sys
import threading
from importlib.util import find_spec
from pathlib import Path

import mujoco

# the MuJoCo whose headers the plugin is compiled with: it reads mjModel and mjData by their layout.
# CMakeLists.txt and the tests read this line; pyproject.toml requires the same version.
MUJOCO_VERSION = "3.17.0"

# what the library registers
PLUGINS = ("flaprig.quasi_steady", "flaprig.uvlm")

_LIBRARY = "libflaprig_air.dylib" if sys.platform == "darwin" else "libflaprig_air.so"
_MUJOCO = {"darwin": f"libmujoco.{MUJOCO_VERSION}.dylib"}.get(
    sys.platform, f"libmujoco.so.{MUJOCO_VERSION}"
)
_lock = threading.Lock()


def load() -> Path:
    """Make the plugins known to MuJoCo; calling again, from any thread, does nothing more.

    Returns:
        Path of the library that is loaded.

    Raises:
        ImportError: another MuJoCo version is installed, the library was not built, does not load,
            or another copy of it is already in this process.
    """
    _check_version()
    path = _find()
    with _lock:
        if not _registered():
            _load(path)
        elif not _in_process(path):
            raise ImportError(
                f"a second copy of flaprig cannot be loaded: its plugins came from {_origin()}, "
                f"now {path} was asked for; keep one installation on the path and start again"
            )
    return path


def _check_version() -> None:
    if mujoco.__version__ != MUJOCO_VERSION:
        raise ImportError(
            f"flaprig is compiled for mujoco {MUJOCO_VERSION} and mujoco {mujoco.__version__} is "
            f"installed: pip install mujoco=={MUJOCO_VERSION}"
        )


def _find() -> Path:
    """The library lies beside the compiled module, in a wheel as in an editable install."""
    spec = find_spec("flaprig.native._native")
    path = Path(spec.origin).with_name(_LIBRARY) if spec and spec.origin else None
    if path is None or not path.is_file():
        raise ImportError(
            f"flaprig's compiled part ({_LIBRARY}) is missing: build it with `make build` in a "
            "clone, or `pip install .`"
        )
    return path.resolve()


def _registered() -> bool:
    """Whether MuJoCo knows one of the plugins, whoever loaded it."""
    get_plugin = ctypes.CDLL(str(Path(mujoco.__file__).with_name(_MUJOCO))).mjp_getPlugin
    get_plugin.restype = ctypes.c_void_p
    get_plugin.argtypes = (ctypes.c_char_p, ctypes.POINTER(ctypes.c_int))
    slot = ctypes.c_int(-1)
    return any(get_plugin(name.encode(), ctypes.byref(slot)) for name in PLUGINS)


def _load(path: Path) -> None:
    try:
        mujoco.mj_loadPluginLibrary(str(path))
    except mujoco.FatalError as error:
        raise ImportError(f"flaprig's plugin library does not load: {error}") from error
    if not _registered():
        raise ImportError(f"{path} registers none of {', '.join(PLUGINS)}: build flaprig again")


def _in_process(path: Path) -> bool:
    """Whether exactly this file is loaded (RTLD_NOLOAD opens nothing new)."""
    try:
        ctypes.CDLL(str(path), mode=os.RTLD_NOLOAD | os.RTLD_NOW)
    except OSError:
        return False
    return True


def _origin() -> str:
    """Path of the copy that is loaded, where the system tells it (Linux)."""
    try:
        lines = Path("/proc/self/maps").read_text().splitlines()
    except OSError:
        return "another path"
    found = (line.split(maxsplit=5)[-1] for line in lines if line.endswith(_LIBRARY))
    return next(found, "another path")
