"""Many hovering episodes side by side: the decision process of the paper's section 3.1.

State: the normalised stroke. Action: the change of the twelve coefficients. After each action the
largest coefficient of an angle is made 1 again, which leaves the stroke as it is: so the state
decides what an action does, and an action never loses its effect by growing coefficients.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from flaprig.tasks.actions import ACTION_FAILED, checked_actions
from flaprig.tasks.copies import Copied
from flaprig.tasks.evaluators import evaluator
from flaprig.tasks.hover import Evaluation
from flaprig.tasks.hover_motion import has_shape, largest_is_one, shapes
from flaprig.tasks.hover_settings import COEFFICIENTS, SINUSOID_COEFFICIENTS, HoverSettings

if TYPE_CHECKING:
    from flaprig.tasks.hover_rig import HoverRigSettings

Array = NDArray[np.float64]

# why an episode ends whose action takes all coefficients of an angle away
SHAPE_LOST = "the action leaves an angle without coefficients"
# what an info holds, in the order of its columns
COLUMNS = (
    *("cl", "cd", "lift_to_drag", "side", "asymmetry"),
    *("reward_lift", "reward_ratio", "reward_side", "reward_asymmetry"),
    *("peak_sweep_acceleration", "peak_pitch_acceleration"),
)


@dataclass(frozen=True, eq=False)
class Step:
    """What one action in every episode led to. Arrays of shape (count, ...).

    Attributes:
        observation: samples of sweep and pitch over their amplitudes. Shape (count, 200).
        reward: equation 12 or 13.
        terminated: a bound was exceeded, or the simulation failed.
        truncated: the horizon was reached, and the episode was not terminated.
        coefficients: of the strokes flown. Shape (count, 12).
        evaluation: loads, terms and peaks.
        failures: the reason by row, where one failed.
    """

    observation: Array
    reward: Array
    terminated: NDArray[np.bool_]
    truncated: NDArray[np.bool_]
    coefficients: Array
    evaluation: Evaluation
    failures: dict[int, str]

    def infos(self) -> list[dict[str, Any]]:
        """One dictionary for each episode: COLUMNS, coefficients, exceeded, failure if any."""
        found = self.evaluation.coefficients
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = found.cl / found.cd
        loads = np.stack([found.cl, found.cd, ratio, found.side, found.asymmetry], axis=1)
        peaks = self.evaluation.shapes.peak_acceleration
        table = np.concatenate([loads, self.evaluation.terms, peaks], axis=1).tolist()
        infos: list[dict[str, Any]] = [dict(zip(COLUMNS, row, strict=True)) for row in table]
        exceeded = self.evaluation.exceeded.tolist()
        for info, row, beyond in zip(infos, self.coefficients.copy(), exceeded, strict=True):
            info["coefficients"] = row
            info["bounds_exceeded"] = beyond
        for k, reason in self.failures.items():
            infos[k]["failure"] = reason
        return infos


class HoverBatch(Copied):
    """Episodes that share one evaluator; it knows no seeds, generators are handed in.

    Attributes:
        hover: the evaluator.
        coefficients: of the present strokes. Shape (count, 12).
        elapsed: actions taken in each episode. Shape (count,).
    """

    def __init__(self, settings: HoverSettings | HoverRigSettings, count: int) -> None:
        self.hover = evaluator(settings)
        self.coefficients: Array = np.tile(SINUSOID_COEFFICIENTS, (count, 1))
        self.elapsed: NDArray[np.int64] = np.zeros(count, dtype=np.int64)
        self._sinusoid = shapes(self.settings, self.coefficients[:1]).observation

    @property
    def settings(self) -> HoverSettings:
        """The problem."""
        return self.hover.settings

    def reset(
        self, rows: Sequence[int] | NDArray[np.int64], generators: Sequence[np.random.Generator]
    ) -> Array:
        """Begin new episodes in some rows. Observations of shape (len(rows), 200).

        Args:
            rows: which episodes.
            generators: one for each of these rows; drawn from when there is jitter.
        """
        starts = np.tile(SINUSOID_COEFFICIENTS, (len(rows), 1))
        self.elapsed[rows] = 0
        jitter = self.settings.jitter
        if jitter > 0.0:
            noise = [generator.standard_normal(COEFFICIENTS) for generator in generators]
            starts = largest_is_one(starts + jitter * np.array(noise))
        self.coefficients[rows] = starts
        if jitter == 0.0 or len(rows) == 0:
            return np.tile(self._sinusoid, (len(rows), 1))
        return shapes(self.settings, starts).observation

    def step(self, actions: ArrayLike) -> Step:
        """Take one action in every episode; none begins anew by itself.

        Args:
            actions: clipped to [-1, 1]; a row that is not finite ends its episode. Shape
                (count, 12).

        Raises:
            ValueError: actions of another shape.
        """
        actions, broken = checked_actions("HoverBatch", actions, self.coefficients.shape)
        moved = self.coefficients + self.settings.step_size * actions
        refused = broken | ~has_shape(moved)
        if refused.any():
            moved[refused] = self.coefficients[refused]
        self.coefficients = largest_is_one(moved)
        self.elapsed += 1
        found = self.hover.evaluate(self.coefficients)
        refusals = {
            k: ACTION_FAILED if broken[k] else SHAPE_LOST for k in np.flatnonzero(refused).tolist()
        }
        failures = found.failures | refusals
        failed = np.zeros_like(refused)
        failed[list(failures)] = True
        reward = np.where(failed, -self.settings.reward.penalty, found.reward)
        terminated = found.exceeded | failed
        return Step(
            observation=found.shapes.observation,
            reward=reward,
            terminated=terminated,
            truncated=~terminated & (self.elapsed >= self.settings.horizon),
            coefficients=self.coefficients,
            evaluation=found,
            failures=failures,
        )
