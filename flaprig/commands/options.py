"""Options that several subcommands share: wing, fluid and model of the air; the stroke's beside.

Degrees live here and nowhere else: every builder returns objects in SI units and radians.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Annotated, Any, Literal

from tyro.conf import arg

from flaprig import _checks as check
from flaprig.aero.coefficients import DICKINSON_1999, HOVER_TANK, LEE_2016
from flaprig.aero.models import SUCTION_EFFICIENCY, UVLM, QuasiSteady
from flaprig.commands.stroke_options import StrokeOptions
from flaprig.fluid import WATER, Fluid
from flaprig.wing import PITCH_AXIS, RIG_WING, Wing

__all__ = ["FluidOptions", "ModelOptions", "StrokeOptions", "WingOptions"]

# the models' own defaults, shown by --help
_UVLM, _QUASI_STEADY = UVLM(), QuasiSteady()
_STEPS = f"(default: {_UVLM.steps_per_cycle}, {_QUASI_STEADY.steps_per_cycle})"
# options of the vortex lattice alone, by field of ModelOptions
_LATTICE = ("chordwise", "spanwise", "core", "wake_cycles", "threads")
_COEFFICIENTS = {
    "dickinson1999": DICKINSON_1999,
    "lee2016": LEE_2016,
    "hover-tank": HOVER_TANK,
}


@dataclass(frozen=True)
class WingOptions:
    """The wing; the rig's own unless said otherwise.

    Attributes:
        planform: a rectangle, or Ellington's beta planform (chord is then the mean chord).
        span: root to tip [m].
        chord: chord, or mean chord [m].
        root_offset: sweep axis to root [m].
        pitch_axis: leading edge to pitch axis [chords].
        r1: beta planform: radius of the first moment of area [spans]; 0.5 when left out.
        r2: beta planform: radius of the second moment [spans]; from r1 when left out.
    """

    planform: Literal["rectangle", "beta"] = "rectangle"
    span: float = RIG_WING.span
    chord: float = RIG_WING.mean_chord
    root_offset: float = RIG_WING.root_offset
    pitch_axis: float = PITCH_AXIS
    r1: Annotated[float | None, arg(metavar="FLOAT", help_behavior_hint="(optional)")] = None
    r2: Annotated[float | None, arg(metavar="FLOAT", help_behavior_hint="(optional)")] = None

    def build(self) -> Wing:
        """The wing.

        Raises:
            ValueError: a value out of range, or radii of a beta planform for a rectangle.
        """
        if self.planform == "beta":
            r1 = 0.5 if self.r1 is None else self.r1
            return Wing.beta(self.span, self.chord, r1, self.r2, self.root_offset, self.pitch_axis)
        _refuse_changed(self, ["r1", "r2"], "with --planform rectangle")
        return Wing.rectangular(self.span, self.chord, self.root_offset, self.pitch_axis)


@dataclass(frozen=True)
class FluidOptions:
    """The fluid; water unless said otherwise.

    Attributes:
        density: mass density [kg/m3].
        viscosity: kinematic viscosity [m2/s].
        wind: uniform velocity of the fluid, z up, sweep measured from x [m/s].
    """

    density: float = WATER.density
    viscosity: float = WATER.kinematic_viscosity
    wind: tuple[float, float, float] = WATER.wind

    def build(self) -> Fluid:
        """The fluid. ValueError for a value that is not a positive number."""
        return Fluid(self.density, self.viscosity, self.wind)


@dataclass(frozen=True)
class ModelOptions:
    """How the fluid is modelled.

    Attributes:
        kind: the paper's vortex lattice with its free wake; the lattice extended for separated
            flow, or as accurate as its panels in attached flow; quasi-steady blade elements.
        steps_per_cycle: wake rows shed (uvlm) or loads reported (quasi-steady) in one cycle.
        chordwise: uvlm: panels along the chord.
        spanwise: uvlm: panels along the span.
        suction_efficiency: uvlm: share of the leading-edge suction, calibrated on the rig's
            sinusoid (eta_s of the paper's eq. 6).
        core: uvlm: radius of the vortex core [mean chords].
        wake_cycles: uvlm: length of wake kept [cycles].
        threads: uvlm: threads of the wake's roll-up; results do not depend on it.
        coefficients: quasi-steady: set of lift and drag coefficients.
    """

    kind: Annotated[
        Literal["uvlm", "uvlm-extended", "uvlm-accurate", "quasi-steady"], arg(name="model")
    ] = "uvlm"
    steps_per_cycle: Annotated[int | None, arg(metavar="INT", help_behavior_hint=_STEPS)] = None
    chordwise: int = _UVLM.chordwise
    spanwise: int = _UVLM.spanwise
    suction_efficiency: float = SUCTION_EFFICIENCY
    core: float = _UVLM.core
    wake_cycles: float = _UVLM.wake_cycles
    threads: int = _UVLM.threads
    coefficients: Literal["dickinson1999", "lee2016", "hover-tank"] = "dickinson1999"

    def build(self) -> UVLM | QuasiSteady:
        """The model.

        Raises:
            ValueError: a value out of range, or an option of the other model.
        """
        if self.kind != "uvlm":
            _refuse_changed(self, ["suction_efficiency"], f"with --model {self.kind}")
        if self.kind != "quasi-steady":
            return self._lattice()
        _refuse_changed(self, list(_LATTICE), "with --model quasi-steady")
        steps = self._steps(_QUASI_STEADY.steps_per_cycle)
        return QuasiSteady(_COEFFICIENTS[self.coefficients], steps_per_cycle=steps)

    def _lattice(self) -> UVLM:
        _refuse_changed(self, ["coefficients"], f"with --model {self.kind}")
        lattice = {name: getattr(self, name) for name in _LATTICE}
        lattice["steps_per_cycle"] = self._steps(_UVLM.steps_per_cycle)
        if self.kind == "uvlm-extended":
            return UVLM.extended(**lattice)
        if self.kind == "uvlm-accurate":
            return UVLM.accurate(**lattice)
        return UVLM(suction_efficiency=self.suction_efficiency, **lattice)

    def _steps(self, usual: int) -> int:
        return usual if self.steps_per_cycle is None else self.steps_per_cycle


def _flag(field: str) -> str:
    return "--" + field.replace("_", "-")


def _refuse_changed(options: Any, names: list[str], when: str) -> None:
    """An option that would be ignored is an error, not a surprise."""
    for field in fields(options):
        value = getattr(options, field.name)
        if field.name in names and value != field.default:
            raise check.fail("options", _flag(field.name), f"left out {when}", value)
