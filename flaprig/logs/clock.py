"""A log's clock: stamps in any unit, repeated, out of order or begun anew, as times that rise."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from flaprig.logs.numbers import lines_named
from flaprig.logs.units import TIME_UNITS

Array = NDArray[np.float64]
Index = NDArray[np.int64]

# seconds since 1970 are below this until the year 5138; larger ones are in a smaller unit
_MOST_SECONDS = 1e11
# the unit of a stamp since 1970, by its least size as a number
_STAMPS = ((1e17, "ns"), (1e14, "us"), (_MOST_SECONDS, "ms"))
# a step back of no more than so many usual steps is a row out of order; a longer one is a clock
# that was set or began anew
_OUT_OF_ORDER = 5.0
# a step of so many usual ones is a gap
GAP = 5.0


@dataclass(frozen=True, eq=False)
class Clock:
    """Times of the rows that can be used.

    Attributes:
        time: in [s], rising. Shape (n,).
        rows: indices of the rows that these times belong to. Shape (n,).
        notices: what was changed.
    """

    time: Array
    rows: Index
    notices: tuple[str, ...]


def in_seconds(values: Array, unit: str, name: str, line: int) -> tuple[Array, tuple[str, ...]]:
    """Stamps in [s], in the unit that the header says unless they cannot be that.

    Args:
        values: numbers of the column. Shape (n,).
        unit: of the header; empty: none.
        name: of the column.
        line: of the first row.

    Raises:
        ValueError: a unit that is none of time.
    """
    if unit and unit not in TIME_UNITS:
        raise ValueError(f"{name}: the unit of time must be s, ms, us or ns, got {unit!r}")
    usual = float(np.nanmedian(np.abs(values)))
    meant = next((word for least, word in _STAMPS if usual >= least), None)
    if meant is not None and TIME_UNITS.get(unit, 1.0) == 1.0:
        words = f"the number {values[0]:.6g} cannot be seconds"
        return values * TIME_UNITS[meant], (
            f"line {line}: {name}: {words}; stamps since 1970 were read as {meant}",
        )
    if not unit:
        return values, (f"{name} has no unit: it was read as seconds",)
    return values * TIME_UNITS[unit], ()


def rising(time: Array, name: str, lines: Index) -> Clock:
    """The rows in the order of time, every instant once.

    A few rows out of order are sorted. Where the clock begins anew, the longest part is kept.
    Repeated stamps, as a clock of coarse steps gives them, are spread until the next one.

    Args:
        time: stamps in [s]. Shape (n,).
        name: of the column.
        lines: of the rows in the file. Shape (n,).
    """
    notices: list[str] = []
    steps = np.diff(time)
    usual = float(np.median(steps[steps > 0.0])) if np.any(steps > 0.0) else 0.0
    rows, said = _without_stray_stamps(time, usual, name, lines)
    notices += said

    breaks = np.flatnonzero(np.diff(time[rows]) < -_OUT_OF_ORDER * usual) + 1
    if breaks.size:
        edges = [0, *breaks.tolist(), rows.size]
        longest = int(np.argmax(np.diff(edges)))
        first, last = rows[edges[longest]], rows[edges[longest + 1] - 1]
        before, after = time[rows[breaks[0] - 1]], time[rows[breaks[0]]]
        notices.append(
            f"{lines_named(lines[rows[breaks]])}: {name} falls (from {before:.6g} to {after:.6g} s "
            f"first), so the clock was set anew there; only lines {lines[first]} to {lines[last]} "
            "are used"
        )
        rows = rows[edges[longest] : edges[longest + 1]]
    back = rows[1:][np.diff(time[rows]) < 0.0]
    if back.size:
        notices.append(
            f"{lines_named(lines[back])}: {name} goes back (from {time[back[0] - 1]:.6g} to "
            f"{time[back[0]]:.6g} s first); these rows were put in their place"
        )
        rows = rows[np.argsort(time[rows], kind="stable")]
    spread, repeated = _spread(time[rows], usual)
    if repeated.size:
        notices.append(
            f"{lines_named(lines[rows[repeated]])}: {name} repeats the stamp before it; stamps "
            "that repeat were spread evenly until the next one"
        )
    notices += _gaps(spread, usual, name, lines[rows])
    return Clock(spread, rows, tuple(notices))


def _without_stray_stamps(
    time: Array, usual: float, name: str, lines: Index
) -> tuple[Index, list[str]]:
    """Rows without single stamps that lie far outside of their neighbours'."""
    before, own, after = time[:-2], time[1:-1], time[2:]
    # ahead of the next one by a step is a neighbour of a clock that is set back
    stray = (before <= after) & ((own < before) | (own > after + _OUT_OF_ORDER * usual))
    places = np.flatnonzero(stray) + 1
    rows = np.delete(np.arange(time.size), places)
    if not places.size:
        return rows, []
    where = lines_named(lines[places])
    first = f"(first {time[places[0]]:.6g} s)"
    return rows, [f"{where}: {name} is not between its neighbours' {first}; left out"]


def _spread(time: Array, usual: float) -> tuple[Array, Index]:
    """Repeated stamps shared out until the next one, and the places that repeat one."""
    same = np.diff(time) <= 0.0
    repeated = np.flatnonzero(same) + 1
    if not repeated.size:
        return time, repeated
    # first place of each stamp; each block lasts until the next block begins, or, where a gap
    # follows, as long as blocks do in general
    first = np.flatnonzero(np.concatenate([[True], ~same]))
    count = np.diff(np.append(first, time.size))
    length = np.diff(time[first], append=time[-1] + usual)
    inner = slice(1, -1) if first.size > 2 else slice(None)
    step = float(np.median(length[inner] / count[inner]))
    # a block that a gap follows, or the end, is as dense as the others
    share = np.where(length <= 2.0 * np.median(length), length / count, step)
    share[-1] = step
    place = np.arange(time.size) - np.repeat(first, count)
    spread = time + np.repeat(share, count) * place
    if first.size > 1 and count[0] * step < length[0]:
        # the log began within the first block: its rows lie at the block's end
        spread[: count[0]] = time[first[1]] - step * np.arange(count[0], 0, -1)
    return spread, repeated


def _gaps(time: Array, usual: float, name: str, lines: Index) -> list[str]:
    steps = np.diff(time)
    step = float(np.median(steps)) if steps.size else usual
    holes = np.flatnonzero(steps > max(GAP * step, step + 1e-12))
    if not holes.size:
        return []
    k = int(holes[np.argmax(steps[holes])])
    more = f", the longest of {holes.size} gaps" if holes.size > 1 else ""
    return [
        f"line {lines[k + 1]}: {steps[k]:.3g} s are missing before it ({step:.3g} s are usual"
        f"{more}); the cycle was found from the other samples"
    ]
