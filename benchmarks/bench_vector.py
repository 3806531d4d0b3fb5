"""Strokes and rig steps per second through SB3's vector environment, and through the batch in it.

Run: python benchmarks/bench_vector.py [--json]

Both take the same actions in turns within one run; the batch alone is `flaprig bench learning`.
"""

from __future__ import annotations

import json
import sys
from functools import partial

from flaprig.benchmark.learning import Setup, begun, setups
from flaprig.benchmark.outcome import Row, row
from flaprig.benchmark.turns import Work, in_turn, many
from flaprig.report.benchmark_table import number
from training.vector import HoverVecEnv

# episodes of the cheapest setup, of all others, actions of the cheapest in a turn, and turns
ENVS, RIGS, ACTIONS, TURNS = 64, 16, 8, 5


def environment(setup: Setup) -> Work:
    """One measurement of the environment."""
    env = HoverVecEnv(setup.settings, setup.count, seed=0)
    env.reset()
    env.step(setup.still)
    return many(partial(env.step, setup.still), setup.actions)


def measure(envs: int = ENVS, rigs: int = RIGS, turns: int = TURNS) -> list[Row]:
    """Rates of the environment, and its share of what the batch alone does."""
    listed = setups(envs, rigs, ACTIONS)
    works: dict[tuple[str, str], Work] = {}
    for setup in listed:
        works[setup.name, "batch"] = begun(setup)
        works[setup.name, "environment"] = environment(setup)
    taken = in_turn(works, turns)
    rows = []
    for setup in listed:
        batch, env = (taken[setup.name, kind] for kind in ("batch", "environment"))
        rows += setup.rows(env)
        rows.append(row(f"share of the batch alone, {setup.name}", 100.0 * batch / env, "%"))
    return rows


def main() -> None:
    """Measure and print."""
    rows = measure()
    if "--json" in sys.argv[1:]:
        command = "python benchmarks/bench_vector.py"
        print(json.dumps({"rows": [each.summary(command) for each in rows]}))
        return
    for each in rows:
        print(f"{each.quantity}: {number(each.value)} {each.unit}")


if __name__ == "__main__":
    main()
