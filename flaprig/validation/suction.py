"""Suction around the leading edge and the sides of a flat plate, against thin-plate theory."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from flaprig import _checks as check
from flaprig import theory
from flaprig.aero.air import Air, Progress
from flaprig.aero.models import UVLM
from flaprig.native import _native
from flaprig.validation.flight import FLUID, SECTION, section_air, steady
from flaprig.validation.outcome import Outcome, Row
from flaprig.wing import Wing

# long steps: steady flow does not care, and the starting vortex is left far behind [s]
STEP, COUNT = 50.0, 40


@dataclass(frozen=True)
class Suction:
    """Eq. 6 in steady flow past a section, and its like at the sides of a plate in cross flow.

    Attributes:
        panels: along the chord, and along the span; the finer mesh has twice as many.
        angle_deg: angle of attack of the section.
    """

    name: ClassVar[str] = "suction"
    claim: ClassVar[str] = "thin-plate theory, with and without the factor 4/pi"

    panels: int = 16
    angle_deg: float = 5.0

    def run(self, progress: Progress | None = None) -> Outcome:
        """Run the case. ValueError for a parameter out of range."""
        check.whole(self.name, "panels", self.panels, 1, 32)
        plain = [self._leading_edge(n, 1.0) for n in (self.panels, 2 * self.panels)]
        exact = [self._leading_edge(n, 4.0 / math.pi) for n in (self.panels, 2 * self.panels)]
        sides = [self._side(n) for n in (self.panels, 2 * self.panels)]
        theirs = "Katz & Plotkin 2001, sec. 5.4"
        n = self.panels
        return Outcome(
            (
                Row(f"eq. 6 as printed, {n} panels", plain[0], math.pi / 4, theirs, 3.0),
                Row("eq. 6 as printed, extrapolated", _limit(plain), math.pi / 4, theirs, 1.0),
                Row(f"with 4/pi, {n} panels", exact[0], 1.0, theirs, 3.0),
                Row("with 4/pi, extrapolated", _limit(exact), 1.0, theirs, 1.0),
                Row(f"sides, {n} strips", sides[0], 1.0, "Lamar 1974"),
                Row("sides, extrapolated", _limit(sides), 1.0, "Lamar 1974", 1.0),
            ),
            notes=("All as shares of the suction in theory.",),
        )

    def _leading_edge(self, chordwise: int, factor: float) -> float:
        """Share of pi rho c U^2 sin^2 alpha."""
        angle = math.radians(self.angle_deg)
        settings = {"suction_efficiency": 1.0, "suction_factor": factor}
        air = section_air(chordwise, STEP, COUNT, **settings)
        force = air.run(steady(COUNT, STEP, angle=angle), STEP).extra[-1, 2]
        exact = SECTION * theory.flat_plate_suction_per_span(1.0, 1.0, 1.0, angle)
        return float(force / exact)

    def _side(self, spanwise: int) -> float:
        """Share of pi/4 rho w^2 b for each side, on a plate much longer than wide."""
        wing = Wing.rectangular(span=1.0, chord=SECTION)
        model = UVLM(1, spanwise, suction_efficiency=0.0, side_suction_efficiency=1.0)
        air = Air(wing, FLUID, model, 1.0)
        force = _cross_flow(air)
        exact = 2.0 * SECTION * theory.side_suction_per_chord(1.0, 1.0, 1.0)
        return float(abs(force) / exact)


def _cross_flow(air: Air) -> float:
    """Suction of a plate that moves along its normal at 1 m/s, before any wake [N]."""
    native: _native.Air = air.native
    twist = np.array([[0.0, 0.0, 1.0, 0.0, 0.0, 0.0]])
    still = np.zeros((1, 3)), np.eye(3)[None], twist, np.zeros((1, 6))
    return float(native.run(air.state.copy(), 1.0, *still)[1][0, 2])


def _limit(shares: list[float]) -> float:
    """Richardson's limit of a first-order error."""
    return 2.0 * shares[1] - shares[0]
