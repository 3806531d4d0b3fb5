"""The page docs/benchmarks.md: the machine, the aims, and every number with its command."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from flaprig.benchmark.benchmark import Benchmark, command_of
from flaprig.benchmark.outcome import Outcome, Row
from flaprig.report.benchmark_table import cells

Found = Sequence[tuple[Benchmark, Outcome, float]]

HEAD = """# Benchmarks

How fast flaprig is: beside another vortex lattice code in the same run, beside the machine's own
limit, and beside what the project aims at. Made by

```sh
make bench                 # this page, with the peer (extra `bench`) installed
flaprig bench --all        # the same; without the peer its numbers are left out
flaprig bench NAME --help  # one benchmark, with parameters of its own
```

What is compared runs in turns, one after the other within one process: the machine is shared and
its speed drifts. A number is the median of its turns, beside it the smallest and the largest. A
ratio is taken turn by turn. No test asserts a speed.
"""
HEADER = "| quantity | median | turns | unit | aim | reached | command |"
RULE = "|---|---|---|---|---|---|---|"
REACHED = {True: "yes", False: "**no**", None: ""}


def page(here: Mapping[str, Any], found: Found, pictures: str) -> str:
    """The page as Markdown.

    Args:
        here: the machine.
        found: benchmarks, what they found, and the seconds they took.
        pictures: folder of the pictures, beside the page.
    """
    sections = (_section(*part, pictures) for part in found)
    return "\n".join([HEAD, _machine(here, found), _aims(found), *sections])


def _machine(here: Mapping[str, Any], found: Found) -> str:
    seconds = sum(part[2] for part in found)
    lines = ["| machine | |", "|---|---|"]
    lines += [f"| {name.replace('_', ' ')} | {value} |" for name, value in here.items()]
    return "\n".join([*lines, f"\nTook {seconds / 60.0:.1f} minutes.\n"])


def _aims(found: Found) -> str:
    """The rows with an aim once more, in one place."""
    lines = [f"## What the project aims at\n\n{HEADER}\n{RULE}"]
    for benchmark, outcome, _ in found:
        command = command_of(benchmark)
        aimed = (row for row in outcome.rows if row.reached is not None)
        lines += [_row(row, command, f"[{benchmark.name}](#{benchmark.name}): ") for row in aimed]
    return "\n".join([*lines, ""])


def _section(benchmark: Benchmark, outcome: Outcome, seconds: float, pictures: str) -> str:
    command = command_of(benchmark)
    lines = [f"## {benchmark.name}\n", f"{_first_sentence(benchmark)}\n"]
    if outcome.rows:
        lines += [HEADER, RULE, *(_row(row, command) for row in outcome.rows), ""]
    lines += [f"{note}\n" for note in outcome.notes]
    if outcome.draw is not None:
        lines.append(f"![{benchmark.name}]({pictures}/{benchmark.name}.png)\n")
    lines.append(f"`{command}`, {seconds:.0f} s.\n")
    return "\n".join(lines)


def _row(row: Row, command: str, before: str = "") -> str:
    known = " | ".join(cells(row))
    made = row.command or command
    return f"| {before}{row.quantity} | {known} | {REACHED[row.reached]} | `{made}` |"


def _first_sentence(benchmark: Benchmark) -> str:
    return " ".join((type(benchmark).__doc__ or "").split("\n\n")[0].split())
