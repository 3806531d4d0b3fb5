"""What environments refuse, each in one sentence that is the same everywhere."""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.error import ResetNeeded

from flaprig import QuasiSteady
from flaprig.envs import HoverRig, TrackStroke
from flaprig.tasks import ALL_TASKS, HoverBatch, HoverSettings, TrackSettings, load
from flaprig.tasks.hover_rig import HoverRigSettings

PROBLEM = HoverSettings(model=QuasiSteady(strips=2, steps_per_cycle=20), horizon=3)
SETTINGS: dict[str, Any] = {
    "flaprig/HoverKinematics-v0": PROBLEM,
    "flaprig/HoverRig-v0": HoverRigSettings(PROBLEM, time_step=0.02, limits=None),
    "flaprig/Track-v0": TrackSettings(cycles=0.012),
}
IDS = [name for name in gymnasium.registry if name.startswith("flaprig/")]
every_id = pytest.mark.parametrize("name", IDS)
NOT_FINITE = (np.nan, np.inf, -np.inf)


def begun(name: str) -> tuple[Any, np.ndarray]:
    env = gymnasium.make(name, settings=SETTINGS[name])
    env.reset(seed=0)
    return env, np.zeros(env.action_space.shape, np.float32)


@every_id
def test_wrong_shapes_are_refused_and_the_episode_goes_on(name: str) -> None:
    env, zero = begun(name)
    size = zero.size
    wrong = [0.0, [0.0], np.zeros(size - 1), np.zeros(size + 3), np.zeros((1, size)), []]
    for action in [*wrong, None, "up", [None] * size, np.zeros(size, complex), [[0.0], [0, 0]]]:
        with pytest.raises(ValueError, match=rf"step: action must be numbers of shape \({size},\)"):
            env.step(action)
    for action in (zero.tolist(), zero.astype(int), zero.astype(np.float64), zero):
        _, _, terminated, _, info = env.step(action)
        if "Track" not in name and action is not zero:
            assert not terminated
        assert "failure" not in info
        env.reset()


@every_id
@pytest.mark.parametrize("value", NOT_FINITE)
def test_action_that_is_not_finite_ends_the_episode_unrewarded(name: str, value: float) -> None:
    env, action = begun(name)
    usual = env.step(action)[1]
    action[-1] = value
    observation, reward, terminated, truncated, info = env.step(action)
    assert terminated and not truncated
    assert info["failure"] == "the action is not finite"
    assert reward == (0.0 if "Track" in name else -2.0) and reward < usual
    assert np.isfinite(observation).all()
    # and the next one begins as if nothing had been
    env.reset()
    assert "failure" not in env.step(np.zeros_like(action))[4]


@pytest.mark.parametrize("name", ALL_TASKS, ids=" ".join)
def test_tasks_do_likewise(name: tuple[str, str]) -> None:
    env = load(*name, {"settings": dict(zip(ALL_TASKS, SETTINGS.values(), strict=True))[name]})
    env.reset()
    size = env.action_spec().shape[0]
    for wrong in (np.zeros(size - 1), np.zeros(1), 0.0, np.zeros((1, size))):
        with pytest.raises(ValueError, match=rf"action must be numbers of shape \({size},\), got"):
            env.step(wrong)
    step = env.step(np.full(size, np.nan))
    assert step.last() and step.discount == 0.0
    assert step.reward == (0.0 if name[0] == "track" else -2.0)
    # dm_env begins anew by itself
    assert env.step(np.zeros(size)).first()
    assert env.step(np.zeros(size)).reward > -2.0


