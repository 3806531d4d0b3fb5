"""The wake's own kernel: what a sheet's edges induce at points, and the machine's limit."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from flaprig import _checks as check
from flaprig.aero.air import Progress
from flaprig.benchmark.benchmark import left_out, usable
from flaprig.benchmark.outcome import Outcome, Row, row
from flaprig.benchmark.turns import Work, calls_for, many, repeated, seconds
from flaprig.native import _native

Array = NDArray[np.float64]

# operations of a straight vortex at a point when each is done on its own: both differences 6, their
# cross product 9, both squared lengths 10 and roots 2, dot product 5, square of the normal 5, core
# and quotients 8, three components 6. Ours shares the lengths of a vertex among its edges and so
# does fewer: a share of the peak by this count says how fast it is, not how busy
FLOPS = 51
# a ring alone has four sides; in a lattice its edges are two, the others being its neighbours'
SIDES = 4
# core radius in the sheet's spacing, and how far its vertices are off their places
CORE, ROUGH = 0.15, 0.2
GIGA = 1e-9
# what the project aims at on one thread: either is enough [1e9/s], [%]
SIDES_AIM, SHARE_AIM = 2.5, 55.0
NOTE = (
    "A ring alone has four straight vortices; in the sheet two rings share each, so a ring costs "
    f"two edges. The share counts {FLOPS} operations an edge, as if nothing were shared. The aim "
    f"is one of both: {SIDES_AIM:g}e9 ring sides per second, or {SHARE_AIM:g} % of the peak."
)


@dataclass(frozen=True)
class Kernel:
    """Velocities that a sheet as large as a wake induces at its own vertices.

    Attributes:
        rows: of rings.
        strips: rings in a row.
        threads: of the second number of threads; one is always measured.
        duration: of one measurement in [s].
        turns: of everything.
    """

    name: ClassVar[str] = "kernel"
    claim: ClassVar[str] = "interactions per second and the share of the machine's peak"

    rows: int = 300
    strips: int = 12
    threads: int = 2
    duration: float = 0.1
    turns: int = 7

    def run(self, progress: Progress | None = None) -> Outcome:
        """Measure. ValueError for a parameter out of range."""
        check.whole(self.name, "rows", self.rows, 1, 10_000)
        check.whole(self.name, "strips", self.strips, 1, 128)
        check.whole(self.name, "threads", self.threads, 1, 64)
        check.in_range(self.name, "duration", self.duration, 1e-4, 10.0, "s")
        check.whole(self.name, "turns", self.turns, 1, 1000)
        works = self._works()
        calls = {key: calls_for(work, self.duration) for key, work in works.items()}
        found = repeated(lambda: self._turn(works, calls), self.turns, progress)
        data = {"edges": self.edges, "points": self.points, "kernel": _native.kernel_name()}
        notes = (NOTE, f"Chosen at run time: {data['kernel']}.", *left_out((self.threads,)))
        return Outcome(tuple(self._table(found)), data, notes=notes)

    @property
    def points(self) -> int:
        """Vertices of the sheet."""
        return (self.rows + 1) * (self.strips + 1)

    @property
    def edges(self) -> int:
        """Straight vortices of the sheet."""
        return self.rows * (self.strips + 1) + (self.rows + 1) * self.strips

    def _works(self) -> dict[str, Work]:
        vertices, circulation = sheet(self.rows, self.strips)
        points = vertices.reshape(-1, 3).copy()
        velocity: Callable[..., object] = partial(
            _native.sheet_velocity, vertices, circulation, CORE, points
        )
        works: dict[str, Work] = {
            "single": partial(velocity, True, 1),
            "double": partial(velocity, False, 1),
        }
        if self.threads > 1 and usable((self.threads,)):
            works["more"] = partial(velocity, True, self.threads)
        return works

    def _turn(self, works: dict[str, Work], calls: dict[str, int]) -> dict[str, float]:
        """Edges per second of each work, and the machine's peaks [FLOP/s], close together."""
        pairs = self.edges * self.points
        found = {
            f"peak {name}": _native.fma_peak(name == "single") for name in ("single", "double")
        }
        for name, work in works.items():
            found[name] = pairs * calls[name] / seconds(many(work, calls[name]))
        return found

    def _table(self, found: dict[str, Array]) -> list[Row]:
        rows = [
            *self._rows("single", found, at_least=SIDES_AIM, share=SHARE_AIM),
            *self._rows("double", found),
        ]
        if "more" in found:
            words = f"single precision, {self.threads} threads"
            rows += [
                row(f"ring sides, {words}", self._sides(found["more"]), "1e9/s"),
                row(f"{words} over one", found["more"] / found["single"], "x"),
            ]
        return rows

    def _rows(
        self,
        kind: str,
        found: dict[str, Array],
        at_least: float | None = None,
        share: float | None = None,
    ) -> list[Row]:
        """Rates of one precision on one thread, and the aims of ring sides and share."""
        rate, peak = found[kind], found[f"peak {kind}"]
        words = f"{kind} precision, 1 thread"
        part = 100.0 * FLOPS * rate / peak
        return [
            row(f"edges, {words}", GIGA * rate, "1e9/s"),
            row(f"ring sides, {words}", self._sides(rate), "1e9/s", at_least=at_least),
            row(f"peak of multiply-adds, {words}", GIGA * peak, "GFLOP/s"),
            row(f"share of the peak, {words}", part, "%", at_least=share),
        ]

    def _sides(self, rate: Array) -> Array:
        """Billions of ring sides per second, from edges per second."""
        return GIGA * SIDES * self.rows * self.strips / self.edges * rate


def sheet(rows: int, strips: int) -> tuple[Array, Array]:
    """A rough sheet that swings to and fro as a wake does, and its circulation.

    Shapes (rows + 1, strips + 1, 3) and (rows, strips); vertices are about one apart.
    """
    rng = np.random.default_rng(0)
    along, across = np.arange(rows + 1.0)[:, None], np.arange(strips + 1.0)[None, :]
    swing = 0.02 * rows * np.sin(2.0 * np.pi * along / max(rows / 3, 1))
    places = np.stack(np.broadcast_arrays(swing, across, along), axis=-1)
    rough = ROUGH * rng.standard_normal((rows + 1, strips + 1, 3))
    return places + rough, rng.standard_normal((rows, strips))
