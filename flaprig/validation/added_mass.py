"""Added mass: a section against the closed form, a rectangle against the table of its kind."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from flaprig import _checks as check
from flaprig import theory
from flaprig.aero.air import Progress
from flaprig.validation.flight import SECTION, lattice_air, rectangle, section_air
from flaprig.validation.outcome import Outcome, Row

# rectangular plates along their normal, over pi/4 rho c^2 b, by aspect ratio: Meyerhoff 1970, as
# tabulated in DNV-RP-H103, table A-2
RECTANGLES = {1.0: 0.579, 2.0: 0.757, 4.0: 0.872, 8.0: 0.934}


@dataclass(frozen=True)
class AddedMass:
    """The fluid that moves with a plate.

    Attributes:
        chordwise: panels along the chord.
        spanwise: panels along the span of the rectangle.
        aspect_ratio: of the rectangle.
    """

    name: ClassVar[str] = "added-mass"
    claim: ClassVar[str] = "closed forms of a section, Meyerhoff's rectangles"

    chordwise: int = 8
    spanwise: int = 12
    aspect_ratio: float = 4.0

    def run(self, progress: Progress | None = None) -> Outcome:
        """Run the case. ValueError for a parameter out of range."""
        check.positive(self.name, "aspect_ratio", self.aspect_ratio, most=1e3)
        return Outcome((*self._section(), *self._rectangle()))

    def _section(self) -> list[Row]:
        """Heave, pitch about the quarter chord, and the coupling of both, per span."""
        air = section_air(self.chordwise, 1.0, 1)
        mass = air.native.added_mass / SECTION
        plate = float(theory.added_mass_per_span(1.0, 1.0))
        inertia = float(theory.added_inertia_per_span(1.0, 1.0)) + plate / 16.0
        lamb = "Lamb 1932, art. 71"
        return [
            Row("section, heave [kg/m]", mass[0, 0], plate, lamb, 2.0),
            Row("section, pitch about c/4 [kg m]", mass[2, 2], inertia, lamb, 2.0),
            Row("section, heave by pitch [kg]", mass[0, 2], -plate / 4.0, lamb, 2.0),
        ]

    def _rectangle(self) -> list[Row]:
        def ratio(spanwise: int) -> float:
            air = lattice_air(rectangle(self.aspect_ratio), self.chordwise, spanwise, 1.0, 1)
            return float(air.native.added_mass[0, 0] / (np.pi / 4.0 * self.aspect_ratio))

        known = RECTANGLES.get(float(self.aspect_ratio))
        source = "Meyerhoff 1970" if known is not None else ""
        coarse, fine = ratio(self.spanwise), ratio(2 * self.spanwise)
        limit = (4.0 * fine - coarse) / 3.0
        within = (2.0, 0.5) if known is not None else (None, None)
        name = f"rectangle AR {self.aspect_ratio:g}"
        return [
            Row(f"{name}, {self.spanwise} strips", coarse, known, source, within[0]),
            Row(f"{name}, extrapolated", limit, known, source, within[1]),
        ]
