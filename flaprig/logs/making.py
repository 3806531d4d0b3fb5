"""From a record to a stroke: the period, the periodic part, the series, and every doubt."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from flaprig.logs import period as periods
from flaprig.logs.doubts import doubts_of, shift_of
from flaprig.logs.exact import exact_stroke
from flaprig.logs.frequency import with_period
from flaprig.logs.motion import (
    JOINTS,
    Periodic,
    degrees_of,
    ends_of,
    noise_of,
    periodic,
)
from flaprig.logs.numbers import lines_named
from flaprig.logs.record import Record
from flaprig.strokes.fourier import FourierStroke
from flaprig.strokes.sampled import SampledStroke

Array = NDArray[np.float64]

# cycles that differ by this share of the joint's half range are told, are refused
_DIFFER_TOLD, _DIFFER = 0.02, 0.3
# strays in the middle of the motion that are told; beyond this share it is not periodic
_STRAYS = 0.2
# cycles from which on starts and stops can be told from the motion
_SEVERAL = 1.5
# range of an angle that is no motion [rad], and over the noise of the samples
_STILL, _STILL_NOISE = 0.02, 12.0
# a frequency is that of exact samples within this share
_SAME_FREQUENCY = 1e-3
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
    if record.exact:
        return _as_it_is(record, frequency, center)
    _require_motion(record)
    record, period, repeated = with_period(record, frequency)
    step = float(np.median(np.diff(record.time)))
    if period / step < _LEAST_SAMPLES - 0.5:
        raise ValueError(
            f"a log must have {_LEAST_SAMPLES} samples in a cycle, got {period / step:.3g}"
        )
    length = float(record.time[-1] - record.time[0])
    # one cycle has nothing beside it that would tell a start from the motion
    several = length > _SEVERAL * period
    angles = (record.sweep, record.pitch)
    found = periodic(record.time, angles, 1.0 / period, ends=several, begin=repeated)
    if frequency is None and several and not found.kept.all():
        period, found = _without_strays(record, found, period, repeated)
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


def _without_strays(
    record: Record, found: Periodic, period: float, begin: slice
) -> tuple[float, Periodic]:
    """Period and series again: what was left out has pulled at the period, too."""
    part = record.part(found.kept)
    period = periods.refined(part.time, (part.sweep, part.pitch), period)
    angles = (record.sweep, record.pitch)
    return period, periodic(record.time, angles, 1.0 / period, begin=begin)


def _as_it_is(record: Record, frequency: float | None, center: bool) -> Made:
    """Exact samples of one period, as `SampledStroke.save` writes them."""
    samples = (record.time, record.sweep, record.pitch)
    stroke: FourierStroke | SampledStroke = SampledStroke(*(tuple(v.tolist()) for v in samples))
    if frequency is not None and abs(frequency * stroke.period - 1.0) > _SAME_FREQUENCY:
        raise ValueError(
            f"the file holds exact samples of one period of {stroke.period:.6g} s "
            f"({stroke.frequency:.6g} Hz), and {frequency:.6g} Hz was given"
        )
    notices = list(record.notices)
    if center:
        stroke, said = shift_of(stroke)
        notices.append(said)
    record = replace(record, notices=(*notices, *doubts_of(stroke)))
    return Made(stroke, record, "", 1.0, (0, 0), (0.0, 0.0))


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
