"""Lift of a steady section and of steady rectangles."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import ClassVar

from flaprig import _checks as check
from flaprig import theory
from flaprig.aero.air import Progress
from flaprig.validation.flight import SECTION, lattice_air, lift_of, rectangle, section_air, steady
from flaprig.validation.outcome import Outcome, Row

# per radian, Richardson's limits of an independent prototype of the method, by aspect ratio
PROTOTYPE = {4.0: 3.60, 8.0: 4.56}
# steps of four chords: the starting vortex ends a hundred chords behind
STEP, COUNT = 4.0, 25


@dataclass(frozen=True)
class LiftSlope:
    """Lift slope of a steady rectangle, extrapolated, and of a section.

    Attributes:
        aspect_ratio: of the rectangle; 4 and 8 have a reference, and the default shows both.
        chordwise: panels along the chord.
        spanwise: panels along the span; the finer mesh has twice as many.
    """

    name: ClassVar[str] = "lift-slope"
    claim: ClassVar[str] = "thin aerofoils, Richardson's limit of rectangles"

    aspect_ratio: float = 4.0
    chordwise: int = 4
    spanwise: int = 12

    def run(self, progress: Progress | None = None) -> Outcome:
        """Run the case. ValueError for a parameter out of range."""
        check.positive(self.name, "aspect_ratio", self.aspect_ratio, most=1e3)
        ratios = list(PROTOTYPE) if self == LiftSlope() else [self.aspect_ratio]
        rectangles = [row for r in ratios for row in replace(self, aspect_ratio=r)._rows()]
        return Outcome((*_section(), *rectangles))

    def _rows(self) -> list[Row]:
        coarse, fine = (self._slope(n) for n in (self.spanwise, 2 * self.spanwise))
        limit = (4.0 * fine - coarse) / 3.0
        known = PROTOTYPE.get(float(self.aspect_ratio))
        source = "prototype, extrapolated" if known is not None else ""
        guide = float(theory.helmbold_lift_slope(self.aspect_ratio))
        name = f"rectangle AR {self.aspect_ratio:g}"
        return [
            Row(f"{name}, {self.spanwise} strips [1/rad]", coarse, known, source),
            Row(f"{name}, extrapolated [1/rad]", limit, known, source, known and 1.0),
            Row(f"{name}, extrapolated [1/rad]", limit, guide, "Helmbold: an upper guide"),
        ]

    def _slope(self, spanwise: int) -> float:
        angle = math.radians(1.0)
        air = lattice_air(rectangle(self.aspect_ratio), self.chordwise, spanwise, STEP, COUNT)
        loads = air.run(steady(COUNT, STEP, angle=angle), STEP)
        return float(loads.base[-1, 2] / (0.5 * self.aspect_ratio * angle))


def _section() -> list[Row]:
    """Lift and centre of pressure of the two-dimensional limit."""
    angle, step, count = math.radians(5.0), 50.0, 40
    air, motion = section_air(8, step, count), steady(count, step, angle=angle)
    loads = air.run(motion, step)
    # the normal force alone: without suction the lift loses cos^2
    lift = lift_of(loads, motion)[-1] / (0.5 * SECTION) / math.cos(angle) ** 2
    ahead = 0.25 - loads.base[-1, 4] / loads.base[-1, 2]
    exact = 2.0 * math.pi * math.sin(angle)
    return [
        Row("section, C_L over cos² at 5°", lift, exact, "thin aerofoils", 0.5),
        Row("section, centre of pressure [c]", ahead, 0.25, "thin aerofoils", 0.1),
    ]
