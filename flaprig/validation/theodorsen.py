"""Theodorsen's function: harmonic heave and pitch of a section."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from flaprig import _checks as check
from flaprig import theory
from flaprig.aero.air import Progress
from flaprig.report import style
from flaprig.validation.case import on_all_cores
from flaprig.validation.flight import SECTION, flight, lift_of, section_air
from flaprig.validation.outcome import Outcome, Row
from flaprig.validation.wagner import MODES

Array = NDArray[np.float64]

# of the chord, and in radians: small, since the theory is linear
AMPLITUDE = 0.01
PERIODS = 3
KINDS = ("heave", "pitch")
# reduced frequencies that the demands are made at
DEMANDED = (0.1, 0.5)


@dataclass(frozen=True)
class Theodorsen:
    """Lift of a section in harmonic heave, and in pitch about the quarter chord.

    Attributes:
        frequencies: reduced frequencies omega c / 2U.
        chordwise: panels along the chord.
        mode: the accurate lattice, or the paper's.
    """

    name: ClassVar[str] = "theodorsen"
    claim: ClassVar[str] = "Theodorsen's heave and pitch"

    frequencies: tuple[float, ...] = (0.1, 0.5, 1.0)
    chordwise: int = 8
    mode: Literal["accurate", "paper"] = "accurate"

    def run(self, progress: Progress | None = None) -> Outcome:
        """Run the case. ValueError for a parameter out of range."""
        check.whole(self.name, "chordwise", self.chordwise, 1, 64)
        for k in self.frequencies:
            check.in_range(self.name, "frequencies", k, 0.01, 10.0)
        jobs = [(kind, k) for kind in KINDS for k in self.frequencies]
        ratios = on_all_cores(lambda job: self._ratio(*job), jobs, progress)
        rows = [
            row for job, ratio in zip(jobs, ratios, strict=True) for row in self._rows(job, ratio)
        ]
        data = {
            f"{kind}_{name}": [f(r) for j, r in zip(jobs, ratios, strict=True) if j[0] == kind]
            for kind in KINDS
            for name, f in (("amplitude_ratio", abs), ("phase_error_rad", np.angle))
        }
        data["reduced_frequency"] = list(self.frequencies)
        return Outcome(tuple(rows), data, lambda path: self._draw(path, jobs, ratios))

    def _rows(self, job: tuple[str, float], ratio: complex) -> list[Row]:
        kind, k = job
        demanded = self.mode == "accurate" and k in DEMANDED
        within = (5.0, 3.0) if demanded else (None, None)
        theirs = "Theodorsen 1935"
        return [
            Row(f"{kind} k = {k:g}, lift amplitude ratio", abs(ratio), 1.0, theirs, within[0]),
            Row(
                f"{kind} k = {k:g}, phase error [°]",
                math.degrees(float(np.angle(ratio))),
                0.0,
                theirs,
                within[1],
                relative=False,
            ),
        ]

    def _ratio(self, kind: str, k: float) -> complex:
        """Our lift over Theodorsen's, of the last period."""
        omega = 2.0 * k  # chord and speed are one
        count = round(2.0 * math.pi / omega * self.chordwise)
        step = 2.0 * math.pi / omega / count
        time = step * np.arange(count * PERIODS)
        wave = AMPLITUDE * np.exp(1j * omega * time)
        parts = tuple((wave * (1j * omega) ** n).real for n in range(3))
        motion = flight(time, heave=parts) if kind == "heave" else flight(time, pitch=parts)
        air = section_air(self.chordwise, step, len(time), **MODES[self.mode])
        lift = lift_of(air.run(motion, step), motion) / SECTION
        ours = 2.0 * np.mean(lift[-count:] * np.exp(-1j * omega * time[-count:]))
        # his heave is positive down
        heave, pitch = (-AMPLITUDE, 0.0) if kind == "heave" else (0.0, AMPLITUDE)
        return complex(ours / theory.oscillating_aerofoil(1.0, 1.0, 1.0, omega, heave, pitch)[0])

    def _draw(
        self, path: Path, jobs: Sequence[tuple[str, float]], ratios: Sequence[complex]
    ) -> None:
        with style.figure(6.2, 4.4) as drawing:
            amplitude, phase = drawing.subplots(2, 1, sharex=True)
            for kind, colour in zip(KINDS, style.SERIES, strict=False):
                k = [job[1] for job in jobs if job[0] == kind]
                z = np.array([r for job, r in zip(jobs, ratios, strict=True) if job[0] == kind])
                amplitude.plot(k, np.abs(z), "o-", ms=4.0, color=colour, label=kind)
                phase.plot(k, np.degrees(np.angle(z)), "o-", ms=4.0, color=colour)
            amplitude.axhline(1.0, color=style.INK, linewidth=0.8)
            phase.axhline(0.0, color=style.INK, linewidth=0.8)
            amplitude.set(ylabel="amplitude ratio", title="Lift over Theodorsen's")
            phase.set(ylabel="phase error [°]", xlabel="reduced frequency $k$")
            amplitude.legend()
            style.save(drawing, path)
