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
from flaprig.commands.progress import progress
from flaprig.commands.run_output import timed
from flaprig.commands.suites import docs, one_alone, with_parameters
from flaprig.report.benchmark_page import page
from flaprig.report.benchmark_table import print_machine, print_outcome
from flaprig.report.folder import Folder
from flaprig.report.numbers import as_json

# where the page goes inside of its folder
PAGE, PICTURES = "benchmarks.md", "images/benchmarks"

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
        folder.path = docs("bench")
    return _run(chosen, args.json, folder, everything=args.all)


def _run(
    chosen: Sequence[Benchmark], as_object: bool, folder: Folder, everything: bool = False
) -> None:
    folder.create()
    if folder and everything:
        assert folder.path is not None
        (folder.path / PICTURES).mkdir(parents=True, exist_ok=True)
    console, found, here = Console(), [], machine()
    for benchmark in chosen:
        with timed() as spent, progress(benchmark.name) as told:
            outcome = benchmark.run(told)
        found.append((benchmark, outcome, spent["wall_time_s"]))
        if outcome.draw is not None:
            place = f"{PICTURES}/{benchmark.name}.png" if everything else f"{benchmark.name}.png"
            folder.write(place, outcome.draw)
        if not as_object:
            if len(found) == 1:
                print_machine(console, here)
            print_outcome(console, benchmark, outcome, spent["wall_time_s"])
    summary = _summary(here, found)
    if folder and everything:
        folder.write_text(PAGE, page(here, found, PICTURES))
    elif folder:
        folder.write_text("summary.json", as_json(summary) + "\n")
    if as_object:
        print(as_json(summary))
    elif folder:
        written = ", ".join(path.name for path in folder.written)
        console.print(f"Written to {folder.path}: {written}", highlight=False, markup=False)


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
