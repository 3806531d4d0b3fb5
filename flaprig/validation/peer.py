"""An independent vortex lattice code beside ours: where both must agree, and where they cannot.

C. Urban, Ptera Software (doi:10.5281/zenodo.19229119); what drives it is in `peer_code`. The same
panels, steps and motion go to both. Its tips are blunt, so in flight ours are too.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from flaprig import _checks as check
from flaprig import theory
from flaprig.aero.air import Air, Progress, WingLoads
from flaprig.aero.models import UVLM, Rate
from flaprig.aero.result import Result
from flaprig.aero.rigid_motion import RigidMotion
from flaprig.aero.simulate import prescribed, result_of
from flaprig.fluid import WATER
from flaprig.report import style
from flaprig.strokes import SunTangStroke
from flaprig.validation import peer_code
from flaprig.validation.flight import SECTION, flight, lattice_air, lift_of, rectangle, steady
from flaprig.validation.outcome import Outcome, Row
from flaprig.validation.wagner import MODES
from flaprig.wing import RIG_WING, Wing

Array = NDArray[np.float64]

STROKE = SunTangStroke(0.2, math.pi / 3, math.pi / 4)
# amplitude in chords: small, since the waves are compared as if they were linear
HEAVE, PERIODS = 0.01, 3
# [%] of lift: as it is, up to 4 panels, of which its core of 3 % of the chord is an eighth (its
# share of the lift grows with the panels); and settled, the core off its wing
WITHIN, WITHIN_SPARED, MOST_PANELS = 2.0, 0.5, 4
# of phase [steps], its loads taken a step earlier; of places [c]: rounding
WITHIN_PHASE, WITHIN_PLACE = 0.2, 1e-9
# [degrees] a step of the heave, up to which amplitudes are held
MOST_TURN = 10.0
# all the leading-edge suction of a flat plate, of which eq. 6 returns pi/4
ALL_SUCTION = {"suction_efficiency": 1.0, "suction_factor": 4.0 / math.pi}
# our settings towards its, one upon the other; its core grows with age to about a tenth
BLUNT: dict[str, Any] = {"tip_inset": 0.0}
SHED = BLUNT | {"shedding_fraction": 0.2, "rate": Rate.BACKWARD}
WHOLE = SHED | {"wake_cycles": 10.0, "wake_detail": 0.0, "wake_fade": 0.0, "core": 0.1}
TOWARDS = {"blunt tips": BLUNT, "+ its shedding, rate": SHED, "+ whole wake, core 0.1 c": WHOLE}
SPARED, NORMAL = "core off its wing", "normal force a step earlier"
FLIGHT = (
    "Flight: its bound and wake rings act on its own wing with a core of 3 % of the chord, which "
    "raises the lift, the more the finer the panels; spared that, it agrees. Its lift is one step "
    "late, half of that because its velocities are differences over the last step."
)
MISSING = "Ptera Software is not installed: pip install flaprig[bench]"


@dataclass(frozen=True)
class Peer:
    """Ptera Software beside flaprig: a sudden start, heave, and the rig's sinusoid in hover.

    Attributes:
        chordwise: panels along the chord.
        spanwise: panels along the span.
        steps_per_cycle: steps in a cycle of hover; in flight the wing moves a panel a step.
        cycles: of hover; averaged as `simulate` does.
        aspect_ratio: of the wing in flight.
        angle_deg: its angle of attack after the sudden start.
        distance: chords that it then travels.
        reduced_frequency: omega c / 2U of its heave.
    """

    name: ClassVar[str] = "peer"
    claim: ClassVar[str] = "another vortex lattice code, Ptera Software"

    chordwise: int = 4
    spanwise: int = 8
    steps_per_cycle: int = 40
    cycles: int = 4
    aspect_ratio: float = 6.0
    angle_deg: float = 3.0
    distance: float = 10.0
    reduced_frequency: float = 0.2

    def run(self, progress: Progress | None = None) -> Outcome:
        """Run the case. ValueError for a parameter out of range."""
        self._check()
        if not peer_code.installed():
            return Outcome((), notes=(MISSING,))
        start = self._start()
        settled = f"C_L {start[0, -1]:g} chords after a sudden start"
        rows = [*self._pair(settled, start[1:, -1], WITHIN, WITHIN_SPARED), *self._heave_rows()]
        flown, apart = self._hover()
        if progress is not None:
            progress(1.0)
        rows += [
            Row("hover, panels' corners apart [c]", apart, 0.0, "our motion", WITHIN_PLACE, False),
            *_hover_rows(flown),
        ]
        data = {"ut_over_c": start[0], "cl_after_start": start[1], "cl_after_start_peer": start[2]}
        data |= {f"hover_lift_{key}_N": flown[key].lift for key in ("ours", "theirs", "normal")}
        notes = (FLIGHT, _reason(flown))
        return Outcome(tuple(rows), data, lambda path: _draw(path, start, flown), notes)

    def _check(self) -> None:
        check.whole(self.name, "chordwise", self.chordwise, 2, 16)
        check.whole(self.name, "spanwise", self.spanwise, 1, 32)
        check.whole(self.name, "steps_per_cycle", self.steps_per_cycle, 8, 200)
        check.whole(self.name, "cycles", self.cycles, 2, 10)
        check.in_range(self.name, "aspect_ratio", self.aspect_ratio, 0.5, 100.0)
        check.in_range(self.name, "angle_deg", self.angle_deg, 0.01, 10.0, "degrees")
        check.in_range(self.name, "distance", self.distance, 1.0, 50.0, "chords")
        check.in_range(self.name, "reduced_frequency", self.reduced_frequency, 0.05, 1.0)

    def _start(self) -> Array:
        """Chords travelled, and C_L of ours, theirs, and theirs with the core off its wing; without
        the first two steps, which feel the impulse. Shape (4, n)."""
        step, count = 1.0 / self.chordwise, math.ceil(self.distance * self.chordwise) + 1
        motion = steady(count, step, angle=math.radians(self.angle_deg))
        wing = rectangle(self.aspect_ratio)
        lift = self._lift(wing, self.spanwise, step, motion, angle_deg=self.angle_deg)
        return np.array([step * np.arange(count), *lift])[:, 2:]

    def _pair(
        self, name: str, values: Array, within: float | None, spared: float | None
    ) -> list[Row]:
        """Ours beside theirs, and beside theirs with the core off its wing, and both tolerances."""
        within = within if self.chordwise <= MOST_PANELS else None
        source = peer_code.source()
        return [
            Row(name, values[0], values[1], source, within),
            Row(name, values[0], values[2], f"{source}, {SPARED}", spared),
        ]

    def _heave_rows(self) -> list[Row]:
        """Amplitude and phase of the lift; of a section's, how late it is."""
        k, theirs = self.reduced_frequency, peer_code.source()
        waves, turn = self._waves(rectangle(self.aspect_ratio), self.spanwise)
        phase, behind = np.angle(waves[0], deg=True), np.angle(waves[0] / waves[1], deg=True)
        section, _ = self._waves(rectangle(SECTION), 1)
        exact = theory.oscillating_aerofoil(1.0, 1.0, 1.0, 2.0 * k, -HEAVE, 0.0)[0]
        late = np.angle(exact / section, deg=True) / turn
        against = f"{theirs}, both beside Theodorsen"
        size, within = f"heave k = {k:g}, amplitude of C_L", WITHIN if turn <= MOST_TURN else None
        expected, earlier = phase - behind + turn, f"{theirs}, a step earlier"
        name, most = f"heave k = {k:g}, phase of C_L [°]", WITHIN_PHASE * turn
        return [
            *self._pair(size, np.abs(waves), within, within),
            Row(name, phase, expected, earlier, most, relative=False),
            Row("heaving section, late [steps]", late[0], late[1], against, relative=False),
        ]

    def _waves(self, wing: Wing, spanwise: int) -> tuple[Array, float]:
        """Complex amplitudes of C_L in heave, relative to it, of ours and both of theirs; and the
        phase of a step [degrees]."""
        omega = 2.0 * self.reduced_frequency  # chord and speed are one
        count = round(2.0 * math.pi / omega * self.chordwise)
        step = 2.0 * math.pi / omega / count
        time = step * np.arange(PERIODS * count)
        # a sine: starts at rest
        wave = np.exp(1j * (omega * time - 0.5 * math.pi))
        moved = tuple((HEAVE * wave * (1j * omega) ** n).real for n in range(3))
        heave = (HEAVE, 2.0 * math.pi / omega)
        lift = self._lift(wing, spanwise, step, flight(time, heave=moved), heave=heave)
        return 2.0 * np.mean((lift * wave.conj())[:, -count:], axis=1), 360.0 / count

    def _lift(
        self, wing: Wing, spanwise: int, step: float, motion: RigidMotion, **theirs: Any
    ) -> Array:
        """C_L of ours, theirs, theirs with the core off its wing; `theirs` is the peer's motion."""
        mesh, count = (self.chordwise, spanwise), len(motion)
        air = lattice_air(wing, *mesh, step, count, tip_inset=0.0, **MODES["accurate"])
        peers = [
            peer_code.fly(wing, mesh, step, count, coreless=spared, **theirs)
            for spared in (False, True)
        ]
        return np.array([lift_of(air.run(motion, step), motion), *peers]) / (0.5 * wing.area)

    def _hover(self) -> tuple[dict[str, Result], float]:
        """The sinusoid by both codes, and how far the peer's panels are from ours [c]."""
        mesh, steps = (self.chordwise, self.spanwise), self.steps_per_cycle
        motion = prescribed(STROKE, self.cycles, steps)
        rigid = RigidMotion.from_stroke(motion)
        job = (RIG_WING, mesh, WATER, STROKE, steps, rigid)
        theirs, apart = peer_code.hover(*job)
        spared, _ = peer_code.hover(*job, coreless=True)
        loads = {"ours": self._ours(rigid), "theirs": theirs, "spared": spared}
        loads["along"] = _along_chord(self._ours(rigid, **WHOLE, **ALL_SUCTION))
        loads["normal"] = _normal(theirs, steps)
        loads |= {name: self._ours(rigid, **changes) for name, changes in TOWARDS.items()}
        return {
            name: result_of(RIG_WING, STROKE, WATER, motion, each, self.cycles)
            for name, each in loads.items()
        }, apart

    def _ours(self, rigid: RigidMotion, **changes: Any) -> WingLoads:
        settings = {"suction_efficiency": 0.0} | changes
        model = UVLM(self.chordwise, self.spanwise, self.steps_per_cycle, **settings)
        air = Air(RIG_WING, WATER, model, STROKE.frequency, STROKE.sweep_amplitude)
        return air.run(rigid, STROKE.period / self.steps_per_cycle)


