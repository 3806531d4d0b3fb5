"""How often a record repeats: found from it, or given and then checked against it."""

from __future__ import annotations

from dataclasses import replace
from math import degrees

import numpy as np

from flaprig.logs import period as periods
from flaprig.logs.motion import degrees_of, moving_part, periodic
from flaprig.logs.record import Record

# a frequency that is given may move the last cycle by this much, in cycles, without a word and
# with one; beyond that it is refused
_DRIFT_TOLD, _DRIFT = 0.01, 0.05
# a ratio of periods is a whole number within this
_WHOLE = 0.02
# a record that moves for more than this share of its length has no rest at its ends
_ALL_MOVES = 0.97


def with_period(record: Record, frequency: float | None) -> tuple[Record, float, slice]:
    """The record without the rest around the motion, its period in [s], and what repeats in it.

    Args:
        record: cleaned, in the order of time.
        frequency: in [Hz]; None: found.

    Raises:
        ValueError: the motion is not periodic, or has another frequency than is given.
    """
    moving = moving_part((record.sweep, record.pitch))
    whole = record.time[-1] - record.time[0]
    part = record.part(moving)
    rests = part.time[-1] - part.time[0] < _ALL_MOVES * whole
    tried = [part, record] if rests else [record]
    for each in tried:
        repeated = _repeats(each)
        if repeated is None:
            continue
        found, rows = repeated
        if frequency is not None:
            _require_frequency(each, frequency, found)
            return _noted(each, record, frequency, found), 1.0 / frequency, rows
        return _noted(each, record, None, found), found, rows
    if frequency is not None:
        _require_frequency(tried[0], frequency, None)
        return _noted(tried[0], record, frequency, None), 1.0 / frequency, slice(None)
    for each in tried:
        single = periods.one_cycle(each.time, (each.sweep, each.pitch))
        if single is not None:
            return _noted(each, record, None, single), single, slice(None)
    raise ValueError(_not_periodic(record))


def _repeats(record: Record) -> tuple[float, slice] | None:
    """The period and the part that repeats: all, or all but what may be a start or a stop."""
    third = record.time.size // 3
    for rows in (slice(None), slice(third, None), slice(None, 2 * third)):
        part = record.part(rows)
        found = periods.repeats(part.time, (part.sweep, part.pitch))
        if found is not None:
            return found, rows
    return None


def _noted(part: Record, whole: Record, frequency: float | None, found: float | None) -> Record:
    """The part, with words on what was cut and on a frequency that is nearly right."""
    notices = list(part.notices)
    if part.time.size < whole.time.size:
        before, after = part.time[0] - whole.time[0], whole.time[-1] - part.time[-1]
        notices.append(
            f"rest was cut: {before:.3g} s before and {after:.3g} s after the motion (lines "
            f"{part.lines[0]} to {part.lines[-1]} are used)"
        )
    if frequency is not None and found is not None:
        drift = abs(frequency - 1.0 / found) * (part.time[-1] - part.time[0])
        if drift > _DRIFT_TOLD:
            notices.append(
                f"at {frequency:.6g} Hz the cycles drift by {drift:.2g} of a cycle over the log; "
                f"the best frequency is {1.0 / found:.6g} Hz"
            )
    return replace(part, notices=tuple(notices))


def _require_frequency(record: Record, frequency: float, found: float | None) -> None:
    """Refuse a frequency that the samples do not have."""
    period, length = 1.0 / frequency, float(record.time[-1] - record.time[0])
    best = "" if found is None else f"; the best period is {found:.4g} s ({1.0 / found:.6g} Hz)"
    if period > length + periods.STEPS_SHORT * float(np.median(np.diff(record.time))):
        raise ValueError(
            f"a log must cover one whole cycle of {period:.6g} s, got {length:.6g} s{best}"
        )
    if found is None:
        return
    times = period / found
    if round(times) >= 2 and abs(times - round(times)) < _WHOLE * round(times):
        raise ValueError(
            f"at {frequency:.6g} Hz every cycle holds the motion {round(times)} times{best}"
        )
    if abs(frequency - 1.0 / found) * length > _DRIFT:
        worst = _difference(record, frequency)
        raise ValueError(
            f"at {frequency:.6g} Hz the cycles differ from their mean by {worst}{best}"
        )


def _difference(record: Record, frequency: float) -> str:
    """How far single cycles are from the mean of all, as words."""
    angles = (record.sweep, record.pitch)
    spread = [
        float(np.percentile(np.abs(angle - series(record.time)), 98.0))
        for angle, series in zip(
            angles, periodic(record.time, angles, frequency, trim=False).fits, strict=True
        )
    ]
    return f"up to {degrees(max(spread)):.3g} deg"


def _not_periodic(record: Record) -> str:
    ends = [
        f"{joint} ends {degrees_of(abs(float(angle[-1] - angle[0])))} from where it begins"
        for joint, angle in (("sweep", record.sweep), ("pitch", record.pitch))
    ]
    return (
        "the motion is not periodic: nothing in it repeats, and it is not one whole cycle, since "
        f"{' and '.join(ends)} (half a cycle? a step? a log must cover one whole cycle or several)"
    )
