"""Strokes from samples of one period, joined by a periodic quintic spline.

The spline has four continuous derivatives, so accelerations are smooth; it passes through every
sample, so noise is not removed: `flaprig.read_log` fits measured angles instead, and a stroke whose
samples look measured says so in its notices.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from flaprig import _checks as check
from flaprig.strokes.stroke import (
    MOST_ANGLE,
    MOST_FREQUENCY,
    Array,
    Motion,
    PeriodicStroke,
    write_whole,
)

# scipy is imported where it is used: it would triple the time of `import flaprig`
if TYPE_CHECKING:
    from scipy.interpolate import BSpline

# fewest samples of one period: three harmonics and one to spare
LEAST_SAMPLES = 8
# most samples of one period
MOST_SAMPLES = 100_000
# last sample equal to the first within this means closed sampling [rad]
CLOSED_WITHIN = 1e-9
# steps of open sampling may differ by this fraction (times printed with few digits)
UNIFORM_WITHIN = 1e-3
# smallest step of the time, over the period
LEAST_STEP = 1e-6
# harmonics that make a motion without its noise, and instants at which both are compared
LOW_HARMONICS, COMPARED = 20, 4096
# a peak acceleration so many times that of the low harmonics is noise [1]
MANY_TIMES = 3.0
# least acceleration that is compared, over amplitude times frequency squared
LEAST_SHARE = 1e-3
# column that says that samples are exact and cover one period: a log is read with more doubt
EXACT = "exact"
# first line of a file of samples
HEADER = f"time_s,sweep_rad,pitch_rad,{EXACT}"


@dataclass(frozen=True)
class SampledStroke(PeriodicStroke):
    """A stroke through samples of one period, from any source.

    Closed sampling: the last sample repeats both angles of the first (within 1e-9 rad); the
    period is last minus first instant and the steps are free. Open sampling: it does not; the
    steps must be equal (within 0.1 %), and the period is one step longer than the samples.

    Attributes:
        time: instants in [s], increasing, from any start. Length k >= 8.
        sweep: sweep at these instants in [rad]. Length k.
        pitch: pitch from the vertical at these instants in [rad]. Length k.

    Raises:
        ValueError: too few samples, unequal lengths, NaN, time that does not increase, open
            sampling with unequal steps, or angles beyond one turn, which look like degrees.
    """

    time: tuple[float, ...]
    sweep: tuple[float, ...]
    pitch: tuple[float, ...]

    def __post_init__(self) -> None:
        owner = "SampledStroke"
        bounds = (LEAST_SAMPLES, MOST_SAMPLES)
        time = check.array(owner, "time", self.time, "s", *bounds, most=check.MOST_TIME)
        sweep = _checked_angle("sweep", self.sweep, time.size)
        pitch = _checked_angle("pitch", self.pitch, time.size)
        steps = np.diff(time)
        if np.any(steps < LEAST_STEP * (time[-1] - time[0])) or not steps.min() > 0.0:
            raise check.fail(owner, "time", "in increasing order, in s", time.tolist())
        for name, values in (("time", time), ("sweep", sweep), ("pitch", pitch)):
            object.__setattr__(self, name, tuple(values.tolist()))
        uneven = float(np.ptp(steps) / steps.mean())
        if not self.closed and uneven > UNIFORM_WITHIN:
            allowed = "equally spaced, or closed by repeating the first sample at the end"
            raise check.fail(owner, "time", allowed, f"steps that differ by {uneven:.3%}")
        check.positive(owner, "frequency of the samples", self.frequency, "Hz", most=MOST_FREQUENCY)

    @property
    def closed(self) -> bool:
        """Whether the last sample repeats the first."""
        gaps = (self.sweep[-1] - self.sweep[0], self.pitch[-1] - self.pitch[0])
        return max(abs(gap) for gap in gaps) <= CLOSED_WITHIN

    @property
    def period(self) -> float:
        """Duration of one cycle in [s]."""
        length = self.time[-1] - self.time[0]
        return length if self.closed else length * len(self.time) / (len(self.time) - 1)

    @property
    def frequency(self) -> float:
        """Strokes per second in [Hz]."""
        return 1.0 / self.period

    @property
    def sweep_amplitude(self) -> float:
        """Half of the peak-to-peak sweep of the spline in [rad]."""
        return 0.5 * self._ranges[0]

    @property
    def pitch_amplitude(self) -> float:
        """Half of the peak-to-peak pitch of the spline in [rad]."""
        return 0.5 * self._ranges[1]

    def motion(self, time: ArrayLike) -> Motion:
        """The motion at any instants in [s], of any shape; derivatives of the spline.

        Raises:
            ValueError: an instant that is not a finite number.
        """
        instants = check.times("SampledStroke", time)
        phase = np.mod((instants - self.time[0]) / self.period, 1.0)
        phi, theta = ([np.asarray(s(phase, order)) for order in range(3)] for s in self._splines)
        f = self.frequency
        return Motion(
            time=instants,
            sweep=phi[0],
            pitch=theta[0],
            sweep_rate=f * phi[1],
            pitch_rate=f * theta[1],
            sweep_acceleration=f**2 * phi[2],
            pitch_acceleration=f**2 * theta[2],
        )

    @cached_property
    def notices(self) -> tuple[str, ...]:
        """What is doubtful about the samples: sentences; none where they look exact.

        The second derivative of measured angles is mostly that of their noise.
        """
        found = []
        count = max(COMPARED, 2 * len(self.time))
        motion = self.motion(self.time[0] + np.arange(count) * self.period / count)
        for joint in ("sweep", "pitch"):
            own = getattr(motion, f"{joint}_acceleration")
            low = np.fft.rfft(own)
            low[LOW_HARMONICS + 1 :] = 0.0
            smooth = float(np.abs(np.fft.irfft(low, count)).max())
            peak = float(np.abs(own).max())
            least = LEAST_SHARE * float(np.ptp(getattr(motion, joint))) * self.frequency**2
            if peak > max(MANY_TIMES * smooth, least):
                times = f"{peak / smooth:.3g} times" if smooth > 0.0 else "beyond"
                found.append(
                    f"{joint}: the samples' peak acceleration of {peak:.4g} rad/s2 is {times} that "
                    f"of their first {LOW_HARMONICS} harmonics: noise of a measurement? "
                    "(flaprig.read_log fits it)"
                )
        return tuple(found)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the samples as CSV, whole or not at all: time_s, sweep_rad, pitch_rad, exact.

        The last column is 1 and says that no log is meant: such a file comes back bit for bit.
        """
        rows = zip(self.time, self.sweep, self.pitch, strict=True)
        lines = [HEADER, *(",".join(repr(value) for value in row) + ",1" for row in rows)]
        write_whole(path, "\n".join(lines) + "\n", "CSV")

    @cached_property
    def _splines(self) -> tuple[BSpline, BSpline]:
        """Sweep and pitch over the phase, 0 to 1, from the first sample on."""
        from scipy.interpolate import make_interp_spline

        phase = (np.array(self.time) - self.time[0]) / self.period
        phase = np.append(phase[:-1] if self.closed else phase, 1.0)
        knots = [np.array(v[:-1] if self.closed else v) for v in (self.sweep, self.pitch)]
        sweep, pitch = (
            make_interp_spline(phase, np.append(v, v[0]), k=5, bc_type="periodic") for v in knots
        )
        return sweep, pitch

    @cached_property
    def _ranges(self) -> tuple[float, float]:
        sweep, pitch = (_peak_to_peak(spline) for spline in self._splines)
        return sweep, pitch


def _checked_angle(name: str, values: ArrayLike, length: int) -> Array:
    angles = check.array("SampledStroke", name, values, "rad", length=length)
    if np.abs(angles).max() > MOST_ANGLE:
        allowed = f"within {MOST_ANGLE:.6g} rad (radians, not degrees)"
        raise check.fail("SampledStroke", name, allowed, float(np.abs(angles).max()))
    return angles


def _peak_to_peak(spline: BSpline) -> float:
    from scipy.interpolate import PPoly

    turns = PPoly.from_spline(spline.derivative()).roots(extrapolate=False)
    # a constant piece gives NaN beside its start, which is a turn as good as any
    points = np.concatenate([turns[np.isfinite(turns)], np.linspace(0.0, 1.0, 101)])
    return float(np.ptp(spline(points)))
