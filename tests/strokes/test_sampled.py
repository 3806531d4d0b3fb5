import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from flaprig.strokes import FourierStroke, SampledStroke, Stroke, SunTangStroke

SMOOTH = FourierStroke(0.2, [-1.0, 0.1, 0.05], [0.1, 0.0, 0.02], [0.0, 0.1, 0.0], [0.8, 0.0, 0.1])


def sampled(stroke, count, closed=False, start=0.0):
    time = start + np.arange(count + closed) * stroke.period / count
    motion = stroke.motion(time)
    sweep, pitch = motion.sweep.copy(), motion.pitch.copy()
    if closed:
        sweep[-1], pitch[-1] = sweep[0], pitch[0]
    return SampledStroke(time, sweep, pitch)


@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("start", [0.0, -1.3, 1e6])
def test_smooth_stroke_is_recovered(closed, start):
    ours = sampled(SMOOTH, 100, closed, start)
    assert ours.closed is closed
    assert ours.frequency == pytest.approx(0.2, rel=1e-9)
    time = start + np.linspace(-3.0, 11.0, 777)
    a, b = ours.motion(time), SMOOTH.motion(time)
    for name, tolerance in (("sweep", 3e-8), ("pitch_rate", 3e-6), ("sweep_acceleration", 3e-4)):
        scale = np.abs(getattr(b, name)).max()
        assert np.abs(getattr(a, name) - getattr(b, name)).max() < tolerance * scale
    assert ours.sweep_amplitude == pytest.approx(SMOOTH.sweep_amplitude, rel=1e-7)
    assert ours.pitch_amplitude == pytest.approx(SMOOTH.pitch_amplitude, rel=1e-7)


def test_error_of_acceleration_falls_with_fourth_power_of_step():
    errors = []
    for count in (25, 50, 100):
        time = np.linspace(0.0, 5.0, 1000)
        ours = sampled(SMOOTH, count).motion(time).sweep_acceleration
        errors.append(np.abs(ours - SMOOTH.motion(time).sweep_acceleration).max())
    assert errors[0] / errors[1] > 12 and errors[1] / errors[2] > 12


@settings(max_examples=40)
@given(
    angles=st.lists(st.tuples(st.floats(-3, 3), st.floats(-3, 3)), min_size=8, max_size=40),
    period=st.floats(1e-3, 1e3),
)
def test_any_samples_are_met_and_periodic(angles, period, assert_consistent):
    sweep, pitch = np.array(angles).T
    # a step apart at the ends, so that the sampling is open
    sweep[-1] = sweep[0] + 0.5
    time = np.arange(len(sweep)) * period / len(sweep)
    stroke = SampledStroke(time, sweep, pitch)
    assert stroke.period == pytest.approx(period, rel=1e-12)
    for shift in (0.0, 3 * period, -2 * period):
        motion = stroke.motion(time + shift)
        np.testing.assert_allclose(motion.sweep, sweep, atol=1e-9)
        np.testing.assert_allclose(motion.pitch, pitch, atol=1e-9)
    between = (np.arange(200) + 0.31) / 200 * period
    assert_consistent(stroke, between, 1e-6)
    # amplitudes cover the spline everywhere, and its samples
    assert np.ptp(stroke.motion(between).sweep) <= 2 * stroke.sweep_amplitude * (1 + 1e-12)
    assert np.ptp(sweep) <= 2 * stroke.sweep_amplitude * (1 + 1e-12)


def test_closed_sampling_may_have_unequal_steps():
    phase = np.linspace(0.0, 1.0, 81)
    time = (phase + 0.08 * np.sin(2 * np.pi * phase)) * 5.0
    motion = SMOOTH.motion(time)
    sweep, pitch = motion.sweep.copy(), motion.pitch.copy()
    sweep[-1], pitch[-1] = sweep[0], pitch[0]
    ours = SampledStroke(time, sweep, pitch)
    test = np.linspace(0, 5, 300)
    np.testing.assert_allclose(ours.motion(test).sweep, SMOOTH.motion(test).sweep, atol=1e-5)


def test_fast_flips_ring_little():
    sharp = SunTangStroke(0.2, np.pi / 3, np.pi / 4, 0.16, 0.16)
    ours = sampled(sharp, 100)
    time = np.linspace(0, 5, 2000)
    assert np.abs(ours.motion(time).pitch - sharp.motion(time).pitch).max() < 0.002 * np.pi / 4
    assert np.abs(ours.motion(time).sweep - sharp.motion(time).sweep).max() < 1e-4


def test_seams_are_smooth():
    stroke = sampled(SMOOTH, 16)
    ends = np.array([-1e-9, 0.0, 1e-9]) + stroke.period
    motion = stroke.motion(ends)
    for name in ("sweep", "sweep_rate", "sweep_acceleration", "pitch_acceleration"):
        assert np.ptp(getattr(motion, name)) < 1e-6


def test_constant_pitch_shapes_protocol_and_hash():
    time = np.arange(12) / 12
    stroke = SampledStroke(time, np.sin(2 * np.pi * time), np.full(12, 0.3))
    assert stroke.pitch_amplitude == pytest.approx(0.0, abs=1e-14)
    assert stroke.motion(0.1).sweep.shape == ()
    assert stroke.motion(np.zeros((2, 2))).pitch_rate.shape == (2, 2)
    assert isinstance(stroke, Stroke)
    assert hash(stroke) == hash(SampledStroke(time, np.sin(2 * np.pi * time), np.full(12, 0.3)))
    assert stroke.sample(5).time.shape == (5,)


GOOD = {"time": np.arange(10) / 10, "sweep": np.sin(np.arange(10)), "pitch": np.cos(np.arange(10))}


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({name: values[:7] for name, values in GOOD.items()}, "time must be a list of 8 to"),
        ({"sweep": np.zeros(9)}, "sweep must be a list of 10 numbers, got 9"),
        ({"pitch": np.full(10, np.nan)}, r"pitch\[0\] must be a finite number"),
        ({"sweep": 60 * GOOD["sweep"]}, "sweep must be within .*radians, not degrees"),
        ({"time": GOOD["time"][::-1]}, "time must be in increasing order"),
        ({"time": np.zeros(10)}, "time must be in increasing order"),
        ({"time": GOOD["time"] ** 2}, "time must be equally spaced, or closed by"),
        ({"time": None}, "time must be a list of numbers"),
        ({"time": GOOD["time"] * 1e-9}, "frequency of the samples must be"),
        ({"pitch": ["a"] * 10}, "pitch must be a list of numbers in rad"),
    ],
)
def test_bad_samples_give_one_sentence(changes, sentence):
    with pytest.raises(ValueError, match=f"^SampledStroke: {sentence}"):
        SampledStroke(**(GOOD | changes))


def test_later_edits_of_the_callers_arrays_do_not_reach_the_stroke():
    sweep = GOOD["sweep"].copy()
    stroke = SampledStroke(GOOD["time"], sweep, GOOD["pitch"])
    sweep[:] = 0.0
    assert stroke.sweep_amplitude > 0.9
