"""Wagner's function: the lift of a section after a sudden start."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from flaprig import _checks as check
from flaprig import theory
from flaprig.aero.air import Progress
from flaprig.aero.models import UVLM
from flaprig.report import style
from flaprig.validation.flight import SECTION, section_air, steady
from flaprig.validation.outcome import Outcome, Row

Array = NDArray[np.float64]

# semichords travelled
DISTANCE = (1.0, 2.0, 4.0, 10.0, 20.0)
# small: the theory is linear [rad]
ANGLE = math.radians(1.0)
# settings of the lattice that the two modes differ in
_ACCURATE = UVLM.accurate()
MODES: dict[str, dict[str, Any]] = {
    "accurate": {"shedding_fraction": _ACCURATE.shedding_fraction, "rate": _ACCURATE.rate},
    "paper": {},
}


@dataclass(frozen=True)
class Wagner:
    """Lift of a section after a sudden start, as a share of the steady lift.

    Attributes:
        chordwise: panels along the chord.
        mode: the accurate lattice, or the paper's.
        step: wake step in panels travelled.
    """

    name: ClassVar[str] = "wagner"
    claim: ClassVar[str] = "Wagner's function, by Jones and exactly"

    chordwise: int = 16
    mode: Literal["accurate", "paper"] = "accurate"
    step: float = 1.0

    def run(self, progress: Progress | None = None) -> Outcome:
        """Run the case. ValueError for a parameter out of range."""
        check.whole(self.name, "chordwise", self.chordwise, 1, 64)
        check.in_range(self.name, "step", self.step, 0.1, 10.0, "panels")
        passed, share = self._shares(progress)
        ours = np.interp(DISTANCE, passed, share)
        within = 2.0 if self.mode == "accurate" else None
        rows = [
            Row(f"s = {s:g}", v, float(theory.wagner(s)), "R. T. Jones 1940", within)
            for s, v in zip(DISTANCE, ours, strict=True)
        ]
        rows += [
            Row(f"s = {s:g}", v, theory.wagner_exact(s), "Garrick 1938, exact", within)
            for s, v in zip(DISTANCE, ours, strict=True)
        ]
        data = {"semichords": passed, "share_of_steady_lift": share}
        return Outcome(tuple(rows), data, lambda path: self._draw(path, passed, share))

    def _shares(self, progress: Progress | None) -> tuple[Array, Array]:
        step = self.step / self.chordwise
        count = math.ceil(0.5 * max(DISTANCE) / step) + 2
        air = section_air(self.chordwise, step, count, **MODES[self.mode])
        loads = air.run(steady(count, step, angle=ANGLE), step, progress)
        steady_lift = SECTION * math.pi * math.sin(ANGLE) * math.cos(ANGLE)
        return 2.0 * step * np.arange(1.0, count), loads.base[1:, 2] / steady_lift

    def _draw(self, path: Path, passed: Array, share: Array) -> None:
        with style.figure(6.2, 3.6) as drawing:
            axes = drawing.subplots()
            s = np.linspace(0.0, passed[-1], 400)
            axes.plot(s, theory.wagner(s), color=style.INK, linewidth=1.0, label="R. T. Jones")
            label = f"flaprig, {self.mode}, {self.chordwise} panels"
            axes.plot(passed, share, "o", ms=3.0, color=style.VERMILION, label=label)
            axes.set(xlabel="semichords travelled $s$", ylabel="share of the steady lift")
            axes.set(xlim=(0.0, passed[-1]), ylim=(0.45, 1.0), title="Wagner's function")
            axes.legend()
            style.save(drawing, path)
