"""What the wake's dial costs: loads beside those of brute force, over kinematics and cycles."""

from dataclasses import replace

import numpy as np
import pytest

from flaprig.aero.batch import simulate_batch
from flaprig.aero.models import UVLM
from flaprig.benchmark.dial import drawn
from flaprig.strokes import SunTangStroke
from flaprig.wing import RIG_WING

SINUSOID = SunTangStroke(0.2, np.pi / 3, np.pi / 4)
FAST_FLIP = SunTangStroke(0.2, np.pi / 3, np.pi / 4, 0.5, 0.16)
# standard deviations among neighbours within which means of a chaotic wake count as the same; the
# largest difference here is 1.0 with AVX vectors and 1.5 with 128 bits
SPREADS = 2.0


def means(strokes, cycles, **settings):
    """Lift, drag, absolute sweep torque, by stroke and cycle. Shape (strokes, 3, cycles)."""
    model = UVLM(**settings)
    found = simulate_batch(RIG_WING, strokes, model, cycles=cycles)
    each = [(r.lift, r.drag, np.abs(r.sweep_torque)) for r in found]
    return np.array(each).reshape(len(strokes), 3, cycles, -1).mean(axis=-1)


def test_first_cycle_is_within_three_thousandths():
    strokes = [SINUSOID, FAST_FLIP, *drawn(14)]
    change = means(strokes, 1) / means(strokes, 1, wake_detail=0) - 1
    assert np.abs(change).max() < 3e-3
    assert np.sqrt(np.mean(change**2)) < 8e-4


@pytest.mark.parametrize("stroke", [SINUSOID, FAST_FLIP], ids=["sinusoid", "fast flip"])
def test_later_cycles_are_within_the_spread_of_neighbours(stroke):
    # a thousandth of pitch amplitude apart: by the second cycle a free wake has made noise of it
    near = 1 + 1e-3 * np.linspace(-0.5, 0.5, 12)
    strokes = [replace(stroke, pitch_amplitude=n * stroke.pitch_amplitude) for n in near]
    ours, exact = means(strokes, 3), means(strokes, 3, wake_detail=0)
    spread = exact.std(axis=0, ddof=1)
    assert np.all(np.abs(ours.mean(axis=0) - exact.mean(axis=0))[:, 1:] < SPREADS * spread[:, 1:])


def test_whole_wake_stays_whole():
    # the sum of what old rows do is kept while they become fewer: three cycles of wake, none fades
    near = 1 + 1e-3 * np.linspace(-0.5, 0.5, 8)
    strokes = [replace(SINUSOID, pitch_amplitude=n * SINUSOID.pitch_amplitude) for n in near]
    whole = {"chordwise": 4, "spanwise": 8, "wake_cycles": 3.0, "wake_fade": 0.0}
    ours, exact = means(strokes, 3, **whole), means(strokes, 3, wake_detail=0, **whole)
    spread = exact.std(axis=0, ddof=1)
    assert np.all(np.abs(ours.mean(axis=0) - exact.mean(axis=0))[:, 2] < SPREADS * spread[:, 2])


def test_single_precision_is_near_double_first_and_then_the_spread():
    near = 1 + 1e-3 * np.linspace(-0.5, 0.5, 12)
    strokes = [replace(SINUSOID, pitch_amplitude=n * SINUSOID.pitch_amplitude) for n in near]
    plain = {"chordwise": 4, "spanwise": 8, "wake_detail": 0}
    ours, exact = means(strokes, 3, **plain), means(strokes, 3, precision="double", **plain)
    assert np.abs(ours / exact - 1)[..., 0].max() < 2e-5
    assert np.any(ours != exact)
    spread = exact.std(axis=0, ddof=1)
    assert np.all(np.abs(ours.mean(axis=0) - exact.mean(axis=0))[:, 1:] < SPREADS * spread[:, 1:])
