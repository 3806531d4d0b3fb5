"""Translational lift and drag coefficients of the quasi-steady model.

The formulas themselves live in the native code (flaprig/native/coefficients.cpp); here a set is
only named, or given as a table.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from flaprig import _checks as check

# largest size of a coefficient; far beyond any wing
MOST_COEFFICIENT = 100.0


@dataclass(frozen=True)
class Coefficients:
    """Lift and drag against the angle of attack.

    Attributes:
        name: the set's name in the plugin's attribute `coefficients`.
        table: rows (alpha [rad], C_L, C_D), linear in between; empty for a named formula.
    """

    name: str
    table: tuple[tuple[float, float, float], ...] = ()

    @classmethod
    def from_table(cls, alpha: ArrayLike, lift: ArrayLike, drag: ArrayLike) -> Self:
        """Coefficients from a user's own table.

        Args:
            alpha: angle of attack in [rad], increasing within 0 to pi. Shape (k,), k >= 2.
            lift: lift coefficient. Shape (k,).
            drag: drag coefficient. Shape (k,).

        Raises:
            ValueError: lengths that differ, angles out of order or range, numbers not finite.
        """
        owner = "Coefficients.from_table"
        a = check.array(owner, "alpha", alpha, "rad", 2, 1000)
        cl = check.array(owner, "lift", lift, length=a.size, most=MOST_COEFFICIENT)
        cd = check.array(owner, "drag", drag, length=a.size, most=MOST_COEFFICIENT)
        if a[0] < 0 or a[-1] > np.pi or np.any(np.diff(a) <= 0):
            raise check.fail(owner, "alpha", "increasing within 0 to pi rad", list(a))
        rows = zip(a.tolist(), cl.tolist(), cd.tolist(), strict=True)
        return cls("table", tuple(rows))


# Dickinson, Lehmann & Sane 1999, Science 284: a robot fruit-fly wing, Re of order 100
DICKINSON_1999 = Coefficients("dickinson1999")
# Lee, Lua, Lim & Yeo 2016, Bioinspir. Biomim. 11: rectangular wings, Re 10 to 1e5
LEE_2016 = Coefficients("lee2016")


def _fitted_to_a_tank() -> Coefficients:
    alpha = np.linspace(0.0, np.pi, 181)
    return Coefficients.from_table(
        alpha, 1.54 * np.sin(2.0 * alpha), 0.05 + 1.34 * (1.0 - np.cos(2.0 * alpha))
    )


# C_L = 1.54 sin 2a, C_D = 0.05 + 1.34 (1 - cos 2a): two numbers fitted to the mean forces of 26
# strokes measured in water, beta planforms of aspect ratio 3 to 5, Re 3000 to 5000, pitch near 45
# degrees (docs/validation.md). Outside of that it is a guess: on the paper's rectangle at Re 8700
# its lift is 6 % low and its L/D 15 % high
HOVER_TANK = _fitted_to_a_tank()
