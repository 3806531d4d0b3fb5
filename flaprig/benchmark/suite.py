"""The benchmarks by name; a new one is one file and one line here."""

from __future__ import annotations

from flaprig import _checks as check
from flaprig.benchmark.batch import Batch
from flaprig.benchmark.benchmark import Benchmark
from flaprig.benchmark.dial import Dial
from flaprig.benchmark.growth import Growth
from flaprig.benchmark.kernel import Kernel
from flaprig.benchmark.learning import Learning
from flaprig.benchmark.peer import Peer
from flaprig.benchmark.shares import Shares
from flaprig.benchmark.start import Start
from flaprig.benchmark.twin import TwinSpeed
from flaprig.benchmark.window import Window

_BENCHMARKS: tuple[type[Benchmark], ...] = (
    Peer,
    Dial,
    Growth,
    Kernel,
    Window,
    TwinSpeed,
    Batch,
    Learning,
    Start,
    Shares,
)
# in the order of the page
BENCHMARKS: dict[str, type[Benchmark]] = {each.name: each for each in _BENCHMARKS}


def benchmark_named(name: str) -> type[Benchmark]:
    """The benchmark of that name. ValueError, with all names, when there is none."""
    if name not in BENCHMARKS:
        raise check.fail("bench", "NAME", f"one of {', '.join(BENCHMARKS)}", name)
    return BENCHMARKS[name]
