"""Random strokes and limits against the promises of the filter, a few in the suite.

`python -m tests.limits.random_filters 2000` tries as many as one likes and prints what failed.
"""

from __future__ import annotations

import sys
from collections import Counter

import numpy as np

from flaprig.limits import JointLimits, Limits, RuckigFilter, Trajectory, filtered, peaks
from flaprig.limits.limits import JOINTS
from flaprig.strokes import FourierStroke, Stroke

# factors that loosen a bound
FACTORS = (1.0, 1.001, 1.05, 1.3, 2.0, 10.0, 1e3, 1e6, 1e9)
# the largest bound that JointLimits takes
MOST = 1e9


def any_stroke(rng: np.random.Generator) -> FourierStroke:
    """Up to four harmonics, 0.03 to 20 Hz, half of the angles up to 4 rad off the zero."""
    count = int(rng.integers(1, 5))
    size = np.array([1.0, 0.5, 0.2, 0.1])[:count]
    terms = [rng.normal(size=count) * size for _ in range(4)]
    amplitudes = rng.uniform(0.05, 1.2, 2)
    stroke = FourierStroke.normalized(10.0 ** rng.uniform(-1.5, 1.3), *terms, *amplitudes)
    off = rng.uniform(-4.0, 4.0, 2) * rng.integers(0, 2, 2)
    return FourierStroke(
        frequency=stroke.frequency,
        sweep_cos=stroke.sweep_cos,
        sweep_sin=stroke.sweep_sin,
        pitch_cos=stroke.pitch_cos,
        pitch_sin=stroke.pitch_sin,
        sweep_mean=stroke.sweep_mean + off[0],
        pitch_mean=stroke.pitch_mean + off[1],
    )


def interval_of(rng: np.random.Generator, stroke: Stroke) -> float:
    """Some 50 to 300 set points a cycle."""
    return float(np.clip(rng.uniform(0.003, 0.02) / stroke.frequency, 1e-4, 0.1))


def any_limits(rng: np.random.Generator, stroke: Stroke) -> Limits:
    """A tenth to 1e8 times what the stroke needs; ranges about it, inside it and elsewhere."""
    joints = {}
    for joint, need in peaks(stroke).items():
        low, high = need.position
        middle, width = 0.5 * (low + high), high - low
        ranges = (
            (low - rng.exponential(0.3), high + rng.exponential(0.3)),
            (low - rng.choice([1e-9, 1e-6, 0.01]), high + rng.choice([1e-9, 1e-6, 0.01])),
            (middle - rng.uniform(0.1, 0.5) * width, middle + rng.uniform(0.1, 0.5) * width),
            rng.uniform(-6.0, 6.0) + np.array([0.0, 10.0 ** rng.uniform(-5.0, 0.7)]),
        )
        shares = 10.0 ** rng.uniform(-1.0, 2.0, 3) * rng.choice([1.0, 1.0, 1e6], 3)
        needs = np.array([need.velocity, need.acceleration, need.jerk])
        position = tuple(float(angle) for angle in ranges[rng.integers(4)])
        joints[joint] = JointLimits(position, *np.clip(shares * needs, 1e-9, MOST).tolist())
    return Limits(**joints)


def assert_kept(found: Trajectory, limits: Limits) -> None:
    """Every bound holds at every set point, and angles, rates and accelerations belong together."""
    h, motion = found.interval, found.motion
    for joint in JOINTS:
        allowed = getattr(limits, joint)
        angle, rate, acceleration = (
            getattr(motion, joint + ending) for ending in ("", "_rate", "_acceleration")
        )
        assert angle.min() >= allowed.position[0] - 1e-9, joint
        assert angle.max() <= allowed.position[1] + 1e-9, joint
        assert np.abs(rate).max() <= allowed.velocity * (1.0 + 1e-9), joint
        assert np.abs(acceleration).max() <= allowed.acceleration * (1.0 + 1e-9), joint
        rounding = 1e-15 / h**2 + 1e-14 * allowed.acceleration
        change = np.abs(np.diff(acceleration)).max()
        assert change <= allowed.jerk * h * (1.0 + 1e-9) + rounding, joint
        # the trapezoidal rule, whose error the acceleration bounds
        gap = np.diff(angle) - 0.5 * h * (rate[1:] + rate[:-1])
        assert np.abs(gap).max() <= 0.5 * allowed.acceleration * h**2 + 1e-11, joint


def tight_and_loose(rng: np.random.Generator, stroke: Stroke) -> tuple[Limits, Limits, list[float]]:
    """Limits that the stroke keeps, looser ones, and a posture inside the tight ones' range."""
    tight, loose, posture = {}, {}, []
    for joint, need in peaks(stroke).items():
        low, high = np.array(need.position) + rng.choice([1e-6, 1e-3, 0.05, 0.5], 2) * [-1.0, 1.0]
        shares = 1.0 + 1e-9 + rng.exponential(0.7, 3) * rng.integers(0, 2, 3)
        bounds = shares * [need.velocity, need.acceleration, need.jerk]
        factors = rng.choice(FACTORS, 3) if rng.integers(4) else rng.choice(FACTORS)
        wider = rng.choice([0.0, 0.0, 0.01, 1.0], 2) * [-1.0, 1.0]
        tight[joint] = JointLimits((low, high), *bounds.tolist())
        more = np.minimum(factors * bounds, MOST).tolist()
        loose[joint] = JointLimits((low + wider[0], high + wider[1]), *more)
        posture.append(float(rng.choice([low, high, rng.uniform(low, high)])))
    return Limits(**tight), Limits(**loose), posture


def joined(
    stroke: Stroke, limits: Limits, interval: float, posture: list[float], start: float
) -> int:
    """Ticks until the stroke is joined."""
    control = RuckigFilter(limits, interval, (posture[0], posture[1]))
    return round(control.follow(stroke, start) / interval)


def main(count: int, seed: int = 0) -> None:
    """Print how many ended in which way, and every pair that looser limits join later."""
    ends: Counter[str] = Counter()
    for k in range(count):
        rng = np.random.default_rng([seed, k])
        stroke = any_stroke(rng)
        limits, interval = any_limits(rng, stroke), interval_of(rng, stroke)
        try:
            assert_kept(filtered(stroke, limits, 1, interval), limits)
            ends["a trajectory"] += 1
        except (RuntimeError, ValueError) as error:
            ends[str(error)] += 1
        tight, loose, posture = tight_and_loose(rng, stroke)
        start = rng.uniform(0.0, 5.0)
        first, second = (joined(stroke, one, interval, posture, start) for one in (tight, loose))
        if second > first:
            print(f"{k}: joined after {first} ticks, and after {second} with looser limits")
    for words, times in ends.most_common():
        print(times, words)


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
