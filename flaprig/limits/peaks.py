"""How much of its limits a stroke needs: extremes of its motion over the whole cycle.

Any stroke will do: extremes are searched between samples, and jerk comes from difference
quotients of the acceleration. Such a quotient is a mean of the jerk, so it never tells too much.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PPoly, make_interp_spline

from flaprig import _checks as check
from flaprig.limits.limits import JOINTS, Bound, Limits
from flaprig.strokes.sampled import SampledStroke
from flaprig.strokes.stroke import Motion, Stroke, check_stroke

Array = NDArray[np.float64]

# samples of a cycle from which the search begins, and of one interval of a sampled stroke
SAMPLES, SAMPLES_PER_INTERVAL = 4096, 8
# strokes whose peaks are remembered: one is projected, accepted and judged in a row
KEPT = 4
# candidates that are followed for each extreme
CANDIDATES = 24
# steps of the golden section: 2/4096 of a cycle shrinks to rounding
SECTIONS = 56
# halvings of the cell with the largest difference quotient, and how much the quotient grows in the
# last three of them where the acceleration jumps (eight times)
HALVINGS, JUMP = 9, 4.0
# a bound is broken when it is exceeded by this share of its size
TOLERANCE = 1e-9
# rounding of angles, as a share of them: in a narrow range far from 0 it is more than the other
ROUNDING = 2e-14

_GOLDEN = 0.5 * (np.sqrt(5.0) - 1.0)


@dataclass(frozen=True)
class JointPeaks:
    """Extremes of one joint over a cycle.

    Attributes:
        position: lowest and highest angle in [rad].
        velocity: largest size of the rate in [rad/s].
        acceleration: largest size in [rad/s2].
        jerk: largest size in [rad/s3]; infinite where the acceleration jumps.
    """

    position: tuple[float, float]
    velocity: float
    acceleration: float
    jerk: float


@dataclass(frozen=True)
class Violation:
    """A bound that a stroke breaks.

    Attributes:
        joint: sweep or pitch.
        bound: which bound.
        value: what the stroke needs, in the bound's unit.
        limit: what is allowed.
    """

    joint: str
    bound: Bound
    value: float
    limit: float

    def __str__(self) -> str:
        unit = self.bound.unit
        return f"{self.joint} {self.bound} {self.value:.6g} {unit} against {self.limit:.6g} {unit}"


def peaks(stroke: Stroke) -> dict[str, JointPeaks]:
    """Extremes of both joints over the cycle, to 1e-9 of their size, by the joint's name.

    Raises:
        ValueError: not a stroke.
    """
    check_stroke("peaks", stroke)
    known: Any = stroke
    return dict(_remembered(known) if _is_a_value(stroke) else _peaks(stroke))


def _is_a_value(stroke: Stroke) -> bool:
    """Whether equal strokes stay equal: a user's own may change."""
    made = getattr(type(stroke), "__dataclass_params__", None)
    try:
        return made is not None and made.frozen and made.eq and hash(stroke) is not None
    except TypeError:
        return False


@lru_cache(maxsize=KEPT)
def _remembered(stroke: Stroke) -> dict[str, JointPeaks]:
    return _peaks(stroke)


def _peaks(stroke: Stroke) -> dict[str, JointPeaks]:
    count = SAMPLES
    if isinstance(stroke, SampledStroke):
        count = max(count, SAMPLES_PER_INTERVAL * len(stroke.time))
    motion = stroke.sample(count)
    high, low = _extremes(stroke, motion)
    jerk = _jerk_of_samples(stroke) if isinstance(stroke, SampledStroke) else _jerk(stroke, motion)
    size = np.maximum(high, low)
    return {
        joint: JointPeaks(
            position=(float(-low[i, 0]), float(high[i, 0])),
            velocity=float(size[i, 1]),
            acceleration=float(size[i, 2]),
            jerk=float(jerk[i]),
        )
        for i, joint in enumerate(JOINTS)
    }


def violations(
    stroke: Stroke, limits: Limits, tolerance: float = TOLERANCE
) -> tuple[Violation, ...]:
    """Bounds that the stroke breaks by more than a share of their size; empty when feasible.

    Raises:
        ValueError: not a stroke, or not Limits.
    """
    check_limits("violations", limits)
    found = peaks(stroke)
    broken = []
    for joint in JOINTS:
        allowed, need = getattr(limits, joint), found[joint]
        for bound in Bound:
            low, high = allowed.range_of(bound)
            least, most = need.position if bound is Bound.POSITION else (-0.0, getattr(need, bound))
            room = max(tolerance * 0.5 * (high - low), ROUNDING * max(abs(low), abs(high)))
            if most > high + room:
                broken.append(Violation(joint, bound, most, high))
            elif least < low - room:
                broken.append(Violation(joint, bound, least, low))
    return tuple(broken)


