"""Strokes: periodic sweep and pitch of the wing, from formulas, harmonics or samples."""

from flaprig.strokes.fourier import FourierStroke
from flaprig.strokes.loading import load
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
