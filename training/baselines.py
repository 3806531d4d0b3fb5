"""What PPO has to be measured against: CMA-ES and random search on the same problem.

    python -m training.baselines --out runs/baselines --seed 1
    python -m training.baselines --what sweep --out runs/sweep

CMA-ES (N. Hansen's library `cma`) starts from the sinusoid. A stroke beyond the bounds costs it the
penalty and what it exceeds them by, so that it finds its way back; every stroke counts as one
simulation, whether it was within the bounds or not, as for PPO.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
from numpy.typing import NDArray
from tyro.conf import FlagCreatePairsOff, arg

from flaprig import _checks as check
from flaprig.commands.arguments import parse
from flaprig.commands.failures import EXPECTED, STOPPED, exit_code, sentence
from training.problem import Problem
from training.settings import Bounds

if TYPE_CHECKING:
    from flaprig.tasks.hover import Hover
    from training.candidate import Candidate

Array = NDArray[np.float64]

# spread of the first population, in units of the largest coefficient
SIGMA = 0.05
# strokes in one generation of either search
POPULATION = 32
# spreads among which random search draws
SPREADS = (0.003, 0.3)
# bounds of the sweep: multiples of the sinusoid's accelerations, and what the rig has reached
SWEEP = ((1.2, 1.8), (1.3, 2.0), (1.5, 2.0), (2.0, 2.0), (2.2491, 9.7580), (3.0, 12.0))


@dataclass(frozen=True)
class Args:
    """CMA-ES and random search on the problem of training.ppo.

    Attributes:
        what: both searches at one pair of bounds, or CMA-ES over several pairs of bounds.
        out: folder of the run.
        seed: of everything random.
        model: the air that strokes are judged by.
        simulations: strokes that each search may judge.
        problem: the environment.
    """

    out: Annotated[Path, arg(metavar="DIR")] = Path("runs/baselines")
    what: Annotated[str, arg(metavar="compare|sweep")] = "compare"
    seed: int = 1
    model: Annotated[str, arg(metavar="quasi_steady|uvlm")] = "quasi_steady"
    simulations: int = 20_000
    problem: Problem = Problem()

    def __post_init__(self) -> None:
        check.whole("baselines", "--seed", self.seed, 0, 2**31 - 1)
        check.whole("baselines", "--simulations", self.simulations, POPULATION, 10**8)
        for name, choices in (("what", ("compare", "sweep")), ("model", ("quasi_steady", "uvlm"))):
            if getattr(self, name) not in choices:
                allowed = f"one of {', '.join(choices)}"
                raise check.fail("baselines", f"--{name}", allowed, getattr(self, name))


class Judge:
    """Rewards of strokes, with a count, a clock and the best so far."""

    def __init__(self, hover: Hover) -> None:
        self.hover, self.best = hover, None
        # from the first stroke on, without the imports before it
        self.count, self.began = 0, 0.0
        self.rows: list[dict[str, Any]] = []

    best: Candidate | None

    def __call__(self, coefficients: Array) -> Array:
        """Reward of each row, less what it exceeds the bounds by. Shape (rows,)."""
        from flaprig.tasks.hover_motion import largest_is_one
        from training.evaluation import better, candidate

        self.began = self.began or time.perf_counter()
        found = self.hover.evaluate(largest_is_one(coefficients))
        self.count += len(coefficients)
        k = int(np.argmax(np.where(found.exceeded | found.failed, -np.inf, found.reward)))
        if not (found.exceeded[k] or found.failed[k]):
            self.best = better(self.best, candidate(found.reward[k], found, k, coefficients))
        self._note(float(found.reward.mean()))
        bounds = self.hover.settings.bounds
        over = found.shapes.peak_acceleration / np.array([bounds.sweep, bounds.pitch]) - 1.0
        return found.reward - 10.0 * np.maximum(over, 0.0).sum(axis=1) * found.exceeded

    def _note(self, mean: float) -> None:
        row = {"simulations": self.count, "seconds": time.perf_counter() - self.began}
        best = self.best.row("best") if self.best else {}
        self.rows.append({**row, "reward_mean": mean, **best})


def evolution(judge: Judge, simulations: int, seed: int) -> None:
    """CMA-ES from the sinusoid."""
    import cma

    from flaprig.tasks.hover_settings import SINUSOID_COEFFICIENTS

    # cma takes 0 for a seed of the clock's choice
    options = {"seed": seed + 1, "verbose": -9, "popsize": POPULATION, "tolfun": 0.0}
    search = cma.CMAEvolutionStrategy(list(SINUSOID_COEFFICIENTS), SIGMA, options)
    while judge.count + POPULATION <= simulations:
        asked = search.ask()
        search.tell(asked, list(-judge(np.array(asked))))


def random_search(judge: Judge, simulations: int, seed: int) -> None:
    """Normal steps of random size from the best stroke so far."""
    from flaprig.tasks.hover_settings import SINUSOID_COEFFICIENTS

    generator = np.random.default_rng(seed)
    low, high = np.log(SPREADS)
    while judge.count + POPULATION <= simulations:
        centre = judge.best.coefficients if judge.best else SINUSOID_COEFFICIENTS
        spread = np.exp(generator.uniform(low, high, (POPULATION, 1)))
        judge(np.array(centre) + spread * generator.standard_normal((POPULATION, len(centre))))


SEARCHES: dict[str, Callable[[Judge, int, int], None]] = {
    "cma_es": evolution,
    "random": random_search,
}


def compare(args: Args) -> None:
    """Both searches, their curves and their best strokes."""
    from flaprig.report.learning import draw_learning, read_learned
    from flaprig.tasks.hover import Hover
    from training import records

    settings = getattr(args.problem, args.model)()
    for name, search in SEARCHES.items():
        judge = Judge(Hover(settings))
        search(judge, args.simulations, args.seed)
        records.write_metrics(args.out, judge.rows, f"{name}.csv")
        if judge.best is not None:
            records.write_best(args.out, f"best_{name}", judge.best, settings)
            print(f"{name}: reward {judge.best.reward:.4f}, C_L {judge.best.cl:.3f}, "
                  f"L/D {judge.best.lift_to_drag:.3f}, {judge.count} strokes")  # fmt: skip
    curves = [read_learned(args.out / f"{name}.csv", name) for name in SEARCHES]
    draw_learning(args.out / "learning.png", curves, f"Searches, {args.model}", None)


def sweep(args: Args) -> None:
    """CMA-ES at several bounds; gains by the full vortex lattice, drawn as a front."""
    from flaprig.report.pareto import Gain, draw_pareto
    from training import records
    from training.judged import gains_by_lattice

    rows, gains = [], []
    for sweep_bound, pitch_bound in SWEEP:
        bounds = Bounds(sweep_bound, pitch_bound)
        settings = getattr(replace(args.problem, bounds=bounds), args.model)()
        best = _best(settings, args)
        name = f"{sweep_bound:.3g}x / {pitch_bound:.3g}x"
        lift, ratio = gains_by_lattice([settings.stroke(best.coefficients)])[0]
        gains.append(Gain(name, lift, ratio, f"CMA-ES, {args.model}"))
        rows.append({**asdict(bounds), "cl_gain_percent": lift, "ld_gain_percent": ratio})
        print(f"{name}: C_L {lift:+.1f} %, L/D {ratio:+.1f} %")
        records.write_metrics(args.out, rows, "pareto.csv")
        records.write_best(args.out, f"best_{len(rows)}", best, settings)
    paper = [Gain("paper, case A", 25.8, 24.3, ""), Gain("paper, case B", 35.6, 27.0, "")]
    title = "Gains over the sinusoid by UVLM, at several bounds on the accelerations"
    draw_pareto(args.out / "pareto.png", gains, paper, title)


def _best(settings: Any, args: Args) -> Candidate:
    from flaprig.tasks.hover import Hover

    judge = Judge(Hover(settings))
    evolution(judge, args.simulations, args.seed)
    assert judge.best is not None
    return judge.best


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code: 0 fine, 1 failed, 2 bad input, 130 stopped."""
    try:
        about = (__doc__ or "").splitlines()[0]
        args = parse(Args, "python -m training.baselines", argv, about, (FlagCreatePairsOff,))
        from training.records import opened_folder

        settings = {"algorithm": "baselines", **asdict(args), "out": None}
        with opened_folder(args.out, settings, resume=False):
            {"compare": compare, "sweep": sweep}[args.what](args)
    except EXPECTED as error:
        print(f"training.baselines: {sentence(error)}", file=sys.stderr)
        return exit_code(error)
    except KeyboardInterrupt:
        print("training.baselines: stopped", file=sys.stderr)
        return STOPPED
    return 0


if __name__ == "__main__":
    sys.exit(main())
