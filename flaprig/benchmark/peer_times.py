"""Seconds of the peer and of ours on the same number of threads: as rows and as bars."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from flaprig.benchmark.outcome import Row, row
from flaprig.report import style

THEIRS = "Ptera Software"
# what of ours stands beside the peer: the wake as it was shed, and aged rows merged
BRUTE, DIAL = "brute force", "default dial"
# what the project aims at on one thread: the peer's time over ours
AIMS = {BRUTE: 30.0, DIAL: 60.0}


def _empty() -> dict[str, list[float]]:
    return {kind: [] for kind in AIMS}


@dataclass
class Times:
    """Seconds on one number of threads.

    Attributes:
        peer: of the peer, one a turn; none where it is not installed.
        busy: how many cores the peer kept busy.
        ours: of both kinds of ours, all turns.
        ratios: of the peer's time over each of ours in the same turn.
    """

    peer: list[float] = field(default_factory=list)
    busy: list[float] = field(default_factory=list)
    ours: dict[str, list[float]] = field(default_factory=_empty)
    ratios: dict[str, list[float]] = field(default_factory=_empty)

    def add(self, peer: list[tuple[float, float]], ours: Mapping[str, list[float]]) -> None:
        """Another turn: the peer's time and busy cores, if there are, and all of ours about it."""
        self.peer += [wall for wall, _ in peer]
        self.busy += [cores for _, cores in peer]
        for kind in AIMS:
            self.ours[kind] += ours[kind]
            self.ratios[kind] += [wall / own for wall, _ in peer for own in ours[kind]]


def time_rows(times: Mapping[int, Times]) -> list[Row]:
    """Seconds and ratios, by number of threads."""
    rows = []
    for threads, found in times.items():
        words = _words(threads)
        if found.peer:
            rows.append(row(f"{THEIRS}, {words}", found.peer, "s"))
            rows.append(row(f"{THEIRS}, {words}, busy", found.busy, "cores"))
        for kind, aim in AIMS.items():
            rows.append(row(f"{kind}, {words}", found.ours[kind], "s"))
            if found.peer:
                least = {"at_least": aim} if threads == 1 else {}
                name = f"{THEIRS} over {kind}, {words}"
                rows.append(row(name, found.ratios[kind], "x", **least))
    return rows


def _words(threads: int) -> str:
    return "1 thread" if threads == 1 else f"{threads} threads"


def draw(path: Path, times: Mapping[int, Times], title: str) -> None:
    """Seconds on a logarithmic scale."""
    colours = {THEIRS: style.INK, BRUTE: style.BLUE, DIAL: style.VERMILION}
    marks = [
        (f"{who}, {_words(threads)}", float(np.median(taken)), colours[who])
        for threads, found in times.items()
        for who, taken in {THEIRS: found.peer, **found.ours}.items()
        if taken
    ]
    with style.figure(6.2, 1.0 + 0.35 * len(marks)) as drawing:
        axes = drawing.subplots()
        for place, (_, value, colour) in enumerate(marks):
            axes.plot(value, place, "o", ms=8, color=colour)
            axes.text(1.15 * value, place, f"{value:.3g} s", va="center")
        axes.set(xscale="log", xlabel="wall time [s]", title=title)
        axes.set_yticks(range(len(marks)), labels=[words for words, _, _ in marks])
        axes.tick_params(axis="x", which="minor", labelbottom=False)
        # whole decades, and room for the last number
        values = np.log10([value for _, value, _ in marks])
        axes.set_xlim(10.0 ** np.floor(values.min()), 10.0 ** np.ceil(values.max() + 0.3))
        axes.margins(y=0.15)
        axes.invert_yaxis()
        style.save(drawing, path)