def _normal(loads: WingLoads, period: int) -> WingLoads:
    """The force normal to the plate alone, a step earlier; a period of steps before the last one
    stands for the one after it."""
    across = np.array([0.0, 0.0, 1.0, 0.0, 0.0, 0.0])
    base = across * np.concatenate([loads.base[1:], loads.base[-period:][:1]])
    return WingLoads(base, loads.extra, loads.added_mass)


def _along_chord(loads: WingLoads) -> WingLoads:
    """The suction turned from the normal onto the chord, forwards, as in attached flow."""
    thrust = np.zeros_like(loads.extra)
    thrust[:, 0] = -np.abs(loads.extra[:, 2])
    return WingLoads(loads.base, thrust, loads.added_mass)


def _hover_rows(flown: dict[str, Result]) -> list[Row]:
    """Means of both codes, and how alike the histories of lift are."""
    theirs = peer_code.source()
    normal, spared = f"{theirs}, {NORMAL}", f"{theirs}, {SPARED}"
    pairs = [
        ("hover", "ours", "theirs", theirs),
        ("hover", "ours", "spared", spared),
        ("hover, its settings, suction along chord", "along", "theirs", theirs),
        ("hover", "ours", "normal", normal),
        *((f"hover, {name}", name, "normal", normal) for name in TOWARDS),
    ]
    alike = "hover, correlation of the lifts"
    whole, across = (_alike(flown["ours"], flown[key]) for key in ("theirs", "normal"))
    return [
        *(row for name, a, b, source in pairs for row in _means(name, flown[a], flown[b], source)),
        Row(alike, whole, 1.0, theirs, relative=False),
        Row(alike, across, 1.0, normal, relative=False),
    ]


