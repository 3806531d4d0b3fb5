"""From a record to a stroke: the period, the periodic part, the series, and every doubt."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import degrees

import numpy as np
from numpy.typing import NDArray

from flaprig.logs import period as periods
from flaprig.logs.doubts import doubts_of, shift_of
from flaprig.logs.exact import exact_stroke
from flaprig.logs.motion import (
    JOINTS,
    Periodic,
    degrees_of,
    ends_of,
    moving_part,
    noise_of,
    periodic,
)
from flaprig.logs.numbers import lines_named
from flaprig.logs.record import Record
from flaprig.strokes.fourier import FourierStroke
from flaprig.strokes.sampled import SampledStroke

Array = NDArray[np.float64]

# a frequency that is given may move the last cycle by this much, in cycles, without a word and
# with one; beyond that it is refused
_DRIFT_TOLD, _DRIFT = 0.01, 0.05
# a ratio of periods is a whole number within this
_WHOLE = 0.02
# a record that moves for more than this share of its length has no rest at its ends
_ALL_MOVES = 0.97
# cycles that differ by this share of the joint's half range are told, are refused
_DIFFER_TOLD, _DIFFER = 0.02, 0.3
# strays in the middle of the motion that are told; beyond this share it is not periodic
_STRAYS = 0.2
# cycles from which on starts and stops can be told from the motion
_SEVERAL = 1.5
# range of an angle that is no motion [rad], and over the noise of the samples
_STILL, _STILL_NOISE = 0.02, 12.0
# least samples in a cycle
_LEAST_SAMPLES = 8


@dataclass(frozen=True, eq=False)
class Made:
    """A stroke and what it was made from.

    Attributes:
        stroke: the motion.
        record: the samples that were used, with all notices.
        words: how the stroke was fitted, as a sentence; empty where the samples are exact.
        cycles: that these cover.
        harmonics: of both fits; zero where the samples are exact.
        residual_rms: samples minus stroke, of both joints, in [rad].
    """

    stroke: FourierStroke | SampledStroke
    record: Record
    words: str
    cycles: float
    harmonics: tuple[int, int]
    residual_rms: tuple[float, float]


def make_stroke(record: Record, frequency: float | None, center: bool) -> Made:
    """The stroke in a record.

    Args:
        record: cleaned, in the order of time.
        frequency: in [Hz]; None: found.
        center: shift both angles to the middle of their range.

    Raises:
        ValueError: no period, another one than is given, or cycles that differ.
    """
    _require_motion(record)
    record, period = _with_period(record, frequency)
    step = float(np.median(np.diff(record.time)))
    if period / step < _LEAST_SAMPLES - 0.5:
        raise ValueError(
            f"a log must have {_LEAST_SAMPLES} samples in a cycle, got {period / step:.3g}"
        )
    length = float(record.time[-1] - record.time[0])
    # one cycle has nothing beside it that would tell a start from the motion
    several = length > _SEVERAL * period
    found = periodic(record.time, (record.sweep, record.pitch), 1.0 / period, ends=several)
    if frequency is None and several and not found.kept.all():
        # what was left out has pulled at the period, too
        part = record.part(found.kept)
        period = periods.refined(part.time, (part.sweep, part.pitch), period)
        found = periodic(record.time, (record.sweep, record.pitch), 1.0 / period)
    record = _kept(record, found)
    _require_like_cycles(record, found, period)
    notices = list(record.notices) + _told_scatter(record, found)

    exact = exact_stroke(record.time, (record.sweep, record.pitch), period, found.fits)
    stroke: FourierStroke | SampledStroke = _series(found, 1.0 / period) if exact is None else exact
    cycles = (record.time[-1] - record.time[0] + step) / period
    words = "" if exact else _fit_words(record, found, cycles)
    if center:
        stroke, said = shift_of(stroke)
        notices.append(said)
    notices += doubts_of(stroke)
    return Made(
        stroke=stroke,
        record=replace(record, notices=tuple(notices)),
        words=words,
        cycles=float(cycles),
        harmonics=(0, 0) if exact else (found.fits[0].harmonics, found.fits[1].harmonics),
        residual_rms=(0.0, 0.0)
        if exact
        else (found.fits[0].residual_rms, found.fits[1].residual_rms),
    )


def _with_period(record: Record, frequency: float | None) -> tuple[Record, float]:
    """The period in [s], and the record without the rest around the motion."""
    moving = moving_part((record.sweep, record.pitch))
    whole = record.time[-1] - record.time[0]
    part = record.part(moving)
    rests = part.time[-1] - part.time[0] < _ALL_MOVES * whole
    tried = [part, record] if rests else [record]
    if frequency is not None:
        found = next(filter(None, (_repeats(r) for r in tried)), None)
        _require_frequency(tried[0], frequency, found)
        return _noted(tried[0], record, frequency, found), 1.0 / frequency
    for each in tried:
        found = _repeats(each) or periods.one_cycle(each.time, (each.sweep, each.pitch))
        if found is not None:
            return _noted(each, record, None, found), found
    raise ValueError(_not_periodic(record))


def _require_motion(record: Record) -> None:
    """Refuse a record in which both joints stand still."""
    spans = [float(np.ptp(angle)) for angle in (record.sweep, record.pitch)]
    noise = [noise_of(angle) for angle in (record.sweep, record.pitch)]
    most = [min(_STILL, max(_STILL_NOISE * n, 1e-12)) for n in noise]
    if spans[0] < most[0] and spans[1] < most[1]:
        raise ValueError(
            f"nothing moves: sweep stays within {degrees_of(spans[0])} and pitch within "
            f"{degrees_of(spans[1])}"
        )


def _repeats(record: Record) -> float | None:
    return periods.repeats(record.time, (record.sweep, record.pitch))


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


def _kept(record: Record, found: Periodic) -> Record:
    """The samples that the series went through, with words on the others."""
    first, last = ends_of(found.kept)
    notices = list(record.notices)
    if first > 0 or last < found.kept.size:
        before = record.time[first] - record.time[0]
        after = record.time[-1] - record.time[last - 1]
        notices.append(
            f"a start of {before:.3g} s and a stop of {after:.3g} s that the other cycles do not "
            f"have were cut (lines {record.lines[first]} to {record.lines[last - 1]} are used)"
        )
    strays = np.flatnonzero(~found.kept[first:last]) + first
    if strays.size:
        notices.append(
            f"{lines_named(record.lines[strays].tolist())}: {_worst(record, found, strays)}; "
            "left out as strays"
        )
    if strays.size > _STRAYS * (last - first):
        raise ValueError(
            f"the motion is not periodic: {strays.size} of {last - first} samples are far from "
            f"what repeats ({_worst(record, found, strays)})"
        )
    return replace(record, notices=tuple(notices)).part(found.kept)


def _worst(record: Record, found: Periodic, rows: NDArray[np.int64]) -> str:
    """The largest distance of some samples from the series, as words."""
    apart = [
        np.abs(getattr(record, joint)[rows] - series(record.time[rows]))
        for joint, series in zip(JOINTS, found.fits, strict=True)
    ]
    joint = int(np.argmax([part.max() for part in apart]))
    far = degrees_of(float(apart[joint].max()))
    return f"{JOINTS[joint]} is up to {far} off the periodic motion"


def _require_like_cycles(record: Record, found: Periodic, period: float) -> None:
    for joint, scatter in zip(JOINTS, found.scatter, strict=True):
        half = 0.5 * float(np.ptp(getattr(record, joint)))
        if scatter > _DIFFER * half and half > 0.02:
            raise ValueError(
                f"the motion is not periodic: at the best period of {period:.4g} s cycles differ "
                f"from their mean by {degrees_of(scatter)} in {joint}"
            )


def _told_scatter(record: Record, found: Periodic) -> list[str]:
    said = []
    for joint, scatter in zip(JOINTS, found.scatter, strict=True):
        half = 0.5 * float(np.ptp(getattr(record, joint)))
        if scatter > max(_DIFFER_TOLD * half, 0.005):
            said.append(
                f"single cycles differ from their mean by up to {degrees_of(scatter)} in {joint}"
            )
    return said


def _series(found: Periodic, frequency: float) -> FourierStroke:
    sweep, pitch = found.fits
    return FourierStroke(
        frequency=frequency,
        sweep_cos=tuple(sweep.cos.tolist()),
        sweep_sin=tuple(sweep.sin.tolist()),
        pitch_cos=tuple(pitch.cos.tolist()),
        pitch_sin=tuple(pitch.sin.tolist()),
        sweep_mean=sweep.mean,
        pitch_mean=pitch.mean,
    )


def _fit_words(record: Record, found: Periodic, cycles: float) -> str:
    parts = [
        f"{series.harmonics} harmonic{'s' * (series.harmonics > 1)} of the {joint} (residual "
        f"{degrees_of(series.residual_rms)} rms)"
        for joint, series in zip(JOINTS, found.fits, strict=True)
    ]
    return (
        f"the stroke is a least-squares fit to {record.time.size} samples of {cycles:.3g} cycles "
        f"at {found.fits[0].frequency:.6g} Hz: {' and '.join(parts)}"
    )
