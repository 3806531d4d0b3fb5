"""Clocks of the MuJoCo plugin, whose solver is another copy than the module's."""

from __future__ import annotations

import ctypes

from flaprig.native.library import load

NAMES = ("roll_up", "wing", "loads", "plugin")


def reset_clocks() -> None:
    """Count from here on."""
    _library().flaprig_reset_clocks()


def clocks() -> dict[str, float]:
    """Seconds since the reset, on all threads together, as `_native.clocks` has them.

    "plugin" is all of MuJoCo's calls of the plugin, the others included.
    """
    clock = _library().flaprig_clock
    clock.restype, clock.argtypes = ctypes.c_double, (ctypes.c_char_p,)
    return {name: float(clock(name.encode())) for name in NAMES}


def _library() -> ctypes.CDLL:
    return ctypes.CDLL(str(load()))
