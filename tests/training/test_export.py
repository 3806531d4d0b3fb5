"""Policies and checkpoints as files: the same actions, and nothing in a file is executed."""

from __future__ import annotations

import pickle
from pathlib import Path

import numpy as np
import pytest
import torch

from flaprig.tasks.hover_settings import HoverSettings
from training import checkpoint, export
from training.learner import build
from training.settings import Pace, Ppo
from training.vector import HoverVecEnv

PACE = Pace(steps=64, envs=4, rollout=8, batch=32, epochs=1, learning_rate=1e-3)


@pytest.fixture
def policy():
    return build(HoverVecEnv(HoverSettings(threads=1), 4), PACE, Ppo(), 5).policy


def test_exported_policy_acts_the_same_in_numpy(tmp_path, policy):
    export.save_policy(tmp_path / "p.npz", policy, {"stage": "quasi_steady"})
    seen = np.random.default_rng(0).uniform(-1, 1, (7, 200)).astype(np.float32)
    wanted, _ = policy.predict(seen, deterministic=True)
    assert export.load_policy(tmp_path / "p.npz")(seen) == pytest.approx(wanted, abs=1e-6)


def test_exported_policy_goes_back_into_sb3(tmp_path, policy):
    export.save_policy(tmp_path / "p.npz", policy, {})
    other = build(HoverVecEnv(HoverSettings(threads=1), 4), PACE, Ppo(), 6).policy
    export.fill(other, export.load_weights(tmp_path / "p.npz"), tmp_path)
    for name, value in policy.state_dict().items():
        assert torch.equal(value, other.state_dict()[name]), name


def test_no_object_is_in_the_file(tmp_path, policy):
    export.save_policy(tmp_path / "p.npz", policy, {})
    with np.load(tmp_path / "p.npz", allow_pickle=False) as archive:
        assert {archive[name].dtype.kind for name in archive.files} == {"f", "U"}


class Trap:
    """Whoever unpickles this creates a file."""

    def __init__(self, path):
        self.path = path

    def __reduce__(self):
        return Path.touch, (Path(self.path),)


def test_hostile_files_are_refused_and_not_executed(tmp_path):
    sprung = tmp_path / "sprung"
    torch.save({"version": 1, "x": Trap(sprung)}, tmp_path / "a.pt")
    (tmp_path / "b.pt").write_bytes(pickle.dumps(Trap(sprung)))
    np.savez(tmp_path / "c.npz", about=np.array([Trap(sprung)], dtype=object))
    for name in ("a.pt", "b.pt"):
        with pytest.raises(ValueError, match="read safely"):
            checkpoint.read(tmp_path / name)
    for name in ("b.pt", "c.npz"):
        with pytest.raises(ValueError, match="no exported policy"):
            export.load_weights(tmp_path / name)
    assert not sprung.exists()


def test_checkpoint_gives_back_what_it_got(tmp_path):
    generator = np.random.default_rng(3).bit_generator.state
    state = {
        "a": np.arange(6, dtype=np.uint32).reshape(2, 3),
        "b": [1, 2.5, "x", None, True],
        "c": [generator],
        "d": torch.ones(2),
    }
    checkpoint.write(tmp_path / "c.pt", state)
    back = checkpoint.read(tmp_path / "c.pt")
    assert (back["a"] == state["a"]).all() and back["a"].dtype == np.uint32
    assert back["b"] == state["b"] and back["c"] == state["c"]
    assert torch.equal(back["d"], state["d"])
    with pytest.raises(TypeError, match="cannot hold"):
        checkpoint.write(tmp_path / "d.pt", {"x": object()})
    assert [path.name for path in tmp_path.iterdir()] == ["c.pt"]


def test_random_state_repeats_draws():
    state = checkpoint.random_state()
    first = torch.rand(3), np.random.rand(3)  # noqa: NPY002
    checkpoint.set_random_state(state)
    assert torch.equal(first[0], torch.rand(3))
    assert (first[1] == np.random.rand(3)).all()  # noqa: NPY002