def test_one_bad_row_of_a_batch_ends_alone() -> None:
    vector = pytest.importorskip("training.vector")
    env = vector.HoverVecEnv(PROBLEM, 64, seed=0)
    with pytest.raises(RuntimeError, match=r"HoverVecEnv.step: reset\(\) must be called first"):
        env.step(np.zeros((64, 12)))
    env.reset()
    action = np.zeros((64, 12))
    for wrong in (action[:63], action[:, :4], action[0], 0.0):
        with pytest.raises(ValueError, match=r"step: action must be numbers of shape \(64, 12\)"):
            env.step(wrong)
    action[7, 3], action[9] = np.nan, np.inf
    _, rewards, dones, infos = env.step(action)
    assert np.flatnonzero(dones).tolist() == [7, 9] and (rewards[[7, 9]] == -2.0).all()
    assert {k for k in range(64) if "failure" in infos[k]} == {7, 9}
    with pytest.raises(ValueError, match=r"HoverBatch: action must be numbers of shape \(3, 12\)"):
        HoverBatch(PROBLEM, 3).step(np.zeros((2, 12)))


@every_id
@pytest.mark.parametrize("wrapped", [True, False])
def test_steps_before_reset_and_after_the_end(name: str, wrapped: bool) -> None:
    env: Any = gymnasium.make(name, settings=SETTINGS[name], render_mode="rgb_array")
    env = env if wrapped else env.unwrapped
    zero = np.zeros(env.action_space.shape, np.float32)
    for call in (lambda: env.step(zero), env.render):
        with pytest.raises(ResetNeeded, match=r"reset\(\) must be called first, got .* before the"):
            call()
    env.reset(seed=0)
    for _ in range(3):
        over = any(env.step(zero)[2:4])
    assert over
    for _ in range(2):
        with pytest.raises(RuntimeError, match=r"first, got step\(\) after the epi"):
            env.step(zero)
    env.reset()
    env.step(zero)


@pytest.mark.parametrize(
    ("name", "changes"),
    [
        ("flaprig/HoverKinematics-v0", {"horizon": 10, "jitter": 0.01, "step_size": 0.1}),
        ("flaprig/HoverRig-v0", {"horizon": 10, "frequency": 0.25, "time_step": 0.02}),
        ("flaprig/HoverRig-v0", {"problem": PROBLEM, "horizon": 10}),
        ("flaprig/Track-v0", {"horizon": 10, "disturbance": (0.1, 0.0)}),
        ("flaprig/Track-v0", {"horizon": 1}),
        ("flaprig/Track-v0", {"cycles": 0.04}),
    ],
)
def test_settings_by_keyword(name: str, changes: dict[str, Any]) -> None:
    env: Any = gymnasium.make(name, settings=SETTINGS[name], **changes)
    env.reset(seed=0)
    zero, count = np.zeros(env.action_space.shape), 1
    while not env.step(zero)[3]:
        count += 1
    assert count == changes.get("horizon", 10)


def test_settings_by_keyword_are_those_of_the_problem() -> None:
    env = HoverRig(horizon=7, cycles=3, time_step=0.02, limits=None, threads=1)
    assert (env.settings.horizon, env.settings.cycles, env.settings.threads) == (7, 3, 1)
    calm = TrackStroke(disturbance=(0.0, 0.0), random_phase=False)
    assert calm._task.settings.disturbance == (0.0, 0.0)


@every_id
def test_wrong_keywords_are_one_sentence(name: str) -> None:
    owner = r"(HoverKinematics|HoverRig|TrackStroke)"
    with pytest.raises(ValueError, match=rf"^{owner}: keyword must be one of settings, render_mod"):
        gymnasium.make(name, horizont=10)
    for value in (0, 2.5, "ten"):
        with pytest.raises(ValueError, match="horizon must be a whole number from 1 to 1000000"):
            gymnasium.make(name, horizon=value)
    for settings in (1, "quick", {"horizon": 10}, TrackSettings):
        with pytest.raises(ValueError, match=rf"^{owner}: settings must be a \w+Settings, got"):
            gymnasium.make(name, settings=settings)
    with pytest.raises(ValueError, match="cycles must be"):
        gymnasium.make(name, cycles=-1)


def test_track_refuses_a_length_said_twice() -> None:
    with pytest.raises(ValueError, match="horizon must be given without cycles, which say the sa"):
        TrackStroke(horizon=10, cycles=1.0)
