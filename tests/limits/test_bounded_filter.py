"""The filter ends whatever the joints' range is, and looser limits never make it later."""

from __future__ import annotations

import math

import numpy as np
import pytest

from flaprig.limits import JointLimits, Limits, Mode, RuckigFilter, filtered
from flaprig.limits import trajectory as trajectory_module
from flaprig.limits.intercept import STRIDES, earliest
from flaprig.limits.reference import Reference, State
from flaprig.limits.ruckig_motion import REACHES, Planner, _extremes
from flaprig.strokes import FourierStroke, SunTangStroke
from tests.limits.random_filters import (
    any_limits,
    any_stroke,
    assert_kept,
    interval_of,
    joined,
    tight_and_loose,
)


def about(middle: float, sweep: float = 1.0, pitch: float = 0.7) -> FourierStroke:
    """A stroke at 0.2 Hz whose sweep is about another angle than zero."""
    return FourierStroke(0.2, (-sweep,), (0.0,), (0.0,), (pitch,), sweep_mean=middle)


@pytest.mark.parametrize(
    "position", [(0.5 * math.pi, 1.5 * math.pi), (-3.0, -0.7), (0.05, 6.0), (-6.1, -4.0)]
)
def test_ends_where_the_range_excludes_zero(position: tuple[float, float]) -> None:
    """A servo's own frame, for instance: 90 to 270 degrees about its middle."""
    stroke = about(0.5 * sum(position))
    limits = Limits(JointLimits(position, 4.0, 10.0, 300.0), JointLimits((-1.6, 1.6), 4, 10, 300))
    found = filtered(stroke, limits, 1, 0.02)
    assert found.stroke is stroke
    assert_kept(found, limits)
    assert found.motion.time[-1] < 8.0


@pytest.mark.parametrize("seed", range(25))
def test_random_ranges_limits_and_strokes_all_end(seed: int) -> None:
    rng = np.random.default_rng([seed, 77])
    stroke = any_stroke(rng)
    limits, interval = any_limits(rng, stroke), interval_of(rng, stroke)
    assert_kept(filtered(stroke, limits, 1, interval), limits)


@pytest.mark.parametrize("seed", range(40))
def test_looser_limits_never_join_later(seed: int) -> None:
    rng = np.random.default_rng([seed, 78])
    stroke = any_stroke(rng)
    interval, start = interval_of(rng, stroke), rng.uniform(0.0, 5.0)
    tight, loose, posture = tight_and_loose(rng, stroke)
    assert joined(stroke, loose, interval, posture, start) <= joined(
        stroke, tight, interval, posture, start
    )


def test_bounds_switched_off_one_after_another(sine: SunTangStroke) -> None:
    """A jerk or an acceleration of 1e9 is a user's word for no bound at all."""
    found = []
    for acceleration, jerk in ((10, 300), (10, 1e4), (1e4, 1e6), (1e5, 1e8), (1e9, 1e9)):
        joint = JointLimits((-1.6, 1.6), 4.0, acceleration, jerk)
        control = RuckigFilter(Limits(joint, joint), 0.002, (-0.3, 0.2))
        found.append(control.follow(sine))
    assert found == sorted(found, reverse=True)
    assert found[0] < 0.6 and found[-1] < 0.2


def test_extremes_are_those_of_the_motion() -> None:
    """Against samples, at rest and on the way; Ruckig's own include an angle that none visits."""
    rng = np.random.default_rng(9)
    joint = JointLimits((-12.0, 12.0), 3.0, 8.0, 60.0)
    planner, wrong = Planner(Limits(joint, joint), 0.01), 0
    for _ in range(30):
        speed, push = rng.uniform(-2.5, 2.5, 2), rng.uniform(-6.0, 6.0, 2)
        begin = State(*map(tuple, (rng.uniform(-5.0, 5.0, 2), speed, push)))  # type: ignore[arg-type]
        brake = planner._calculate(planner._brake, begin)
        way = planner.at_least(begin, State.at_rest((1.0, -2.0)), 4.0)
        assert brake is not None and way is not None
        for motion in (brake, way):
            times = np.linspace(0.0, motion.duration, 1001)
            sampled = np.array([motion.at_time(time)[0] for time in times])
            for k in (0, 1):
                angles = [*_extremes(motion.profiles[0][k]), sampled[-1, k]]
                assert min(angles) == pytest.approx(sampled[:, k].min(), abs=1e-4)
                assert max(angles) == pytest.approx(sampled[:, k].max(), abs=1e-4)
                reported = motion.position_extrema[k]
                wrong += abs(reported.min - sampled[:, k].min()) > 0.1
    assert wrong > 5


def test_no_room_for_a_brake_is_one_sentence_and_the_stroke_goes_on(
    sine: SunTangStroke, rig: Limits, monkeypatch: pytest.MonkeyPatch
) -> None:
    control = RuckigFilter(rig, 0.01)
    control.follow(sine)
    while control.mode is not Mode.FOLLOWING:
        control.step()
    monkeypatch.setattr(Planner, "brake", lambda *_: None)
    for _ in range(3):
        with pytest.raises(RuntimeError, match="nowhere in a whole cycle can both joints"):
            control.stop()
        before = control.state
        assert control.step() != before and control.mode is Mode.FOLLOWING


def test_search_is_bounded_and_finds_what_comes_late() -> None:
    """Some thousand trials for five million ticks, and the earliest tick among nested windows."""
    reference = Reference(about(0.0), 0.0, 0.01)
    trials = []

    def meets(state: State, length: int) -> bool:
        trials.append(length)
        return length >= 1_234_567

    assert earliest(reference, 0, 5e6, meets) == 1_234_567
    assert len(trials) < 12_000
    assert earliest(reference, 0, 5e6, lambda state, length: False) is None
    # some ticks at the end of a stride
    stride = int(5.0 / 0.01 / STRIDES)
    window = range(200 * stride - 1, 200 * stride + 2)
    assert earliest(reference, 0, 1e3, lambda state, length: length in window) == window[0]


def test_caps_are_those_of_the_states_and_never_wider_than_the_limits() -> None:
    joint = JointLimits((-2.0, 2.0), 1e9, 5.0, 1e9)
    planner = Planner(Limits(joint, joint), 0.01)
    begin, end = State.at_rest((0.0, 0.0)), State((1.0, 0.0), (0.5, 0.0), (0.0, 0.0))
    speed, push, jerk = planner._capped(begin, end, 2.0, REACHES[0], 0)
    assert (speed, push, jerk) == pytest.approx((1000.0, 5.0, 250.0), rel=1e-8)
    # a joint that needs nothing keeps its limits
    assert planner._capped(begin, end, 2.0, REACHES[0], 1)[1] == pytest.approx(5.0)


def test_too_many_set_points_are_one_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    """A way that takes ages is found, and refused before its set points are made."""
    monkeypatch.setattr(trajectory_module, "MOST_TICKS", 3000)
    joint = JointLimits((-9.0, 9.0), 0.02, 0.05, 5.0)
    stroke, limits = SunTangStroke(0.2, 0.01, 0.01), Limits(joint, joint)
    with pytest.raises(RuntimeError, match=r"^filtered: the stroke is joined after 44\d"):
        filtered(stroke, limits, 1, 0.01, posture=(8.9, 0.0))
