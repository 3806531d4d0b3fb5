"""Leading-edge suction that depends on the Reynolds number."""

from __future__ import annotations

import math
from dataclasses import dataclass

from flaprig import _checks as check


@dataclass(frozen=True)
class SuctionLaw:
    """Suction efficiency slope ln(Re / onset), held within 0 and 1.

    Re is the mean speed at R2 times the mean chord over the kinematic viscosity.

    Attributes:
        slope: rise of the efficiency for each e-fold of the Reynolds number.
        onset: Reynolds number below which there is none.

    Raises:
        ValueError: a slope outside 0 to 10, or an onset that is not positive.
    """

    slope: float
    onset: float

    def __post_init__(self) -> None:
        check.in_range("SuctionLaw", "slope", self.slope, 0, 10)
        check.positive("SuctionLaw", "onset", self.onset)

    def efficiency(self, reynolds: float) -> float:
        """The efficiency at a Reynolds number."""
        return min(1.0, max(0.0, self.slope * math.log(max(reynolds, 1e-9) / self.onset)))
