"""flaprig: the digital twin of a robotic flapping wing."""

from flaprig.aero.coefficients import DICKINSON_1999, LEE_2016, Coefficients
from flaprig.aero.models import UVLM, QuasiSteady
from flaprig.aero.result import Result
from flaprig.aero.simulate import simulate
from flaprig.fluid import AIR, WATER, Fluid
from flaprig.strokes.fourier import FourierStroke
from flaprig.strokes.sampled import SampledStroke
from flaprig.strokes.sun_tang import SunTangStroke
from flaprig.wing import RIG_WING, Wing

__all__ = [
    "AIR",
    "DICKINSON_1999",
    "LEE_2016",
    "RIG_WING",
    "UVLM",
    "WATER",
    "Coefficients",
    "Fluid",
    "FourierStroke",
    "QuasiSteady",
    "Result",
    "SampledStroke",
    "SunTangStroke",
    "Wing",
    "simulate",
]
