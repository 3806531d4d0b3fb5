"""The validation cases by name; a new one is one file and one line here."""

from __future__ import annotations

from flaprig import _checks as check
from flaprig.validation.added_mass import AddedMass
from flaprig.validation.case import Case
from flaprig.validation.convergence import Convergence
from flaprig.validation.delta_wing import DeltaWing
from flaprig.validation.energy import Energy
from flaprig.validation.impulse import Impulse
from flaprig.validation.katz_plotkin import KatzPlotkin
from flaprig.validation.kelvin import Kelvin
from flaprig.validation.leave_one_out import LeaveOneOut
from flaprig.validation.lift_slope import LiftSlope
from flaprig.validation.measured import MeasuredStrokes
from flaprig.validation.paper import Paper
from flaprig.validation.peer import Peer
from flaprig.validation.plugin import Plugin
from flaprig.validation.quasi_steady import QuasiSteadyLimits
from flaprig.validation.quasi_steady_fit import QuasiSteadyFit
from flaprig.validation.suction import Suction
from flaprig.validation.theodorsen import Theodorsen
from flaprig.validation.wagner import Wagner

_CASES: tuple[type[Case], ...] = (
    AddedMass,
    Suction,
    LiftSlope,
    KatzPlotkin,
    Wagner,
    Theodorsen,
    DeltaWing,
    Impulse,
    Kelvin,
    QuasiSteadyLimits,
    Energy,
    Plugin,
    Peer,
    Paper,
    MeasuredStrokes,
    LeaveOneOut,
    QuasiSteadyFit,
    Convergence,
)
# in the order of the page
CASES: dict[str, type[Case]] = {case.name: case for case in _CASES}


def case_named(name: str) -> type[Case]:
    """The case of that name. ValueError, with all names, when there is none."""
    if name not in CASES:
        raise check.fail("validate", "CASE", f"one of {', '.join(CASES)}", name)
    return CASES[name]
