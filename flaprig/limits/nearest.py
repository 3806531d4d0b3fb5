"""The periodic spline nearest to given angles, under bounds on its derivatives: a convex problem.

Unknown are the coefficients of a periodic quintic spline. A derivative of it is a spline of lower
degree whose coefficients are differences of these, and a spline lies between its lowest and highest
coefficient everywhere: so bounds on differences hold on the whole cycle, not only at samples, and
where a bound is met along an arc it is met exactly (C. de Boor, A Practical Guide to Splines,
Springer 1978, chapter XI).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq
from scipy.sparse import csr_array, eye_array

from flaprig.limits import spline
from flaprig.limits.programme import Rows, least_squares

Array = NDArray[np.float64]

# Bohr-Favard: a periodic motion of half amplitude A needs at least this times A of a derivative
# with phase, by its order (J. Favard, C. R. Acad. Sci. Paris 203 (1936) 1122): Euler splines
FAVARD = {1: 4.0, 2: 32.0, 3: 192.0}
# orders of the derivatives that are bounded: position, velocity, acceleration, jerk
ORDERS = range(4)
# points of the least squares in one interval of the spline
POINTS = 4
# a solution that exceeds its bounds by less is drawn back inside, by more is refused; relative
ACCEPTED = 1e-5
# coefficients that exceed a bound by less are taken as inside, relative
ALMOST = 1e-6
# a motion that meets a bound is kept inside it by this share
SAFETY = 1e-9
# and by the rounding of samples in its derivatives: eps times the largest angle times n^order
# times the sum of a difference's weights, 8 for the jerk, over the least eigenvalue of
# interpolation, 2/15; times 8 for the solution of the interpolation (measured: up to 3)
ROUNDING = 8.0 * 60.0 * float(np.finfo(np.float64).eps)
# how far outside the kept extremes an angle may be, over the amplitude
ABOVE = 1e-9
# largest number of programmes for one spline
ROUNDS = 20
# smallest half range of the angles that counts as a motion [rad]
LEAST_SIZE = 1e-9


@dataclass(frozen=True)
class Amplitude:
    """A peak-to-peak angle that the spline is to have.

    Attributes:
        highest: phase of the highest angle.
        lowest: phase of the lowest angle.
        span: highest minus lowest angle in [rad].
    """

    highest: float
    lowest: float
    span: float


def nearest(target: Array, ranges: Array, keep: Amplitude | None = None) -> Array | None:
    """Coefficients of the nearest spline; None when no spline has the amplitude to keep.

    Args:
        target: angles at the phases 0, 1/k, 2/k, ... with k = 4 n, in [rad]. Shape (4 n,).
        ranges: lowest and highest value of each derivative with phase, infinite where free.
            Shape (4, 2).
        keep: amplitude that the spline must have.

    Raises:
        RuntimeError: the solver gave up.
    """
    # angles about their middle, over the size that is possible: solvers like numbers near one
    middle = 0.5 * (target.max() + target.min())
    possible = min(ranges[k, 1] / constant for k, constant in FAVARD.items())
    size = max(min(0.5 * float(np.ptp(target)), possible), LEAST_SIZE)
    bounds = (ranges - middle * np.eye(4)[:, :1]) / size
    if keep is not None:
        keep = Amplitude(keep.highest, keep.lowest, keep.span / size)
    found = _scaled((target - middle) / size, bounds, keep)
    if found is None:
        return None
    largest = float(np.abs(target).max()) / size
    return np.asarray(middle + size * _inside(found, bounds, largest))


def excess(coefficients: Array, ranges: Array) -> float:
    """By what share of half a range the spline leaves it at worst; negative when inside all."""
    found = [np.array(spline.extremes(coefficients, k)) for k in ORDERS]
    return max(_excess(*pair) for pair in zip(found, ranges, strict=True))


def _scaled(target: Array, ranges: Array, keep: Amplitude | None) -> Array | None:
    """`nearest` for angles of size one."""
    start = spline.interpolate(target[::POINTS])
    if keep is None and excess(start, ranges) <= 0.0:
        return start
    values = spline.matrix(np.arange(target.size) / target.size, start.size)
    equal = [] if keep is None else _kept_rows(start.size, keep)
    # bounds and cuts are taken up when a solution breaks them: most never are
    found, bounds = start, dict[int, list[Rows]]()
    cuts: list[Rows] = []
    for turn in range(ROUNDS):
        broken = [k for k in ORDERS if k not in bounds and _hull_excess(found, k, ranges) > ALMOST]
        bounds |= {k: _bound_rows(start.size, k, ranges[k]) for k in broken}
        higher = [] if keep is None else _cuts(found, keep)
        if turn > 0 and not broken and not higher:
            break
        cuts += higher
        at_most = [row for k in sorted(bounds) for row in bounds[k]] + cuts
        solved = least_squares(values, target, at_most, equal)
        if solved is None:
            return None
        found = solved
    if excess(found, ranges) > ACCEPTED:
        raise RuntimeError("nearest: the solver's answer leaves the bounds")
    return found if keep else _touching(found, start, ranges)


def _excess(values: Array, bounds: Array) -> float:
    """By what share of half the range values leave it at worst."""
    low, high = bounds
    if not np.isfinite(high - low):
        return -1.0
    return float(np.abs(2.0 * values - (low + high)).max() / (high - low)) - 1.0


def _hull_excess(coefficients: Array, order: int, ranges: Array) -> float:
    return _excess(differences(coefficients.size, order) @ coefficients, ranges[order])


def _bound_rows(n: int, order: int, bounds: Array) -> list[Rows]:
    """Coefficients of a derivative inside a range, which is scaled to -1 to 1."""
    half, middle = 0.5 * (bounds[1] - bounds[0]), 0.5 * (bounds[1] + bounds[0])
    scaled, shift = csr_array(differences(n, order) / half), middle / half
    return [(scaled, np.full(n, 1.0 + shift)), (-scaled, np.full(n, 1.0 - shift))]


def _kept_rows(n: int, keep: Amplitude) -> list[Rows]:
    """The amplitude at its two instants, and no rate there."""
    ends = np.array([keep.highest, keep.lowest])
    height, rate = spline.matrix(ends, n), spline.matrix(ends, n, 1)
    difference = csr_array(height[[0]] - height[[1]])
    return [(difference, np.array([keep.span])), (csr_array(rate / n), np.zeros(2))]


def _cuts(found: Array, keep: Amplitude) -> list[Rows]:
    """Rows against angles beyond the two that are to be the extremes."""
    phases = spline.turning_points(found)
    angle = spline.values(found, phases)
    rows = []
    for sign, phase in ((1.0, keep.highest), (-1.0, keep.lowest)):
        own = spline.values(found, np.array([phase]))
        beyond = phases[sign * (angle - own) > ABOVE * keep.span]
        if beyond.size:
            same = spline.matrix(np.full(beyond.size, phase), found.size)
            difference = spline.matrix(beyond, found.size) - same
            rows.append((csr_array(sign * difference), np.zeros(beyond.size)))
    return rows


def _touching(found: Array, start: Array, ranges: Array) -> Array:
    """Moved towards the start until a bound is met: differences bound a short peak too strictly."""
    if excess(found, ranges) > -SAFETY:
        return found
    share = brentq(lambda s: excess(found + s * (start - found), ranges), 0.0, 1.0, xtol=1e-12)
    return np.asarray(found + share * (start - found))


def _inside(found: Array, ranges: Array, largest: float) -> Array:
    """Shrunk about a resting angle until every bound is kept, with room for rounding."""
    rest = float(np.clip(found.mean(), *ranges[0]))
    share = 1.0
    for k in ORDERS:
        centre = rest if k == 0 else 0.0
        for value, bound in zip(spline.extremes(found, k), ranges[k], strict=True):
            reach, room = abs(value - centre), ROUNDING * largest * found.size**k * (k > 0)
            allowed = max(abs(bound - centre) * (1.0 - SAFETY) - room, 0.0)
            if reach > allowed:
                share = min(share, allowed / reach)
    return np.asarray(rest + share * (found - rest))


def differences(n: int, order: int) -> csr_array:
    """Matrix of the coefficients of a derivative with phase. Shape (n, n)."""
    index = np.arange(n)
    back = csr_array((np.ones(n), (index, np.mod(index - 1, n))), shape=(n, n))
    one = n * (eye_array(n, format="csr") - back)
    found = csr_array(eye_array(n, format="csr"))
    for _ in range(order):
        found = csr_array(one @ found)
    return found
