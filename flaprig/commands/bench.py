"""`flaprig bench`: how fast it is, beside the peer, the machine's limit and the project's aims."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

from rich.console import Console
from tyro.conf import Positional, arg

from flaprig import _checks as check
from flaprig.benchmark.benchmark import Benchmark, command_of
from flaprig.benchmark.machine import machine
from flaprig.benchmark.outcome import Outcome
from flaprig.benchmark.suite import BENCHMARKS, benchmark_named
from flaprig.commands.suites import Page, docs, hand_out, one_alone, run_each, with_parameters
from flaprig.report.benchmark_page import page
from flaprig.report.benchmark_table import print_machine, print_outcome
from flaprig.report.folder import Folder

PAGE = Page("benchmarks.md", "images/benchmarks")

_OUT = arg(metavar="DIR", help_behavior_hint="(optional)")


@dataclass(frozen=True)
class Bench:
    """Measure how fast flaprig is on this machine, in some minutes.

    Benchmarks: peer, dial, growth, kernel, window, twin, batch, learning, start, shares; without a
    name all of them run. One name alone takes the benchmark's own options: `flaprig bench peer
    --help` shows them. What is compared runs in turns; a number is the median of its turns. No
    speed is wrong: the exit status is 0 whether the project's aims are reached or not.

    Attributes:
        name: names of benchmarks.
        all: every benchmark; writes the page benchmarks.md with its pictures into --out, or into
            docs/ of a clone.
        json: print exactly one JSON object and nothing else.
        out: folder for a picture per benchmark and summary.json.
    """

    name: Positional[tuple[str, ...]] = ()
    all: bool = False
    json: bool = False
    out: Annotated[Path | None, _OUT] = None


@dataclass(frozen=True)
class OneBenchmark:
    """One benchmark with its own options.

    Attributes:
        json: print exactly one JSON object and nothing else.
        out: folder for its picture and summary.json.
    """

    json: bool = False
    out: Annotated[Path | None, _OUT] = None

    @property
    def chosen(self) -> Benchmark:
        """The benchmark with its parameters."""
        return getattr(self, "parameters")  # noqa: B009  # the field of the subclass


def parse(words: Sequence[str], ask: Callable[[type, str, list[str]], Any]) -> Any:
    """Bench, or OneBenchmark where one name comes first and no other.

    Args:
        words: after `bench`.
        ask: reads arguments into a type: type, program, words.

    Raises:
        ValueError: wrong arguments.
    """
    name = one_alone(words)
    if name is None:
        return ask(Bench, "flaprig bench", list(words))
    kind = with_parameters(benchmark_named(name), OneBenchmark)
    return ask(kind, f"flaprig bench {name}", list(words[1:]))


def run(args: Bench | OneBenchmark, folder: Folder) -> None:
    """Run the benchmarks, write, tell.

    Raises:
        ValueError: bad input.
        RuntimeError: a fresh process failed.
        OSError: a file cannot be written.
    """
    if isinstance(args, OneBenchmark):
        return _run([args.chosen], args.json, folder)
    if args.all and args.name:
        raise check.fail("bench", "--all", "given without names", " ".join(args.name))
    chosen = [benchmark_named(name)() for name in dict.fromkeys(args.name) or BENCHMARKS]
    if args.all and not folder:
        folder.share(docs("bench"))
    return _run(chosen, args.json, folder, PAGE if args.all else None)


def _run(
    chosen: Sequence[Benchmark], as_object: bool, folder: Folder, whole: Page | None = None
) -> None:
    console, here = Console(), machine()

    def show(benchmark: Benchmark, outcome: Outcome, seconds: float) -> None:
        if as_object:
            return
        if benchmark is chosen[0]:
            print_machine(console, here)
        print_outcome(console, benchmark, outcome, seconds)

    found = run_each(chosen, folder, whole, show)
    text = page(here, found, whole.pictures) if whole else ""
    hand_out(folder, _summary(here, found), as_object, whole, text)


def _summary(
    here: dict[str, Any], found: Sequence[tuple[Benchmark, Outcome, float]]
) -> dict[str, Any]:
    parts = [
        {
            "benchmark": benchmark.name,
            "command": command_of(benchmark),
            **outcome.data,
            "rows": [row.summary(command_of(benchmark)) for row in outcome.rows],
            "notes": list(outcome.notes),
            "wall_time_s": spent,
        }
        for benchmark, outcome, spent in found
    ]
    return {"command": "bench", "machine": here, "benchmarks": parts}
