"""flaprig: the digital twin of a robotic flapping wing."""

from importlib import import_module
from pathlib import Path
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
    "SampledStroke",
    "SuctionLaw",
    "SunTangStroke",
    "Tolerances",
    "Twin",
    "TwinRun",
    "Wing",
    "check_feasibility",
    "load_plugins",
    "simulate",
    "simulate_batch",
]

# what needs MuJoCo, by the room it is in: imported when it is asked for
_LATE = {
    "FeasibilityReport": "feasibility",
    "Rig": "rig",
    "Tolerances": "feasibility",
    "Twin": "twin",
    "TwinRun": "twin",
    "check_feasibility": "feasibility",
}


def load_plugins() -> Path:
    """Make flaprig.uvlm and flaprig.quasi_steady known to MuJoCo, for models that name them.

    Once in a process is enough, before the first such model is loaded; again does nothing more.
    flaprig's own `Rig` and `Twin` call it; importing flaprig does not, nor does it import MuJoCo.

    Returns:
        Path of the plugin library that is loaded.

    Raises:
        ImportError: another MuJoCo version is installed, the library was not built, does not load,
            or another copy of it is already in this process.
    """
    from flaprig.native import library

    return library.load()


def __getattr__(name: str) -> Any:
    if name not in _LATE:
        raise AttributeError(f"module 'flaprig' has no attribute {name!r}")
    return getattr(import_module(f"flaprig.{_LATE[name]}"), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
