"""The hovering problem as both stages and all baselines see it."""

from __future__ import annotations

from dataclasses import dataclass, replace

from flaprig.aero.models import UVLM
from flaprig.limits import SINUSOID
from flaprig.tasks.hover_settings import HoverReward, HoverSettings
from training.settings import Bounds, Lattice


@dataclass(frozen=True)
class Problem:
    """What is searched for.

    Attributes:
        bounds: on the accelerations.
        reward: weights of equations 12 and 13.
        horizon: changes of the stroke in one episode.
        step_size: change of a coefficient by an action of 1.
        jitter: standard deviation of the coefficients at an episode's start.
        threads: strokes simulated at a time.
        lattice: of stage 2.
    """

    bounds: Bounds = Bounds()
    reward: HoverReward = HoverReward()
    horizon: int = 50
    step_size: float = 0.02
    jitter: float = 0.0
    threads: int = 2
    lattice: Lattice = Lattice()

    def __post_init__(self) -> None:
        # the room below checks the rest, of both stages
        self.quasi_steady()
        self.uvlm()

    def quasi_steady(self) -> HoverSettings:
        """Stage 1.

        Raises:
            ValueError: a setting out of its range.
        """
        return HoverSettings(
            bounds=SINUSOID.times(self.bounds.sweep, self.bounds.pitch),
            reward=self.reward,
            horizon=self.horizon,
            step_size=self.step_size,
            jitter=self.jitter,
            threads=self.threads,
        )

    def uvlm(self) -> HoverSettings:
        """Stage 2.

        Raises:
            ValueError: a setting out of its range.
        """
        grid = self.lattice
        model = UVLM(grid.chordwise, grid.spanwise, grid.steps_per_cycle)
        cycles, skipped = grid.cycles, grid.cycles - 1
        return replace(self.quasi_steady(), model=model, cycles=cycles, skipped_cycles=skipped)
