"""Sharp delta wings: vortex lift of a swept leading edge by the suction analogy."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from flaprig import _checks as check
from flaprig.aero.air import Progress
from flaprig.report import style
from flaprig.validation.case import on_all_cores
from flaprig.validation.flight import lattice_air, lift_of, steady
from flaprig.validation.outcome import Outcome, Row
from flaprig.wing import Wing

Array = NDArray[np.float64]

SOURCE = "Polhamus 1966, experiment"
# angle of attack [degrees] and C_L by aspect ratio: E. C. Polhamus, NASA TN D-3767
MEASURED = {
    1.0: ((4.03, 0.106), (8.14, 0.233), (12.38, 0.385), (16.42, 0.555), (20.06, 0.708)),
    1.5: ((6.01, 0.215), (9.05, 0.343), (12.24, 0.482), (15.14, 0.630), (18.18, 0.782)),
    2.0: ((5.99, 0.245), (9.00, 0.387), (12.11, 0.555), (15.50, 0.719)),
}
# half a root chord a step, until the starting vortex is ten chords behind
STEP, COUNT = 0.5, 22


NOTES = (
    "The suction of a swept edge needs the edge's own length, a strip's width over cos(sweep).",
    "At AR 2 the analogy overshoots: more of the suction than the measured vortex gives back.",
)


def _rms(words: str, errors: Array, within: float | None = None) -> Row:
    rms = float(np.sqrt(np.mean(np.square(errors))))
    return Row(f"{words}, rms error [%]", rms, 0.0, SOURCE, within, relative=False)


@dataclass(frozen=True)
class DeltaWing:
    """Lift of sharp delta wings with all of the leading-edge suction turned into vortex lift.

    Attributes:
        aspect_ratios: 1, 1.5 and 2 have measurements.
        chordwise: panels along the chord.
        spanwise: panels along the whole span.
    """

    name: ClassVar[str] = "delta-wing"
    claim: ClassVar[str] = "Polhamus's measured delta wings"

    aspect_ratios: tuple[float, ...] = (1.0, 1.5, 2.0)
    chordwise: int = 16
    spanwise: int = 32

    def run(self, progress: Progress | None = None) -> Outcome:
        """Run the case. ValueError for a parameter out of range."""
        for ratio in self.aspect_ratios:
            if ratio not in MEASURED:
                raise check.fail(self.name, "aspect_ratios", "1, 1.5 or 2", ratio)
        jobs = [(ratio, *point) for ratio in self.aspect_ratios for point in MEASURED[ratio]]
        lift = on_all_cores(lambda job: self._lift(job[0], job[1]), jobs, progress)
        rows = [
            Row(f"AR {ratio:g}, {alpha:g}°, C_L", ours, theirs, SOURCE)
            for (ratio, alpha, theirs), ours in zip(jobs, lift, strict=True)
        ]
        errors = np.array([row.error for row in rows])
        which = np.array([job[0] for job in jobs])
        rows += [_rms(f"AR {ratio:g}", errors[which == ratio]) for ratio in self.aspect_ratios]
        rows.append(_rms("all", errors, 6.0))
        data = {
            "aspect_ratio": which,
            "angle_of_attack_rad": [math.radians(job[1]) for job in jobs],
            "cl": lift,
        }
        return Outcome(tuple(rows), data, lambda path: self._draw(path, jobs, lift), NOTES)

    def _lift(self, aspect_ratio: float, angle_deg: float) -> float:
        """C_L of a delta wing of root chord 1 m."""
        half, angle = 0.25 * aspect_ratio, math.radians(angle_deg)
        wing = Wing.from_table([0.0, half, 2.0 * half], [0.0, 1.0, 0.0], [1.0, 0.0, 1.0])
        settings = {"suction_efficiency": 1.0, "suction_factor": 4.0 / math.pi, "core": 0.05}
        air = lattice_air(wing, self.chordwise, self.spanwise, STEP, COUNT, **settings)
        motion = steady(COUNT, STEP, angle=angle)
        return float(lift_of(air.run(motion, STEP), motion)[-1] / (0.5 * half))

    def _draw(self, path: Path, jobs: list[tuple[float, float, float]], lift: list[float]) -> None:
        with style.figure(6.2, 3.8) as drawing:
            axes = drawing.subplots()
            for ratio, colour in zip(self.aspect_ratios, style.SERIES, strict=False):
                picked = [k for k, job in enumerate(jobs) if job[0] == ratio]
                alpha = [jobs[k][1] for k in picked]
                axes.plot(alpha, [lift[k] for k in picked], color=colour, label=f"AR {ratio:g}")
                axes.plot(alpha, [jobs[k][2] for k in picked], "o", ms=4.5, color=colour)
            axes.set(xlabel="angle of attack [°]", ylabel="$C_L$", title="Sharp delta wings")
            axes.legend(title="lines: flaprig, dots: measured")
            style.save(drawing, path)
