"""Where the kept wake ends: its last vortex must not leap beside the wing at every step."""

from dataclasses import replace
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


# the roll-up is chaotic: what is said of one stroke must hold for its neighbours
NEIGHBOURS = 1 + 1e-7 * np.arange(7)


@cache
def pitch_torque(fade, frequency=1.0):
    """Cycles 2 and 3 [N m]: the wake is full."""
    model = UVLM(chordwise=4, spanwise=6, steps_per_cycle=STEPS, wake_fade=fade)
    stroke = replace(FAST_FLIP, frequency=frequency * FAST_FLIP.frequency)
    return simulate(RIG_WING, stroke, model, cycles=3).pitch_torque[STEPS:]


def peaks(fade):
    """Largest pitch torques [N m] of neighbouring strokes, and over the 99th percentile."""
    torques = [np.abs(pitch_torque(fade, near)) for near in NEIGHBOURS]
    return np.array([(t.max(), t.max() / np.percentile(t, 99)) for t in torques]).T


def test_an_end_at_full_strength_shakes_the_pitch_torque():
    # a third difference lets the motion through only where its acceleration jumps
    noise = {fade: np.std(np.diff(pitch_torque(fade), 3)) for fade in (0.0, 0.1)}
    assert noise[0.0] > 5 * noise[0.1]


def test_the_peak_is_no_outlier_when_the_end_fades():
    largest, ratio = np.median(peaks(0.1), axis=1)
    assert ratio < 1.06
    assert np.median(peaks(0.0)[1]) > 1.25
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
