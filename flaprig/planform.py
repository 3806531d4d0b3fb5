"""Planforms that are straight lines between stations: exact integrals, and the beta planform.

Beta planform: C. P. Ellington, The aerodynamics of hovering insect flight II. Morphological
parameters, Phil. Trans. R. Soc. Lond. B 305 (1984) 17-40.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from flaprig import _checks as check

Array = NDArray[np.float64]

# stations of a beta planform, cosine spaced so that both ends are fine
BETA_STATIONS = 101
# beta exponents p and q accepted: below 1 the chord at an end is infinite, above 6 the planform
# is a spike of no animal, with ends too thin for the stations
LEAST_BETA_EXPONENT, MOST_BETA_EXPONENT = 1.0, 6.0
# radii of the first moment of area for which both exponents can lie in that range
LEAST_R1, MOST_R1 = 1.0 / 7.0, 6.0 / 7.0


def moment(y: ArrayLike, chord: ArrayLike, edge: ArrayLike, x_power: int, y_power: int) -> float:
    """Integral of x^x_power y^y_power over the area, exact up to a total power of two.

    Args:
        y: stations along the span in [m]. Shape (k,).
        chord: chords there in [m]. Shape (k,).
        edge: x of the leading edge there in [m]. Shape (k,).
        x_power: 0, 1 or 2.
        y_power: 0, 1 or 2.
    """
    front, width, along = (_ends_and_middle(values) for values in (edge, chord, y))
    n = x_power + 1
    across = ((front + width) ** n - front**n) / n if x_power else width
    return _simpson(y, across * along**y_power)


def integral(y: ArrayLike, values: ArrayLike, power: int = 0) -> float:
    """Integral over y of y^power times piecewise linear values, exact for power up to 2."""
    return _simpson(y, _ends_and_middle(values) * _ends_and_middle(y) ** power)


def beta(r1: float, r2: float) -> tuple[Array, Array]:
    """Ellington's beta planform as x = 0 (root) to 1 (tip) and chord over mean chord there.

    c = x^(p-1) (1-x)^(q-1) / B(p, q), p = r1 k, q = (1 - r1) k, k = r1 (1-r1) / (r2^2-r1^2) - 1.
    The straight lines between the stations have area 1 and the radii r1 and r2 to rounding.
    Shapes (101,).
    """
    x = 0.5 * (1.0 - np.cos(np.pi * np.linspace(0.0, 1.0, BETA_STATIONS)))
    k = r1 * (1.0 - r1) / (r2**2 - r1**2) - 1.0
    # rounding must not turn an exponent of zero into a pole
    p, q = max(r1 * k, 1.0), max((1.0 - r1) * k, 1.0)
    chord = x ** (p - 1.0) * (1.0 - x) ** (q - 1.0) / _beta_function(p, q)
    # straight lines lose about 1e-4 of the area: a quadratic factor near 1 restores the moments
    basis = chord * np.array([np.ones_like(x), x, x**2])
    matrix = [[integral(x, column, power) for column in basis] for power in range(3)]
    return x, np.linalg.solve(matrix, [1.0, r1, r2**2]) @ basis


def checked_radii(owner: str, r1: float, r2: float | None) -> tuple[float, float]:
    """The radii of area in spans, r2 by Ellington's (1984) correlation when it is None.

    Raises:
        ValueError: no beta planform of finite chord has these radii.
    """
    r1 = check.in_range(owner, "r1", r1, LEAST_R1, MOST_R1, "spans")
    name = "r2"
    if r2 is None:
        # Ellington (1984): correlation over the wings of insects, birds and bats
        name, r2 = "r2 (by Ellington's correlation 0.929 r1^0.732)", 0.929 * r1**0.732
    slim, full = MOST_BETA_EXPONENT / max(r1, 1.0 - r1), LEAST_BETA_EXPONENT / min(r1, 1.0 - r1)
    least, most = (np.sqrt(r1**2 + r1 * (1.0 - r1) / (k + 1.0)) for k in (slim, full))
    unit = f"spans for r1 = {r1:.6g} (finite chord, no spike)"
    return r1, check.in_range(owner, name, r2, least * (1 - 1e-9), most * (1 + 1e-9), unit)


def _ends_and_middle(values: ArrayLike) -> Array:
    v = np.asarray(values)
    return np.array([v[:-1], 0.5 * (v[:-1] + v[1:]), v[1:]])


def _simpson(y: ArrayLike, values: Array) -> float:
    # exact for cubics on every piece
    return float(np.diff(np.asarray(y)) @ (np.array([1.0, 4.0, 1.0]) @ values) / 6.0)


def _beta_function(p: float, q: float) -> float:
    """Euler's B(p, q), without the half second that importing scipy takes."""
    return math.exp(math.lgamma(p) + math.lgamma(q) - math.lgamma(p + q))
