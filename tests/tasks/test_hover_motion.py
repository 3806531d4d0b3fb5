"""Rows of coefficients are the strokes that FourierStroke.normalized makes of them."""

from __future__ import annotations

import numpy as np
import pytest

from flaprig.aero.rigid_motion import RigidMotion
from flaprig.limits import SINUSOID
from flaprig.tasks.hover_motion import has_shape, largest_is_one, motions, rigid_motion, shapes
from flaprig.tasks.hover_settings import SINUSOID_COEFFICIENTS, HoverSettings
from flaprig.tasks.series import waves

SETTINGS = HoverSettings()
ROWS = np.array(SINUSOID_COEFFICIENTS) + 0.3 * np.random.default_rng(1).normal(size=(25, 12))


def test_sinusoid_has_its_closed_form() -> None:
    shape = shapes(SETTINGS, np.array([SINUSOID_COEFFICIENTS]))
    t = 2.0 * np.pi * np.arange(100) / 100
    expected = np.concatenate([-np.cos(t), np.sin(t)])
    np.testing.assert_allclose(shape.observation[0], expected, atol=1e-14)
    found = shape.peak_acceleration[0]
    np.testing.assert_allclose(found, [SINUSOID.sweep, SINUSOID.pitch], rtol=1e-14)


@pytest.mark.parametrize("row", range(0, 25, 6))
def test_strokes_are_fourier_strokes(row: int) -> None:
    shape = shapes(SETTINGS, ROWS)
    stroke = SETTINGS.stroke(ROWS[row])
    sweep, pitch = shape.series[row]
    np.testing.assert_allclose(sweep, [*stroke.sweep_cos, *stroke.sweep_sin], atol=1e-14)
    np.testing.assert_allclose(pitch, [*stroke.pitch_cos, *stroke.pitch_sin], atol=1e-14)
    np.testing.assert_allclose(shape.mean[row], [stroke.sweep_mean, stroke.pitch_mean], atol=1e-14)
    sample = stroke.sample(100)
    observed = np.concatenate(
        [sample.sweep / SETTINGS.sweep_amplitude, sample.pitch / SETTINGS.pitch_amplitude]
    )
    np.testing.assert_allclose(shape.observation[row], observed, atol=1e-13)


def test_observations_stay_in_the_space_and_touch_its_ends() -> None:
    observation = shapes(SETTINGS, ROWS).observation
    assert np.abs(observation).max() <= 1.0
    assert (np.abs(observation.reshape(25, 2, 100)).max(axis=2) > 0.99).all()


@pytest.mark.parametrize("row", range(0, 25, 6))
def test_peaks_are_not_passed_between_samples(row: int) -> None:
    peak = shapes(SETTINGS, ROWS).peak_acceleration[row]
    sample = SETTINGS.stroke(ROWS[row]).sample(20_000)
    dense = [np.abs(sample.sweep_acceleration).max(), np.abs(sample.pitch_acceleration).max()]
    assert (peak >= np.array(dense) * (1.0 - 1e-13)).all()
    np.testing.assert_allclose(peak, dense, rtol=1e-6)


def test_motions_and_rigid_motion_are_the_single_ones() -> None:
    shape = shapes(SETTINGS, ROWS)
    motion = motions(shape, SETTINGS.frequency, waves(60))
    rigid = rigid_motion(motion)
    for row in (0, 7, 24):
        sample = SETTINGS.stroke(ROWS[row]).sample(60)
        for name in ("sweep", "pitch_rate", "sweep_acceleration", "pitch_acceleration"):
            np.testing.assert_allclose(
                getattr(motion, name)[row], getattr(sample, name), atol=2e-13
            )
        alone, own = RigidMotion.from_stroke(sample), rigid.part(slice(60 * row, 60 * row + 60))
        for name in ("position", "rotation", "twist", "twist_rate"):
            np.testing.assert_allclose(getattr(own, name), getattr(alone, name), atol=1e-12)


def test_scaling_to_one_keeps_the_stroke() -> None:
    scaled = largest_is_one(ROWS)
    np.testing.assert_array_equal(np.abs(scaled.reshape(25, 2, 6)).max(axis=2), 1.0)
    before, after = shapes(SETTINGS, ROWS), shapes(SETTINGS, scaled)
    np.testing.assert_allclose(after.series, before.series, atol=1e-14)


def test_repeated_motion_is_the_cycle_again() -> None:
    motion = motions(shapes(SETTINGS, ROWS[:2]), 0.2, waves(20))
    twice = motion.repeated(2)
    np.testing.assert_array_equal(twice.pitch, np.hstack([motion.pitch, motion.pitch]))
    assert motion.repeated(1) is motion


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_what_is_no_stroke(bad: float) -> None:
    rows = np.tile(SINUSOID_COEFFICIENTS, (4, 1))
    rows[1, 3] = bad
    rows[2, :6] = 0.0
    rows[3, 6:] = 1e-12
    assert has_shape(rows).tolist() == [True, False, False, False]
