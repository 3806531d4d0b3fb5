"""Where the kept wake ends: its last vortex must not leap beside the wing at every step."""

from functools import cache

import numpy as np
import pytest

from flaprig.aero.models import UVLM
from flaprig.aero.simulate import simulate
from flaprig.strokes import SunTangStroke
from flaprig.wing import RIG_WING

# the paper's fastest flip: while the wing turns, the oldest rows drift beside it
FAST_FLIP = SunTangStroke(0.2, np.pi / 3, np.pi / 4, 0.5, 0.16)
STEPS = 120


@cache
def pitch_torque(fade):
    """Cycles 2 and 3 [N m]: the wake is full."""
    model = UVLM(chordwise=4, spanwise=6, steps_per_cycle=STEPS, wake_fade=fade)
    return simulate(RIG_WING, FAST_FLIP, model, cycles=3).pitch_torque[STEPS:]


def test_an_end_at_full_strength_shakes_the_pitch_torque():
    # a third difference lets the motion through only where its acceleration jumps
    noise = {fade: np.std(np.diff(pitch_torque(fade), 3)) for fade in (0.0, 0.1)}
    assert noise[0.0] > 5 * noise[0.1]


def test_the_peak_is_no_outlier_when_the_end_fades():
    largest, percentile = (
        f(np.abs(pitch_torque(0.1))) for f in (np.max, lambda t: np.percentile(t, 99))
    )
    assert largest < 1.06 * percentile
    abrupt = np.abs(pitch_torque(0.0))
    assert abrupt.max() > 1.25 * np.percentile(abrupt, 99)
    assert largest == pytest.approx(0.0078, rel=0.05)


def test_nothing_fades_before_the_last_rows():
    model = UVLM(chordwise=3, spanwise=4, steps_per_cycle=40)
    faded, whole = (
        simulate(RIG_WING, FAST_FLIP, UVLM(3, 4, 40, wake_fade=f), cycles=1).lift
        for f in (model.wake_fade, 0.0)
    )
    # 36 of 40 rows are shed by then
    np.testing.assert_array_equal(faded[:36], whole[:36])
    assert np.any(faded[38:] != whole[38:])