def _means(name: str, ours: Result, theirs: Result, source: str) -> tuple[Row, Row]:
    spread, ratio_spread = ours.cl_spread, ours.lift_to_drag_spread
    return (
        Row(f"{name}, C_L", ours.cl, theirs.cl, source, spread=spread),
        Row(f"{name}, L/D", ours.lift_to_drag, theirs.lift_to_drag, source, spread=ratio_spread),
    )


def _alike(ours: Result, theirs: Result) -> float:
    """Correlation of the lifts in the averaged cycles."""
    return float(np.corrcoef(ours.averaged(ours.lift), theirs.averaged(theirs.lift))[0, 1])


def _reason(flown: dict[str, Result]) -> str:
    """Why they differ in hover, and what each part of it amounts to."""
    c = {name: f"{r.cl:.2f} and {r.lift_to_drag:.2f}" for name, r in flown.items()}
    theirs, matched = flown["theirs"], list(TOWARDS)[-1]
    core = 100.0 * (theirs.cl / flown["spared"].cl - 1.0)
    before, last = theirs.lift.reshape(-1, theirs.steps_per_cycle).mean(axis=1)[-2:]
    step = 100.0 * (last / before - 1.0)
    return (
        "Hover: it has Kutta-Joukowski's force on every segment, and with it the whole thrust of "
        "the leading edge along the plate, which separated flow has lost (the paper measured L/D "
        f"0.74); ours with suction 0 is normal to the plate. C_L and L/D: its total {c['theirs']}, "
        f"its normal force alone {c['normal']}, ours {c['ours']}, with its settings {c[matched]}, "
        f"and then with all suction turned along the chord {c['along']}. Its core on its own wing "
        f"makes {core:+.1f} % of its C_L, whose last two cycles differ by {step:+.1f} %."
    )


