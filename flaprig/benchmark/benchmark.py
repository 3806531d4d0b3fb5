"""The protocol of a benchmark: frozen parameters, and one function that measures."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable
from dataclasses import fields
from typing import Any, ClassVar, Protocol

from flaprig.aero.air import Progress
from flaprig.benchmark.outcome import Outcome
from flaprig.strokes import SunTangStroke

# the rig's sinusoid (paper, section 2.2)
STROKE = SunTangStroke(0.2, math.pi / 3, math.pi / 4)


class Benchmark(Protocol):
    """A benchmark. Its fields are its parameters, in SI units.

    Attributes:
        name: on the command line.
        claim: what is measured, as half a sentence.
    """

    name: ClassVar[str]
    claim: ClassVar[str]

    def run(self, progress: Progress | None = None) -> Outcome:
        """Measure.

        Raises:
            ValueError: a parameter out of range.
        """
        ...


def command_of(benchmark: Benchmark) -> str:
    """What to type for this benchmark with these parameters."""
    options = fields(benchmark)  # type: ignore[arg-type]  # every benchmark is a dataclass
    changed = [f for f in options if getattr(benchmark, f.name) != f.default]
    words = [f"--{f.name.replace('_', '-')} {_word(getattr(benchmark, f.name))}" for f in changed]
    return " ".join(["flaprig bench", benchmark.name, *words]).rstrip()


def _word(value: Any) -> str:
    return " ".join(map(str, value)) if isinstance(value, tuple) else str(value)


def cores() -> int:
    """Cores of this machine."""
    return os.cpu_count() or 1


def usable(threads: Iterable[int]) -> tuple[int, ...]:
    """Those numbers of threads for which there are cores."""
    return tuple(number for number in threads if number <= cores())


def left_out(threads: Iterable[int]) -> tuple[str, ...]:
    """A sentence for each of the others."""
    more = [number for number in threads if number > cores()]
    return tuple(f"{n} threads are left out: this machine has fewer cores." for n in more)
