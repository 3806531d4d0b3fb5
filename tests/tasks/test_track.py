"""Following a stroke: zeros are the servos' own tracking, and help helps."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import mujoco
import numpy as np
import pytest
from dm_control.rl import control

from flaprig import FourierStroke, Rig
from flaprig.motors import RIG_MOTORS
from flaprig.tasks import TrackSettings, load
from flaprig.tasks.actions import ACTION_FAILED
from flaprig.tasks.track import Track

CALM = TrackSettings(disturbance=(0.0, 0.0), random_phase=False, cycles=0.3)


def environment(settings: TrackSettings, seed: int = 0) -> control.Environment:
    return load("track", "stroke", {"random": seed, "settings": settings})


def errors(env: control.Environment, action: np.ndarray) -> np.ndarray:
    """Of all instants in [rad]. Shape (n, 2)."""
    step, found = env.reset(), []
    while not step.last():
        step = env.step(action)
        found.append(env.task.error(env.physics))
    return np.array(found)


def test_it_starts_on_the_stroke() -> None:
    env = environment(replace(CALM, random_phase=True))
    env.reset()
    np.testing.assert_allclose(env.task.error(env.physics), 0.0, atol=1e-12)
    reference = env.task.reference(0.0)
    np.testing.assert_allclose(
        env.physics.rates(), [reference.sweep_rate, reference.pitch_rate], atol=1e-12
    )


def test_servos_alone_follow() -> None:
    """Within the servo's stiffness: a torque of 0.3 N m over 38 N m/rad is 8 mrad."""
    error = np.abs(errors(environment(CALM), np.zeros(4)))
    assert 1e-4 < error.max() < 0.02


def test_correction_moves_the_wing_that_way() -> None:
    """A constant correction of a servo as stiff as this shifts the angle by nearly as much."""
    plain, pushed = (
        errors(environment(CALM), action)
        for action in (np.zeros(4), np.array([0.1, -0.1, 0.0, 0.0]))
    )
    shift = (pushed - plain)[-50:].mean(axis=0)
    np.testing.assert_allclose(shift, [0.01, -0.01], rtol=0.1)


def test_torque_moves_the_wing_by_torque_over_stiffness() -> None:
    plain, pushed = (
        errors(environment(CALM), action)
        for action in (np.zeros(4), np.array([0.0, 0.0, 0.5, 0.0]))
    )
    kp = RIG_MOTORS.sweep.dcmotor["controller"][0]
    shift = (pushed - plain)[-50:, 0].mean()
    assert shift == pytest.approx(0.5 / kp, rel=0.1)


def test_pushes_have_the_spread_asked_for() -> None:
    settings = replace(CALM, disturbance=(0.3, 0.0), correlation_time=0.05, cycles=10.0)
    env = environment(settings)
    env.reset()
    pushes = []
    for _ in range(2000):
        env.step(np.zeros(4))
        pushes.append(env.physics.data.qfrc_applied.copy())
    found = np.array(pushes)
    assert found[:, 0].std() == pytest.approx(0.3, rel=0.1) and (found[:, 1] == 0.0).all()
    # exp(-0.02/0.05) from one interval to the next
    following = np.corrcoef(found[1:, 0], found[:-1, 0])[0, 1]
    assert following == pytest.approx(np.exp(-0.4), abs=0.05)


def test_reward_falls_with_the_error() -> None:
    env = environment(CALM)
    env.reset()
    rewards = []
    for shift in (0.0, 0.01, 0.02, 0.1):
        angles = env.physics.angles()
        angles[0] += shift
        env.physics.set_motion(angles, env.physics.rates())
        rewards.append(env.task.get_reward(env.physics))
        angles[0] -= shift
        env.physics.set_motion(angles, env.physics.rates())
    assert rewards[0] == pytest.approx(1.0) and rewards[2] == pytest.approx(0.1, abs=0.03)
    assert sorted(rewards, reverse=True) == rewards


def test_losing_the_stroke_terminates() -> None:
    weak = replace(CALM, disturbance=(500.0, 0.0), cycles=1.0)
    env = environment(weak)
    step = env.reset()
    count = 0
    while not step.last():
        step, count = env.step(np.zeros(4)), count + 1
    assert step.discount == 0.0 and count < weak.horizon


def test_nan_ends_the_episode_with_a_reason_and_nothing_else() -> None:
    env = environment(CALM)
    env.reset()
    env.step(np.zeros(4))
    env.physics.data.qvel[0] = np.nan
    step = env.step(np.zeros(4))
    assert step.last() and step.discount == 0.0 and step.reward == 0.0
    assert all(np.isfinite(value).all() for value in step.observation.values())
    assert env.physics.failure
    env.reset()
    assert env.physics.failure is None
    assert not env.step(np.zeros(4)).last()


def test_action_that_is_no_number_is_no_help() -> None:
    """It ends the episode unrewarded: a policy that diverges does not look trained."""
    one, other = (environment(CALM) for _ in range(2))
    assert len(errors(one, np.full(4, np.nan))) == 1 < len(errors(other, np.zeros(4)))
    for bad in (np.nan, np.inf):
        one.reset()
        step = one.step(np.array([0.0, 0.0, 0.0, bad]))
        assert step.last() and step.discount == 0.0 and step.reward == 0.0
        assert one.physics.failure == ACTION_FAILED


def test_observation_is_what_it_says() -> None:
    env = environment(CALM)
    env.reset()
    for _ in range(4):
        step = env.step(np.zeros(4))
    seen, task = step.observation, env.task
    assert isinstance(task, Track)
    ahead = CALM.stroke.motion(0.02 * (4 + np.arange(4)))
    np.testing.assert_allclose(
        seen["reference_angles"].reshape(4, 2), np.column_stack([ahead.sweep, ahead.pitch])
    )
    np.testing.assert_allclose(seen["error"] * 0.01, seen["angles"] - seen["reference_angles"][:2])
    assert isinstance(env.physics.model.ptr, mujoco.MjModel)


BAD: list[tuple[str, Any]] = [
    ("rig", None),
    ("stroke", "sinusoid"),
    ("control_interval", 0.005),
    ("control_interval", 0.0),
    ("time_step", 0.0),
    ("cycles", -1.0),
    ("disturbance", (0.1,)),
    ("disturbance", (-0.1, 0.1)),
    ("disturbance", (float("nan"), 0.1)),
    ("random_phase", 1),
    ("margin", 0.0),
    ("lost", float("inf")),
]


@pytest.mark.parametrize(("name", "value"), BAD)
def test_bad_settings_are_one_sentence(name: str, value: Any) -> None:
    with pytest.raises(ValueError, match=f"TrackSettings: {name}.* must be .*, got "):
        replace(TrackSettings(), **{name: value})


def test_stroke_beyond_the_stops_is_refused() -> None:
    far = FourierStroke(0.2, (-1.7,), (0.0,), (0.0,), (0.5,))
    with pytest.raises(ValueError, match="sweep must be within the joint's range"):
        environment(TrackSettings(rig=Rig(model=CALM.rig.model), stroke=far))
