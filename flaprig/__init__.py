"""flaprig: the digital twin of a robotic flapping wing."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from flaprig.aero.batch import simulate_batch
from flaprig.aero.coefficients import DICKINSON_1999, HOVER_TANK, LEE_2016, Coefficients
from flaprig.aero.models import UVLM, QuasiSteady, SuctionLaw
from flaprig.aero.result import Result
from flaprig.aero.simulate import simulate
from flaprig.fluid import AIR, WATER, Fluid
from flaprig.strokes.fourier import FourierStroke
from flaprig.strokes.sampled import SampledStroke
from flaprig.strokes.sun_tang import SunTangStroke
from flaprig.wing import RIG_WING, Wing

if TYPE_CHECKING:
    from flaprig.feasibility import FeasibilityReport, Tolerances, check_feasibility
    from flaprig.logs import RigLog, read_log
    from flaprig.rig import Rig
    from flaprig.twin import Twin, TwinRun

__all__ = [
    "AIR",
    "DICKINSON_1999",
    "HOVER_TANK",
    "LEE_2016",
    "RIG_WING",
    "UVLM",
    "WATER",
    "Coefficients",
    "FeasibilityReport",
    "Fluid",
    "FourierStroke",
    "QuasiSteady",
    "Result",
    "Rig",
    "RigLog",
    "SampledStroke",
    "SuctionLaw",
    "SunTangStroke",
    "Tolerances",
    "Twin",
    "TwinRun",
    "Wing",
    "check_feasibility",
    "read_log",
    "simulate",
    "simulate_batch",
]

# what needs MuJoCo or scipy, by the room it is in: imported when it is asked for
_LATE = {
    "FeasibilityReport": "feasibility",
    "Rig": "rig",
    "RigLog": "logs",
    "Tolerances": "feasibility",
    "Twin": "twin",
    "TwinRun": "twin",
    "check_feasibility": "feasibility",
    "read_log": "logs",
}


def __getattr__(name: str) -> Any:
    if name not in _LATE:
        raise AttributeError(f"module 'flaprig' has no attribute {name!r}")
    return getattr(import_module(f"flaprig.{_LATE[name]}"), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