def check_limits(owner: str, limits: Limits) -> None:
    """Refuse what is not Limits.

    Raises:
        ValueError: one sentence.
    """
    if not isinstance(limits, Limits):
        raise check.fail(owner, "limits", "a Limits, for instance rig_limits(RIG_MOTORS)", limits)


def _table(motion: Motion) -> Array:
    """Angle, rate and acceleration of both joints. Shape (2, 3, ...)."""
    return np.stack(
        [
            np.stack([getattr(motion, joint + end) for end in ("", "_rate", "_acceleration")])
            for joint in JOINTS
        ]
    )


def _extremes(stroke: Stroke, motion: Motion) -> Array:
    """Largest value of plus and minus each quantity. Shape (2 signs, 2 joints, 3 orders)."""
    signs = np.array([1.0, -1.0])
    table = np.multiply.outer(signs, _table(motion))
    step = stroke.period / table.shape[-1]
    top = np.argpartition(table, -CANDIDATES, axis=-1)[..., -CANDIDATES:]
    low, high = (top - 1) * step, (top + 1) * step

    def at(time: Array) -> Array:
        values = _table(stroke.motion(time))
        return np.asarray(np.einsum("s,jksjkc->sjkc", signs, values))

    reach = _GOLDEN * (high - low)
    left, right = high - reach, low + reach
    before, after = at(left), at(right)
    for _ in range(SECTIONS):
        rising = before < after
        low, high = np.where(rising, left, low), np.where(rising, high, right)
        reach = _GOLDEN * (high - low)
        # one of the points inside stays
        new = np.where(rising, low + reach, high - reach)
        value = at(new)
        left, right = np.where(rising, right, new), np.where(rising, new, left)
        before, after = np.where(rising, after, value), np.where(rising, value, before)
    # beside a jump the better side is a sample
    return np.asarray(np.maximum(at(0.5 * (low + high)), at(top * step)).max(axis=-1))


def _jerk(stroke: Stroke, motion: Motion) -> Array:
    """Largest jerk of both joints from difference quotients. Shape (2,)."""
    table = _table(motion)[:, 2]
    step = stroke.period / table.shape[-1]
    quotient = np.abs(np.diff(table, append=table[:, :1], axis=-1)) / step
    low = np.argpartition(quotient, -CANDIDATES, axis=-1)[:, -CANDIDATES:] * step

    def at(time: Array) -> Array:
        return np.asarray(np.einsum("jkjc->kjc", _table(stroke.motion(time))[:, 2]))

    history = []
    for _ in range(HALVINGS):
        step *= 0.5
        # halves of the cell and of its neighbours: the largest jerk may lie on an edge
        ends = at(low + step * np.arange(-1, 4)[:, None, None])
        quotients = np.abs(np.diff(ends, axis=0)) / step
        low = low + (np.argmax(quotients, axis=0) - 1) * step
        history.append(quotients.max(axis=0))
    jumps = history[-1] > JUMP * history[-4]
    return np.asarray(np.where(jumps, np.inf, history[-1]).max(axis=-1))


def _jerk_of_samples(stroke: SampledStroke) -> Array:
    """Largest jerk of both joints, exactly: parabolas between the samples. Shape (2,)."""
    time = np.asarray(stroke.time)
    if not stroke.closed:
        time = np.append(time, time[0] + stroke.period)
    found = []
    for name in JOINTS:
        angle = np.asarray(getattr(stroke, name))[: time.size - 1]
        spline = make_interp_spline(time, np.append(angle, angle[0]), k=5, bc_type="periodic")
        jerk = PPoly.from_spline(spline.derivative(3))
        # knots before and after the cycle only carry the ends
        inside = (jerk.x[:-1] >= time[0]) & (jerk.x[:-1] < time[-1])
        square, slope, start = jerk.c[:, inside]
        length = np.diff(jerk.x)[inside]
        with np.errstate(divide="ignore", invalid="ignore"):
            turn = np.clip(np.nan_to_num(-0.5 * slope / square), 0.0, length)
        found.append(max(np.abs(start + u * (slope + u * square)).max() for u in (0.0, turn)))
    return np.array(found)
