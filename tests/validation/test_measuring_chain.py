"""The measuring chain: what it leaves alone, and that a delay put in is found again."""

import dataclasses
import math

import numpy as np
import pytest

from flaprig.fluid import WATER
from flaprig.strokes import FourierStroke
from flaprig.validation.measured_file import Measured, history, read
from flaprig.validation.measuring_chain import OneCycle, buoyancy, delay, reading
from flaprig.wing import Wing

N = 200
PHASE = np.arange(N) / N
# its reversals lie between two instants
STROKE = FourierStroke(0.15, (-1.2, 0, 0), (0.02, 0, 0), (-0.1, 0, 0), (0.8, 0, 0.03))


def series(values, harmonics=20):
    """a0, a1, b1, ... of values at equal phases."""
    waves = np.fft.rfft(values) / values.size
    pairs = np.column_stack([2 * waves.real, -2 * waves.imag])[1 : harmonics + 1]
    return np.concatenate([[waves[0].real], pairs.ravel()])


def plate_force(scale=0.06):
    """A normal force that follows the pitch: forces of a thin plate, none along the chord."""
    motion = STROKE.motion(PHASE / STROKE.frequency)
    normal = scale * np.sin(2 * np.pi * PHASE - 0.2)
    sign = np.sign(motion.sweep_rate)
    return OneCycle(STROKE, normal * np.sin(motion.pitch), sign * normal * np.cos(motion.pitch))


def measured_as(read_out):
    wing = Wing.beta(0.24, 0.06, 0.5, 0.56)
    return Measured(
        "made", wing, STROKE, WATER, 3000.0, 0.02, series(read_out.lift / 0.02),
        series(read_out.drag / 0.02), 1.0, 1.0,
    )  # fmt: skip


def test_turning_there_and_back_is_nothing():
    truth = plate_force()
    chord, normal = truth.in_wing_axes(0.4)
    again = truth.turned_back(chord, normal, 0.4)
    np.testing.assert_allclose(again.lift, truth.lift, atol=1e-15)
    np.testing.assert_allclose(again.drag, truth.drag, atol=1e-15)
    assert np.abs(truth.in_wing_axes(0.0)[0]).max() < 1e-15


def test_without_delay_slow_forces_pass():
    truth = plate_force()
    case = measured_as(truth)
    out = reading(case, truth, late=0.0)
    # the second harmonic is a fifth of the cut-off
    np.testing.assert_allclose(out.lift, truth.lift, atol=0.02 * np.abs(truth.lift).max())
    assert out.lift.mean() == pytest.approx(truth.lift.mean(), rel=0.01)


@pytest.mark.parametrize("late", [0.05, 0.15, 0.25])
def test_a_delay_is_found_again_without_a_model(late):
    truth = plate_force()
    out = reading(measured_as(truth), truth, late)
    assert delay(measured_as(out)) == pytest.approx(late, abs=0.01)


def test_a_delay_turns_buoyancy_into_drag():
    truth = plate_force()
    case = measured_as(truth)
    assert buoyancy(case) > 5 * np.abs(truth.lift).max()
    late = reading(case, truth, 0.15)
    heavy = dataclasses.replace(case.wing, thickness=1e-6)
    light = reading(dataclasses.replace(case, wing=heavy), truth, 0.15)
    assert np.abs(late.drag - truth.drag).max() > 3 * np.abs(light.drag - truth.drag).max()


def test_the_measured_strokes_agree_on_one_delay():
    found = np.array([delay(case) for case in read()])
    assert found.mean() == pytest.approx(0.151, abs=0.002)
    assert found.std() < 0.02


def test_history_is_a_fourier_series():
    values = 1.0 + np.cos(2 * np.pi * PHASE) - 0.5 * np.sin(6 * np.pi * PHASE)
    np.testing.assert_allclose(history(series(values), PHASE), values, atol=1e-12)
    assert history(np.array([2.0, 1.0, 0.0]), np.array([0.25]))[0] == pytest.approx(2.0)
    assert math.isclose(history(np.array([2.0, 0.0, 1.0]), np.array([0.25]))[0], 3.0)
