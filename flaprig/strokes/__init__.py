"""Strokes: periodic sweep and pitch of the wing, from formulas, harmonics or samples."""

from importlib import import_module
from typing import Any

from flaprig.strokes.fourier import FourierStroke
from flaprig.strokes.sampled import SampledStroke
from flaprig.strokes.stroke import Motion, Stroke
from flaprig.strokes.sun_tang import PitchProfile, SunTangStroke

__all__ = [
    "FourierStroke",
    "Motion",
    "PitchProfile",
    "SampledStroke",
    "Stroke",
    "SunTangStroke",
    "load",
]


def __getattr__(name: str) -> Any:
    # files of samples are records, and their reader stands on the floor above
    if name != "load":
        raise AttributeError(f"module 'flaprig.strokes' has no attribute {name!r}")
    return import_module("flaprig.logs.loading").load


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
