"""Options that several subcommands share: wing, fluid and model of the air; the stroke's beside.

Degrees live here and nowhere else: every builder returns objects in SI units and radians.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import Annotated, Any, Literal

from tyro.conf import arg

from flaprig import _checks as check
from flaprig.aero.coefficients import DICKINSON_1999, HOVER_TANK, LEE_2016
from flaprig.aero.models import UVLM, QuasiSteady
from flaprig.commands.stroke_options import StrokeOptions
from flaprig.fluid import WATER, Fluid
from flaprig.wing import RIG_WING, Wing

__all__ = ["FluidOptions", "ModelOptions", "StrokeOptions", "WingOptions"]

_UVLM = UVLM()
# the models that --model names
_NAMED: dict[str, UVLM | QuasiSteady] = {
    "uvlm": _UVLM,
    "uvlm-extended": UVLM.extended(),
    "uvlm-accurate": UVLM.accurate(),
    "quasi-steady": QuasiSteady(),
}
# options of the vortex lattice alone, by field of ModelOptions
_LATTICE = ("chordwise", "spanwise", "core", "wake_cycles", "threads")
_COEFFICIENTS = {
    "dickinson1999": DICKINSON_1999,
    "lee2016": LEE_2016,
    "hover-tank": HOVER_TANK,
}


def _own(whose: str, metavar: str, name: str | None = None) -> Any:
    """An option whose default is said elsewhere: in the rig's file, or by the model."""
    return arg(name=name, metavar=metavar, help_behavior_hint=f"(default: {whose})")


@dataclass(frozen=True)
class WingOptions:
    """The wing: that of the rig's file, but for what is given here.

    Attributes:
        planform: a rectangle, or Ellington's beta planform (chord is then the mean chord); the
            rig's own planform when left out.
        span: root to tip [m].
        chord: chord, or mean chord [m].
        root_offset: sweep axis to root [m].
        pitch_axis: leading edge to pitch axis [chords].
        r1: beta planform: radius of the first moment of area [spans]; 0.5 when left out.
        r2: beta planform: radius of the second moment [spans]; from r1 when left out.
    """

    planform: Annotated[
        Literal["rectangle", "beta"] | None, _own("the rig's", "{rectangle,beta}")
    ] = None
    span: Annotated[float | None, _own("the rig's", "FLOAT")] = None
    chord: Annotated[float | None, _own("the rig's", "FLOAT")] = None
    root_offset: Annotated[float | None, _own("the rig's", "FLOAT")] = None
    pitch_axis: Annotated[float | None, _own("the rig's", "FLOAT")] = None
    r1: Annotated[float | None, arg(metavar="FLOAT", help_behavior_hint="(optional)")] = None
    r2: Annotated[float | None, arg(metavar="FLOAT", help_behavior_hint="(optional)")] = None

    def build(self, own: Wing = RIG_WING) -> Wing:
        """The wing; plate thickness and density are the rig's.

        Args:
            own: the rig's.

        Raises:
            ValueError: a value out of range, or radii of a beta planform for another.
        """
        if self.planform == "beta":
            span, chord, root, axis = self._sizes(own)
            r1 = 0.5 if self.r1 is None else self.r1
            return Wing.beta(
                *(span, chord, r1, self.r2, root, axis),
                thickness=own.thickness,
                density=own.density,
            )
        rectangle = self.planform is not None or own.is_rectangle
        when = "with --planform rectangle" if rectangle else "unless --planform is beta"
        _refuse_changed(self, ["r1", "r2"], when)
        if self == WingOptions():
            return own
        if rectangle:
            return Wing.rectangular(*self._sizes(own), own.thickness, own.density)
        return self._scaled(own)

    def _sizes(self, own: Wing) -> tuple[float, float, float, float]:
        """Span, mean chord, root offset, pitch axis."""
        widest = max(range(len(own.chord)), key=own.chord.__getitem__)
        usual = (
            *(own.span, own.mean_chord, own.root_offset),
            -own.leading_edge[widest] / own.chord[widest],
        )
        given = (self.span, self.chord, self.root_offset, self.pitch_axis)
        span, chord, root, axis = (u if g is None else g for g, u in zip(given, usual, strict=True))
        return span, chord, root, axis

    def _scaled(self, own: Wing) -> Wing:
        """The rig's own planform, stretched."""
        span, mean_chord, root, axis = self._sizes(own)
        along = check.positive("options", "--span", span, "m") / own.span
        across = check.positive("options", "--chord", mean_chord, "m") / own.mean_chord
        chord = [across * c for c in own.chord]
        leading = [across * x for x in own.leading_edge]
        if self.pitch_axis is not None:
            axis = check.in_range("options", "--pitch-axis", axis, 0.0, 1.0, "chords")
            leading = [-axis * c for c in chord]
        radius = [root + along * (r - own.root_offset) for r in own.radius]
        return Wing.from_table(radius, chord, leading, thickness=own.thickness, density=own.density)


