"""PPO with transfer: quasi-steady air first, the vortex lattice afterwards (paper, section 3).

    python -m training.ppo --out runs/first --seed 1
    python -m training.ppo --out runs/first --seed 1 --resume

Strokes found go to best_quasi_steady.json and best_uvlm.json, which `flaprig simulate`, `twin` and
`check` read with --stroke.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from tyro.conf import FlagCreatePairsOff, arg

from flaprig import _checks as check
from flaprig.commands.arguments import parse
from flaprig.commands.failures import EXPECTED, STOPPED, exit_code, sentence
from training.problem import Problem
from training.settings import QUASI_STEADY, UVLM, Pace, Ppo

if TYPE_CHECKING:
    from flaprig.tasks.hover_settings import HoverSettings
    from training.learner import Learner


@dataclass(frozen=True)
class Args:
    """Learn a hovering stroke with PPO: quasi-steady air first, the vortex lattice afterwards.

    Attributes:
        out: folder of the run: config, metrics, best strokes, checkpoint, policy, tensorboard.
        seed: of everything random; the same seed gives the same curve.
        resume: continue the run in the folder from its last checkpoint.
        start: begin with the policy of another run: its checkpoint.pt (with optimiser and reward
            scale) or an exported policy.npz.
        quasi_steady: stage 1.
        uvlm: stage 2.
        problem: the environment.
        ppo: the algorithm.
        evaluate_every: updates between two episodes without noise.
    """

    out: Annotated[Path, arg(metavar="DIR")] = Path("runs/ppo")
    seed: int = 1
    resume: bool = False
    start: Annotated[Path | None, arg(metavar="FILE", help_behavior_hint="(optional)")] = None
    quasi_steady: Pace = QUASI_STEADY
    uvlm: Pace = UVLM
    problem: Problem = Problem()
    ppo: Ppo = Ppo()
    evaluate_every: int = 10

    def __post_init__(self) -> None:
        check.whole("ppo", "--seed", self.seed, 0, 2**31 - 1)
        check.whole("ppo", "--evaluate-every", self.evaluate_every, 1, 10**6)
        if not self.quasi_steady.steps + self.uvlm.steps:
            raise ValueError("ppo: one of the two stages must have steps")
        if self.start is not None and not self.start.is_file():
            raise ValueError(f"ppo: --start must be a file, and there is none at {self.start}")

    def settings(self) -> dict[str, Any]:
        """What makes the run what it is, for config.json."""
        kept = {k: v for k, v in asdict(self).items() if k not in ("out", "resume", "start")}
        return {"algorithm": "ppo", **kept, "start": str(self.start) if self.start else None}

    def stages(self) -> list[tuple[str, Pace, HoverSettings]]:
        """Name, pace and environment of the stages that have steps."""
        both = [
            ("quasi_steady", self.quasi_steady, self.problem.quasi_steady()),
            ("uvlm", self.uvlm, self.problem.uvlm()),
        ]
        return [stage for stage in both if stage[1].steps]


class Run:
    """One run in its folder: the stages in their order, a checkpoint after every update."""

    def __init__(self, args: Args) -> None:
        # slow to import: not for --help nor for wrong settings
        from training import checkpoint, records

        self.args, self.checkpoint, self.records = args, checkpoint, records
        self.stages = args.stages()
        self.rows: list[dict[str, Any]] = []
        self.stage, self.seconds, self.steps = 0, 0.0, 0
        self.saved: dict[str, Any] | None = None
        self.file = args.out / records.CHECKPOINT
        if args.resume and self.file.is_file():
            self.saved = checkpoint.read(self.file)
            self.rows, self.stage = self.saved["rows"], self.saved["stage"]
            self.seconds, self.steps = self.saved["seconds"], self.saved["steps"]

    def run(self) -> None:
        """All that is left to do."""
        first = self.stage
        for number in range(first, len(self.stages)):
            name, pace, settings = self.stages[number]
            learner = self._learner(number, pace, settings)
            if learner.done < pace.updates:
                self._learn(number, learner)
            self._close(name, settings, learner)
            self.saved = {"learner": learner.state(), "stage": number}

    def _learner(self, number: int, pace: Pace, settings: HoverSettings) -> Learner:
        from training.learner import Learner
        from training.vector import HoverVecEnv

        ppo, seed = self.args.ppo, self.args.seed + 1000 * number
        if number > 0:
            # the exploration that was asked for is that of the beginning
            ppo = replace(ppo, log_std=None)
        ppo = ppo.begun(trained=number > 0 or self.args.start is not None)
        env = HoverVecEnv(settings, pace.envs)
        learner = Learner(env, pace, ppo, seed, self.args.out / "tensorboard")
        if self.saved is None:
            self._begin(learner)
        elif self.saved["stage"] == number:
            learner.restore(self.saved["learner"])
        else:
            learner.begin_with(self.saved["learner"])
        return learner

    def _begin(self, learner: Learner) -> None:
        """The policy of another run, if one is asked for."""
        from training import export

        start = self.args.start
        if start is None:
            return
        if start.suffix == ".npz":
            export.fill(learner.model.policy, export.load_weights(start), start)
        else:
            learner.begin_with(self.checkpoint.read(start)["learner"])
        if self.args.ppo.log_std is not None:
            # the file has an exploration of its own
            learner.model.policy.log_std.data.fill_(self.args.ppo.log_std)

    def _learn(self, number: int, learner: Learner) -> None:
        from flaprig.tasks.hover import Hover
        from training.screen import bar

        name, pace, settings = self.stages[number]
        hover, per = Hover(settings), pace.steps_per_update
        with bar(name, pace.updates * per, learner.done * per) as told:
            while learner.done < pace.updates:
                start = time.perf_counter()
                row = learner.update()
                self.steps += per
                if learner.done % self.args.evaluate_every == 0 or learner.done == pace.updates:
                    row |= learner.evaluate(hover)
                self.seconds += time.perf_counter() - start
                head = {"stage": name, "update": learner.done, "steps": self.steps}
                self.rows.append({**head, "seconds": round(self.seconds, 3), **row})
                self._keep(number, learner)
                learner.board(row, self.steps)
                told(learner.done * per, _words(row))

    def _keep(self, number: int, learner: Learner) -> None:
        """The checkpoint first: what else is in the folder can be made from it."""
        state = {
            "stage": number,
            "steps": self.steps,
            "seconds": self.seconds,
            "rows": self.rows,
            "learner": learner.state(),
        }
        self.checkpoint.write(self.file, state)
        self.records.write_metrics(self.args.out, self.rows)
        name, _, settings = self.stages[number]
        best = learner.watcher.best
        if best is not None:
            self.records.write_best(self.args.out, f"best_{name}", best, settings)

    def _close(self, name: str, settings: HoverSettings, learner: Learner) -> None:
        """The exported policy of a stage."""
        from training import export

        about = {"stage": name, "seed": self.args.seed, "step_size": settings.step_size}
        policy = learner.model.policy
        export.save_policy(self.args.out / f"policy_{name}.npz", policy, about)
        export.save_policy(self.args.out / self.records.POLICY, policy, about)


def _words(row: dict[str, Any]) -> str:
    if "best_cl" not in row:
        return ""
    return f"best C_L {row['best_cl']:.3f}  L/D {row['best_lift_to_drag']:.3f}"


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code: 0 fine, 1 failed, 2 bad input, 130 stopped."""
    try:
        about = (__doc__ or "").splitlines()[0]
        args = parse(Args, "python -m training.ppo", argv, about, (FlagCreatePairsOff,))
        from training.records import opened_folder

        with opened_folder(args.out, args.settings(), args.resume):
            Run(args).run()
    except EXPECTED as error:
        print(f"training.ppo: {sentence(error)}", file=sys.stderr)
        return exit_code(error)
    except KeyboardInterrupt:
        print("training.ppo: stopped; --resume continues from the last update", file=sys.stderr)
        return STOPPED
    return 0


if __name__ == "__main__":
    sys.exit(main())
