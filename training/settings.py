"""Settings of learning as frozen dataclasses; light to import, so wrong ones fail at once."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated

from tyro.conf import arg

from flaprig import _checks as check

# logarithm of the exploration's standard deviation of a policy that knows nothing
FIRST_LOG_STD = -1.5
_LEFT_OUT = arg(metavar="FLOAT", help_behavior_hint="(optional)")


@dataclass(frozen=True)
class Ppo:
    """PPO's own settings, the same in both stages.

    Attributes:
        gamma: discount factor. The paper has 0.99; here every step's reward is what the stroke is
            worth, so the next few steps tell all, and short sight learns faster (docs/results.md).
        gae_lambda: decay of the advantage estimate.
        clip_range: how far an update may move the policy's probabilities.
        target_kl: an update ends early when it has moved the policy by 1.5 times this.
        entropy: weight of the entropy bonus.
        log_std: logarithm of the exploration's standard deviation where learning begins. Left out
            it is -1.5, and with --start last_log_std at most: a trained policy explores as it did
            at its end.
        last_log_std: what it may be at most at the end; the cap falls along a line in the first
            stage and stays in the second.
    """

    gamma: float = 0.3
    gae_lambda: float = 0.95
    clip_range: float = 0.2
    target_kl: float = 0.1
    entropy: float = 0.0
    log_std: Annotated[float | None, _LEFT_OUT] = None
    last_log_std: float = -3.5

    def __post_init__(self) -> None:
        check.in_range("ppo", "gamma", self.gamma, 0.0, 1.0)
        check.in_range("ppo", "gae_lambda", self.gae_lambda, 0.0, 1.0)
        check.in_range("ppo", "clip_range", self.clip_range, 0.01, 1.0)
        check.in_range("ppo", "target_kl", self.target_kl, 1e-6, 1e3)
        check.in_range("ppo", "entropy", self.entropy, 0.0, 1.0)
        most = FIRST_LOG_STD
        if self.log_std is not None:
            most = check.in_range("ppo", "log_std", self.log_std, -7.0, 1.0)
        check.in_range("ppo", "last_log_std", self.last_log_std, -7.0, most)

    def begun(self, trained: bool) -> Ppo:
        """With the standard deviation of the exploration at a stage's beginning.

        Args:
            trained: whether the stage goes on with a policy that has learned before.
        """
        if self.log_std is not None:
            return self
        return replace(self, log_std=self.last_log_std if trained else FIRST_LOG_STD)


@dataclass(frozen=True)
class Pace:
    """How one stage learns.

    Attributes:
        steps: strokes simulated in the stage, rounded up to whole updates; 0 leaves it out.
        envs: environments side by side.
        rollout: steps of each environment between two updates.
        batch: size of a minibatch; it divides envs * rollout.
        epochs: passes over the data in an update.
        learning_rate: at the beginning; falls to a tenth along a line.
    """

    steps: int
    envs: int
    rollout: int
    batch: int
    epochs: int
    learning_rate: float

    def __post_init__(self) -> None:
        check.whole("stage", "steps", self.steps, 0, 10**9)
        check.whole("stage", "envs", self.envs, 1, 4096)
        check.whole("stage", "rollout", self.rollout, 2, 100_000)
        check.whole("stage", "batch", self.batch, 2, 10**7)
        check.whole("stage", "epochs", self.epochs, 1, 1000)
        check.in_range("stage", "learning_rate", self.learning_rate, 1e-8, 1.0)
        if self.steps_per_update % self.batch:
            allowed = f"a divisor of envs * rollout = {self.steps_per_update}"
            raise check.fail("stage", "batch", allowed, self.batch)

    @property
    def steps_per_update(self) -> int:
        """Strokes between two updates."""
        return self.envs * self.rollout

    @property
    def updates(self) -> int:
        """Updates in the stage."""
        return -(-self.steps // self.steps_per_update)


@dataclass(frozen=True)
class Lattice:
    """The vortex lattice of stage 2: coarse, a stroke in some 20 ms.

    Attributes:
        chordwise: panels along the chord.
        spanwise: panels along the span.
        steps_per_cycle: wake rows shed in one cycle.
        cycles: simulated from still fluid; the last one counts.
    """

    chordwise: int = 4
    spanwise: int = 6
    steps_per_cycle: int = 40
    cycles: int = 2

    def __post_init__(self) -> None:
        check.whole("lattice", "chordwise", self.chordwise, 1, 64)
        check.whole("lattice", "spanwise", self.spanwise, 1, 128)
        check.whole("lattice", "steps_per_cycle", self.steps_per_cycle, 4, 1000)
        check.whole("lattice", "cycles", self.cycles, 1, 20)


@dataclass(frozen=True)
class Bounds:
    """Bounds on the accelerations (eq. 13), as multiples of the sinusoid's own peaks.

    Attributes:
        sweep: times 1.654 rad/s2.
        pitch: times 1.240 rad/s2.
    """

    sweep: float = 2.0
    pitch: float = 2.0

    def __post_init__(self) -> None:
        for name in ("sweep", "pitch"):
            check.in_range("bounds", name, getattr(self, name), 1.0, 1000.0)


# stage 1: a step costs next to nothing, so many environments and large batches
QUASI_STEADY = Pace(steps=300_000, envs=64, rollout=16, batch=256, epochs=10, learning_rate=2e-4)
# stage 2: a step costs 10 ms on two cores, so short rollouts and small steps of the policy
UVLM = Pace(steps=4_800, envs=16, rollout=25, batch=100, epochs=10, learning_rate=5e-5)