@dataclass(frozen=True)
class FluidOptions:
    """The fluid: that of the rig's file, but for what is given here.

    Attributes:
        density: mass density [kg/m3].
        viscosity: kinematic viscosity [m2/s].
        wind: uniform velocity of the fluid, z up, sweep measured from x [m/s].
    """

    density: Annotated[float | None, _own("the rig's", "FLOAT")] = None
    viscosity: Annotated[float | None, _own("the rig's", "FLOAT")] = None
    wind: Annotated[tuple[float, float, float] | None, _own("the rig's", "FLOAT FLOAT FLOAT")] = (
        None
    )

    def build(self, own: Fluid = WATER) -> Fluid:
        """The fluid. ValueError for a value that is not a positive number.

        Args:
            own: the rig's.
        """
        return Fluid(
            own.density if self.density is None else self.density,
            own.kinematic_viscosity if self.viscosity is None else self.viscosity,
            own.wind if self.wind is None else self.wind,
        )


@dataclass(frozen=True)
class ModelOptions:
    """How the fluid is modelled: as in the rig's file, but for what is given here.

    Attributes:
        kind: the paper's vortex lattice with its free wake; the lattice extended for separated
            flow, or as accurate as its panels in attached flow; quasi-steady blade elements. One
            that is named has its own defaults; without a name the rig's own model is changed.
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
        Literal["uvlm", "uvlm-extended", "uvlm-accurate", "quasi-steady"] | None,
        _own("the rig's", "{uvlm,uvlm-extended,uvlm-accurate,quasi-steady}", name="model"),
    ] = None
    steps_per_cycle: Annotated[int | None, _own("the model's", "INT")] = None
    chordwise: Annotated[int | None, _own("the model's", "INT")] = None
    spanwise: Annotated[int | None, _own("the model's", "INT")] = None
    suction_efficiency: Annotated[float | None, _own("the model's", "FLOAT")] = None
    core: Annotated[float | None, _own("the model's", "FLOAT")] = None
    wake_cycles: Annotated[float | None, _own("the model's", "FLOAT")] = None
    threads: Annotated[int | None, _own("the model's", "INT")] = None
    coefficients: Annotated[
        Literal["dickinson1999", "lee2016", "hover-tank"] | None,
        _own("the model's", "{dickinson1999,lee2016,hover-tank}"),
    ] = None

    def build(self, own: UVLM | QuasiSteady = _UVLM) -> UVLM | QuasiSteady:
        """The model.

        Args:
            own: the rig's.

        Raises:
            ValueError: a value out of range, or an option of the other model.
        """
        base = own if self.kind is None else _NAMED[self.kind]
        kind = self.kind or ("quasi-steady" if isinstance(own, QuasiSteady) else "uvlm")
        if kind != "uvlm":
            _refuse_changed(self, ["suction_efficiency"], f"with --model {kind}")
        if isinstance(base, QuasiSteady):
            _refuse_changed(self, list(_LATTICE), f"with --model {kind}")
        else:
            _refuse_changed(self, ["coefficients"], f"with --model {kind}")
        named = (*_LATTICE, "steps_per_cycle", "suction_efficiency")
        changes = {name: getattr(self, name) for name in named if getattr(self, name) is not None}
        if self.coefficients is not None:
            changes["coefficients"] = _COEFFICIENTS[self.coefficients]
        return replace(base, **changes)


def _flag(field: str) -> str:
    return "--" + field.replace("_", "-")


def _refuse_changed(options: Any, names: list[str], when: str) -> None:
    """An option that would be ignored is an error, not a surprise."""
    for field in fields(options):
        value = getattr(options, field.name)
        if field.name in names and value != field.default:
            raise check.fail("options", _flag(field.name), f"left out {when}", value)
