"""What a stroke is: a periodic sweep and pitch, with rates and accelerations.

Sweep is the angle about the vertical, pitch the angle from the vertical, positive when the leading
edge leans towards increasing sweep. Time 0 is where the formula strokes start: their reversal at
the lowest sweep angle, about to sweep with positive rate and positive pitch.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from flaprig import _checks as check
from flaprig.files import written_whole

Array = NDArray[np.float64]

# largest number of instants asked of one period
MOST_SAMPLES = 10_000_000
# largest angle of a stroke [rad]: one turn; more is nearly always an angle in degrees
MOST_ANGLE = 2.0 * np.pi
# largest frequency [Hz]: a thousand times the fastest insect
MOST_FREQUENCY = 1e6


@dataclass(frozen=True, eq=False)
class Motion:
    """Angles, rates and accelerations at given instants; all arrays share one shape.

    Attributes:
        time: instants in [s].
        sweep: sweep angle in [rad].
        pitch: pitch angle from the vertical in [rad].
        sweep_rate: in [rad/s].
        pitch_rate: in [rad/s].
        sweep_acceleration: in [rad/s2].
        pitch_acceleration: in [rad/s2].
    """

    time: Array
    sweep: Array
    pitch: Array
    sweep_rate: Array
    pitch_rate: Array
    sweep_acceleration: Array
    pitch_acceleration: Array


@runtime_checkable
class Stroke(Protocol):
    """A periodic motion of the wing."""

    @property
    def frequency(self) -> float:
        """Strokes per second in [Hz]."""
        ...

    @property
    def period(self) -> float:
        """Duration of one cycle in [s]."""
        ...

    @property
    def sweep_amplitude(self) -> float:
        """Half of the peak-to-peak sweep in [rad]."""
        ...

    @property
    def pitch_amplitude(self) -> float:
        """Half of the peak-to-peak pitch in [rad]."""
        ...

    def motion(self, time: ArrayLike) -> Motion:
        """The motion at any instants in [s], of any shape; periodic."""
        ...

    def sample(self, count: int) -> Motion:
        """The motion at equally spaced instants of one period, its end left out."""
        ...

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the stroke to a file that `flaprig.strokes.load` reads back."""
        ...


def check_stroke(owner: str, stroke: Stroke) -> None:
    """Refuse what is not a stroke.

    Raises:
        ValueError: one sentence.
    """
    check.instance(owner, "stroke", stroke, Stroke, "a stroke, for instance a SunTangStroke")


class PeriodicStroke:
    """What every stroke derives from its frequency and its motion."""

    @property
    def period(self: Stroke) -> float:
        """Duration of one cycle in [s]."""
        return 1.0 / self.frequency

    def sample(self: Stroke, count: int) -> Motion:
        """The motion at count equally spaced instants from time 0, the end of the period left out.

        Raises:
            ValueError: count is not a whole number of at least 1.
        """
        count = check.whole(type(self).__name__, "count", count, 1, MOST_SAMPLES)
        return self.motion(np.arange(count) / (count * self.frequency))


# endings that promise something else, by what a stroke is written as
FOREIGN = {
    "JSON": (".csv", ".tsv", ".txt", ".dat", ".npz", ".npy", ".xlsx"),
    "CSV": (".json", ".npz", ".npy", ".xlsx"),
}


def write_whole(path: str | os.PathLike[str], text: str, form: str) -> None:
    """Write a stroke at once: a reader sees the old file or the new one, never a half.

    Args:
        path: of the file; any ending that promises nothing else than the form.
        text: what is written.
        form: of the text, JSON or CSV.

    Raises:
        ValueError: an ending that promises another form.
        OSError: the folder does not exist or cannot be written.
    """
    ending = os.path.splitext(path)[1].lower()
    if ending in FOREIGN[form]:
        sentence = f"save: path must not end in {ending}, since this stroke is written as {form}"
        raise ValueError(f"{sentence}, got {os.fspath(path)!r}")
    with written_whole(path) as draft:
        draft.write_text(text, encoding="utf-8")
