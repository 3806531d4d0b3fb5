"""A stroke that a search has found, and what it is worth."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Candidate:
    """One evaluated stroke.

    Attributes:
        reward: eq. 12.
        cl: mean lift coefficient.
        lift_to_drag: mean lift over mean drag.
        coefficients: the twelve of equations 8 and 9.
    """

    reward: float
    cl: float
    lift_to_drag: float
    coefficients: tuple[float, ...]

    @classmethod
    def of(cls, reward: float, info: dict[str, Any]) -> Candidate | None:
        """The stroke of a step by its info; None when it was not simulated."""
        if info.get("failure") or not np.isfinite(info.get("cl", np.nan)):
            return None
        coefficients = tuple(float(x) for x in info["coefficients"])
        return cls(reward, float(info["cl"]), float(info["lift_to_drag"]), coefficients)

    def row(self, prefix: str) -> dict[str, float]:
        """The numbers for a row of metrics."""
        names = ("reward", "cl", "lift_to_drag")
        return {f"{prefix}_{name}": getattr(self, name) for name in names}
