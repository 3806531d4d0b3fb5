"""Evaluation episodes: the policy's mean action, from the sinusoid, without noise."""

from __future__ import annotations

import numpy as np

from flaprig.tasks.hover import Hover
from flaprig.tasks.hover_motion import largest_is_one
from flaprig.tasks.hover_settings import SINUSOID_COEFFICIENTS
from training.candidate import Candidate
from training.export import Policy


def episode(hover: Hover, policy: Policy, steps: int) -> tuple[Candidate | None, float]:
    """The best stroke on the way, and the mean reward of the episode.

    Args:
        hover: the evaluator.
        policy: actions from observations.
        steps: changes of the stroke at most; a stroke beyond the bounds ends the episode, and
            each step that it lacks counts as the penalty.
    """
    coefficients = np.array([SINUSOID_COEFFICIENTS])
    observation = hover.evaluate(coefficients).shapes.observation
    best, rewards = None, []
    for _ in range(steps):
        action = np.asarray(policy(observation), np.float64)
        coefficients = largest_is_one(coefficients + hover.settings.step_size * action)
        found = hover.evaluate(coefficients)
        rewards.append(float(found.reward[0]))
        if found.exceeded[0] or found.failed[0]:
            break
        best = better(best, candidate(found.reward[0], found, 0, coefficients))
        observation = found.shapes.observation
    missing = steps - len(rewards)
    total = sum(rewards) - missing * hover.settings.reward.penalty
    return best, total / steps


def candidate(reward, found, row: int, coefficients: np.ndarray) -> Candidate:
    """The stroke of one row of an evaluation."""
    cl, cd = float(found.coefficients.cl[row]), float(found.coefficients.cd[row])
    return Candidate(float(reward), cl, cl / cd, tuple(coefficients[row].tolist()))


def better(a: Candidate | None, b: Candidate | None) -> Candidate | None:
    """The one of higher reward."""
    if a is None or b is None:
        return a or b
    return a if a.reward >= b.reward else b
