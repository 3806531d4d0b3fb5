"""Small runs of PPO that take a second; nothing is collected without the extra `train`."""

from __future__ import annotations

from importlib.util import find_spec

import pytest

if any(find_spec(package) is None for package in ("torch", "stable_baselines3", "cma")):
    collect_ignore_glob = ["test_*.py"]

# a run of six updates in quasi-steady air
SMALL = [
    *("--seed", "3", "--quasi-steady.steps", "768", "--quasi-steady.envs", "16"),
    *("--quasi-steady.rollout", "8", "--quasi-steady.batch", "64", "--uvlm.steps", "0"),
    *("--evaluate-every", "3", "--problem.threads", "1"),
]


@pytest.fixture
def small() -> list[str]:
    """Arguments of a small run."""
    return list(SMALL)
