"""Sudden acceleration of a rectangle against Katz & Plotkin's own program, with its settings."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from flaprig import _checks as check
from flaprig.aero.air import Progress
from flaprig.aero.models import Rate
from flaprig.report import style
from flaprig.validation.flight import lattice_air, lift_of, rectangle, steady
from flaprig.validation.outcome import Outcome, Row

Array = NDArray[np.float64]

SOURCE = "Katz & Plotkin 2001, program 16"
# chords travelled, and C_L at 5 degrees by aspect ratio: their program 16 run with 4 x 13 panels on
# the semi-span, U dt/c = 1/16, the first wake element 0.3 U dt long
PASSED = (0.25, 0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 7.0, 9.94)
PROGRAM_16 = {
    4.0: (0.2715, 0.2754, 0.2880, 0.3036, 0.3112, 0.3152, 0.3174, 0.3196, 0.3209),
    12.0: (0.3199, 0.3296, 0.3532, 0.3852, 0.4039, 0.4156, 0.4232, 0.4321, 0.4382),
}


@dataclass(frozen=True)
class KatzPlotkin:
    """Sudden acceleration of a flat rectangle to constant speed, as Katz & Plotkin's program.

    Blunt tips, the backward rate, and their length of the first wake element; the wake convects
    freely. The first step is an impulse and no number to compare.

    Attributes:
        aspect_ratio: of the rectangle; 4 and 12 have a reference, and the default shows both.
        angle_deg: angle of attack.
        chordwise: panels along the chord.
        semi_panels: panels on the semi-span.
        step: of time, in chords travelled.
        first_element: length of the first wake element in steps.
        distance: chords travelled in all.
    """

    name: ClassVar[str] = "katz-plotkin"
    claim: ClassVar[str] = "their program, sudden acceleration of rectangles"

    aspect_ratio: float = 4.0
    angle_deg: float = 5.0
    chordwise: int = 4
    semi_panels: int = 13
    step: float = 1.0 / 16.0
    first_element: float = 0.3
    distance: float = 10.0

    def run(self, progress: Progress | None = None) -> Outcome:
        """Run the case. ValueError for a parameter out of range."""
        self._check()
        # by default every wing that has a reference
        ratios = list(PROGRAM_16) if self == KatzPlotkin() else [self.aspect_ratio]
        flown = {ratio: replace(self, aspect_ratio=ratio)._histories(progress) for ratio in ratios}
        rows = [row for ratio in ratios for row in self._rows(ratio, *flown[ratio][:2])]
        passed, lift, drag = flown[self.aspect_ratio]
        data = {
            "aspect_ratio": self.aspect_ratio,
            "angle_of_attack_rad": math.radians(self.angle_deg),
            "ut_over_c": passed,
            "cl": lift,
            "cd": drag,
        }
        return Outcome(tuple(rows), data, lambda path: self._draw(path, flown), NOTES)

    def _rows(self, ratio: float, passed: Array, lift: Array) -> list[Row]:
        known = self._reference(ratio)
        ours = np.interp(PASSED, passed, lift)
        return [
            Row(
                f"AR {ratio:g}, C_L at Ut/c = {where:g}",
                float(value),
                theirs,
                SOURCE if theirs else "",
                1.0 if theirs else None,
            )
            for where, value, theirs in zip(PASSED, ours, known or [None] * 9, strict=True)
            if where <= passed[-1]
        ]

    def _check(self) -> None:
        check.in_range(self.name, "aspect_ratio", self.aspect_ratio, 0.1, 1000.0)
        check.in_range(self.name, "angle_deg", self.angle_deg, 0.01, 90.0, "degrees")
        check.in_range(self.name, "step", self.step, 1e-3, 1.0, "chords")
        check.in_range(self.name, "first_element", self.first_element, 0.02, 50.0, "steps")
        check.in_range(self.name, "distance", self.distance, 2.0 * self.step, 100.0, "chords")
        check.whole(self.name, "semi_panels", self.semi_panels, 1, 64)

    def _reference(self, ratio: float) -> tuple[float, ...] | None:
        """What their program gives, if these are its settings."""
        theirs = KatzPlotkin(self.aspect_ratio, distance=self.distance)
        return PROGRAM_16.get(float(ratio)) if self == theirs else None

    def _histories(self, progress: Progress | None) -> tuple[Array, Array, Array]:
        """Chords travelled, C_L and C_D after each step but the first."""
        angle, count = math.radians(self.angle_deg), math.ceil(self.distance / self.step) + 1
        air = lattice_air(
            rectangle(self.aspect_ratio),
            self.chordwise,
            2 * self.semi_panels,
            self.step,
            count,
            tip_inset=0.0,
            shedding_fraction=self.first_element / (1.0 + self.first_element),
            rate=Rate.BACKWARD,
        )
        motion = steady(count, self.step, angle=angle)
        loads = air.run(motion, self.step, progress)
        pressure = 0.5 * self.aspect_ratio
        lift = lift_of(loads, motion) / pressure
        return self.step * np.arange(1.0, count), lift[1:], lift[1:] * math.tan(angle)

    def _draw(self, path: Path, flown: Mapping[float, tuple[Array, Array, Array]]) -> None:
        with style.figure(6.2, 3.6) as drawing:
            axes = drawing.subplots()
            for (ratio, (passed, lift, _)), colour in zip(
                flown.items(), style.SERIES, strict=False
            ):
                axes.plot(passed, lift, color=colour, label=f"flaprig, AR {ratio:g}")
                known = self._reference(ratio)
                if known:
                    label = f"{SOURCE}, AR {ratio:g}"
                    axes.plot(PASSED, known, "o", color=colour, ms=4.5, label=label)
            axes.set(xlabel="chords travelled $Ut/c$", ylabel="$C_L$", xlim=(0.0, self.distance))
            axes.set_title(f"Sudden acceleration, {self.angle_deg:g}°")
            axes.legend(fontsize=8.0)
            style.save(drawing, path)


NOTES = ("cd is the drag of the normal force alone, C_L tan(alpha): without leading-edge thrust.",)
