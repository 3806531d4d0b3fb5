"""flaprig: the digital twin of a robotic flapping wing."""

from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from flaprig.aero.batch import simulate_batch
    from flaprig.aero.coefficients import DICKINSON_1999, HOVER_TANK, LEE_2016, Coefficients
    from flaprig.aero.models import UVLM, QuasiSteady, SuctionLaw
    from flaprig.aero.result import Result
    from flaprig.aero.simulate import simulate
    from flaprig.feasibility import FeasibilityReport, Tolerances, check_feasibility
    from flaprig.fluid import AIR, WATER, Fluid
    from flaprig.logs import RigLog, read_log
    from flaprig.rig import Rig
    from flaprig.strokes.fourier import FourierStroke
    from flaprig.strokes.sampled import SampledStroke
    from flaprig.strokes.sun_tang import SunTangStroke
    from flaprig.twin import Twin, TwinRun
    from flaprig.wing import RIG_WING, Wing

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
    "load_plugins",
    "read_log",
    "simulate",
    "simulate_batch",
]

# the module of each public name, imported when it is asked for: the command line must not load
# everything before it can hear Ctrl-C
_ROOM = {
    "AIR": "fluid",
    "Coefficients": "aero.coefficients",
    "DICKINSON_1999": "aero.coefficients",
    "FeasibilityReport": "feasibility",
    "Fluid": "fluid",
    "FourierStroke": "strokes.fourier",
    "HOVER_TANK": "aero.coefficients",
    "LEE_2016": "aero.coefficients",
    "QuasiSteady": "aero.models",
    "RIG_WING": "wing",
    "Result": "aero.result",
    "Rig": "rig",
    "RigLog": "logs",
    "SampledStroke": "strokes.sampled",
    "SuctionLaw": "aero.models",
    "SunTangStroke": "strokes.sun_tang",
    "Tolerances": "feasibility",
    "Twin": "twin",
    "TwinRun": "twin",
    "UVLM": "aero.models",
    "WATER": "fluid",
    "Wing": "wing",
    "check_feasibility": "feasibility",
    "read_log": "logs",
    "simulate": "aero.simulate",
    "simulate_batch": "aero.batch",
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
    if name in _ROOM:
        return getattr(import_module(f"flaprig.{_ROOM[name]}"), name)
    if not name.startswith("__") and find_spec(f"flaprig.{name}") is not None:
        # a module of the package, without an import of its own
        return import_module(f"flaprig.{name}")
    raise AttributeError(f"module 'flaprig' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
