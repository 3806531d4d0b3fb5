"""Episodes of the hovering problem: what an action does, how they begin and end."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from flaprig.limits import SINUSOID
from flaprig.tasks import SINUSOID_COEFFICIENTS, HoverBatch, HoverSettings
from flaprig.tasks.actions import ACTION_FAILED
from flaprig.tasks.hover_batch import COLUMNS, SHAPE_LOST

SETTINGS = HoverSettings(horizon=5)


def generators(count: int, seed: int = 0) -> list[np.random.Generator]:
    return [np.random.default_rng(seed + k) for k in range(count)]


def started(settings: HoverSettings, count: int) -> HoverBatch:
    batch = HoverBatch(settings, count)
    batch.reset(range(count), generators(count))
    return batch


def test_action_is_the_change_of_coefficients() -> None:
    """By step_size, clipped, and rescaled to the largest of each angle."""
    batch = started(SETTINGS, 1)
    action = np.zeros((1, 12))
    action[0, 2], action[0, 11] = 0.5, -7.0
    step = batch.step(action)
    expected = np.array(SINUSOID_COEFFICIENTS)
    expected[2], expected[11] = 0.01, -0.02
    np.testing.assert_allclose(step.coefficients[0], expected, atol=1e-15)
    action = np.zeros((1, 12))
    action[0, 0] = -1.0
    grown = batch.step(action).coefficients[0]
    np.testing.assert_allclose(grown[[0, 2]], [-1.0, 0.01 / 1.02], rtol=1e-14)
    np.testing.assert_allclose(grown[6:], expected[6:], rtol=1e-14)


def test_observation_decides_what_an_action_does() -> None:
    """Two ways to one stroke: the same coefficients, so the same future."""
    batch = started(SETTINGS, 2)
    batch.coefficients[1] *= 3.0
    zero = batch.step(np.zeros((2, 12)))
    np.testing.assert_array_equal(zero.observation[0], zero.observation[1])
    np.testing.assert_array_equal(zero.coefficients[0], zero.coefficients[1])


def test_horizon_truncates_and_does_not_terminate() -> None:
    batch = started(SETTINGS, 3)
    for k in range(5):
        step = batch.step(np.zeros((3, 12)))
        assert not step.terminated.any()
        assert (step.truncated == (k == 4)).all()


def test_bounds_terminate_and_do_not_truncate() -> None:
    batch = started(replace(SETTINGS, bounds=SINUSOID, horizon=1), 2)
    action = np.zeros((2, 12))
    # a third harmonic that sharpens the reversals of the second row's sweep
    action[1, 2] = -1.0
    step = batch.step(action)
    assert step.terminated.tolist() == [False, True]
    assert step.truncated.tolist() == [True, False]
    assert step.reward[1] == -2.0 and step.reward[0] > 0.0
    infos = step.infos()
    assert [info["bounds_exceeded"] for info in infos] == [False, True]
    assert np.isnan(infos[1]["cl"]) and "failure" not in infos[1]


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_action_that_is_no_number_ends_its_own_episode(bad: float) -> None:
    batch = started(SETTINGS, 2)
    action = np.zeros((2, 12))
    action[1, 5] = bad
    step = batch.step(action)
    assert step.terminated.tolist() == [False, True]
    assert step.failures == {1: ACTION_FAILED} and step.reward[1] == -2.0
    assert step.infos()[1]["failure"] == ACTION_FAILED
    assert np.isfinite(step.observation).all() and np.isfinite(batch.coefficients).all()


def test_action_that_takes_an_angle_away_says_so() -> None:
    """Finite, and yet no stroke is left: all six coefficients of the pitch become zero."""
    batch = started(replace(SETTINGS, step_size=0.5), 2)
    batch.coefficients[1, 9] = 0.25
    action = np.zeros((2, 12))
    action[1, 9] = -0.5
    step = batch.step(action)
    assert step.failures == {1: SHAPE_LOST} and step.terminated.tolist() == [False, True]


def test_jitter_comes_from_the_generator_given() -> None:
    settings = replace(SETTINGS, jitter=0.05)
    batch = HoverBatch(settings, 4)
    first = batch.reset(range(4), generators(4))
    kept = batch.coefficients.copy()
    np.testing.assert_array_equal(batch.reset(range(4), generators(4)), first)
    np.testing.assert_array_equal(batch.coefficients, kept)
    assert np.unique(first[:, 3]).size == 4
    spread = (kept - SINUSOID_COEFFICIENTS).std()
    assert 0.03 < spread < 0.07
    other = batch.reset([2], generators(1, seed=9))
    assert not np.array_equal(other[0], first[2])
    np.testing.assert_array_equal(batch.coefficients[[0, 1, 3]], kept[[0, 1, 3]])


def test_without_jitter_every_episode_is_the_sinusoids() -> None:
    first = started(SETTINGS, 2)
    observation = first.reset([1], generators(1))
    t = 2.0 * np.pi * np.arange(100) / 100
    np.testing.assert_allclose(observation[0, 100:], np.sin(t), atol=1e-14)


def test_infos_hold_what_they_promise() -> None:
    step = started(SETTINGS, 2).step(np.zeros((2, 12)))
    for k, info in enumerate(step.infos()):
        assert {*COLUMNS, "coefficients", "bounds_exceeded"} == set(info)
        terms = [info[f"reward_{name}"] for name in ("lift", "ratio", "side", "asymmetry")]
        assert sum(terms) == pytest.approx(step.reward[k], abs=1e-12)
        assert info["lift_to_drag"] == pytest.approx(info["cl"] / info["cd"])
        assert isinstance(info["cl"], float)
    info["coefficients"][:] = 0.0
    assert step.coefficients[1, 0] == -1.0