def _draw(path: Path, start: Array, flown: dict[str, Result]) -> None:
    with style.figure(6.2, 7.6) as drawing:
        begun, whole, across = drawing.subplots(3, 1)
        begun.plot(start[0], start[1], color=style.VERMILION, label="flaprig")
        begun.plot(start[0], start[2], "--", color=style.INK, linewidth=1.2, label="Ptera Software")
        begun.plot(start[0], start[3], ":", color=style.INK, linewidth=1.4, label=SPARED)
        begun.set(xlabel="chords travelled $Ut/c$", ylabel="$C_L$", title="A sudden start")
        begun.legend()
        _draw_lift(whole, flown, "ours", "along", "theirs")
        _draw_lift(across, flown, "ours", "normal")
        whole.set_title("The rig in hover, last cycle")
        style.save(drawing, path)


def _draw_lift(axes: Any, flown: dict[str, Result], *names: str) -> None:
    """Lift coefficients of the last cycle."""
    looks = {
        "ours": ("flaprig, suction 0", style.VERMILION, "-"),
        "along": ("flaprig, suction along the chord", style.BLUE, "-"),
        "theirs": ("Ptera Software", style.INK, "--"),
        "normal": (f"Ptera Software, {NORMAL}", style.INK, "--"),
    }
    for name in names:
        result, (label, colour, line) = flown[name], looks[name]
        cl = result.lift[-result.steps_per_cycle :] / result.reference_force
        axes.plot(np.arange(cl.size) / cl.size, cl, line, color=colour, linewidth=1.4, label=label)
    # room for the legend
    axes.set(xlabel="$t/T$", ylabel="$C_L$", xlim=(0.0, 1.0), ylim=(None, 1.3 * axes.get_ylim()[1]))
    axes.legend(loc="upper center", ncols=len(names), handlelength=1.5, columnspacing=1.5)
