"""How far a stroke can be scaled: the highest frequency at which it stays feasible.

Nothing says that a stroke feasible at one frequency is feasible at every lower one, so frequencies
are scanned first, on the quasi-steady model that takes a tenth of a second each; the edge found
there is then looked for on the rig's own model and halved down.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import Any

import numpy as np

from flaprig import _checks as check
from flaprig.aero.air import Progress
from flaprig.aero.models import QuasiSteady
from flaprig.feasibility import check_feasibility
from flaprig.limits import Limits
from flaprig.rig import Rig
from flaprig.strokes.sampled import SampledStroke
from flaprig.strokes.stroke import Stroke
from flaprig.twin import LEAST_FREQUENCY, MOST_FREQUENCY

# step of the scan, and how far it goes from the stroke's own frequency, both as factors
STEP, REACH = 1.2, 32.0
# infeasible frequencies in a row that end the scan upwards: eight are a factor of four
GIVE_UP = 8
# the edge is known when the ratio of both sides is within this
PRECISION = 0.01
# samples of a stroke that has no frequency of its own to change
SAMPLES = 400


@dataclass(frozen=True)
class Trial:
    """One frequency that was tried.

    Attributes:
        frequency: in [Hz].
        feasible: the whole verdict.
        broken: keys of the limits that were not kept.
        screen: whether the quasi-steady model judged, and not the rig's own.
    """

    frequency: float
    feasible: bool
    broken: tuple[str, ...]
    screen: bool


@dataclass(frozen=True)
class FrequencyRange:
    """The highest frequency at which a stroke stays feasible.

    Attributes:
        highest: feasible by the rig's own model, in [Hz]; None: none was found.
        above: lowest infeasible frequency known above it in [Hz]; None: the scan ended feasible.
        limited_by: keys of the limits that break there.
        islands: higher frequencies that the scan found feasible again, in [Hz].
        trials: everything that was tried, in order.
    """

    highest: float | None
    above: float | None
    limited_by: tuple[str, ...]
    islands: tuple[float, ...]
    trials: tuple[Trial, ...]

    def summary(self) -> dict[str, Any]:
        """Numbers for a JSON object."""
        return {
            "highest_frequency_Hz": self.highest,
            "infeasible_frequency_Hz": self.above,
            "limited_by": list(self.limited_by),
            "islands_Hz": list(self.islands),
            "trials": len(self.trials),
        }


def at_frequency(stroke: Stroke, frequency: float) -> Stroke:
    """The same motion at another number of strokes per second in [Hz].

    Raises:
        ValueError: a frequency that is not positive.
    """
    frequency = check.positive("at_frequency", "frequency", frequency, "Hz")
    slower = stroke.frequency / frequency
    if isinstance(stroke, SampledStroke):
        return replace(stroke, time=tuple(time * slower for time in stroke.time))
    if is_dataclass(stroke) and "frequency" in (field.name for field in fields(stroke)):
        changed: Stroke = replace(stroke, frequency=frequency)
        return changed
    motion = stroke.sample(SAMPLES)
    return SampledStroke(
        tuple((motion.time * slower).tolist()),
        tuple(motion.sweep.tolist()),
        tuple(motion.pitch.tolist()),
    )


def highest_frequency(
    rig: Rig,
    stroke: Stroke,
    limits: Limits | None = None,
    progress: Progress | None = None,
    **settings: Any,
) -> FrequencyRange:
    """Scan, then bisect, for the highest frequency at which a stroke stays feasible.

    Args:
        rig: the rig.
        stroke: the motion; its own frequency is where the scan begins.
        limits: of the joints; None: the rig's own.
        progress: called with the fraction of the trials that may be needed.
        settings: passed on to `check_feasibility`.

    Raises:
        ValueError: a bad argument; the sentence names it.
    """
    search = _Search(rig, stroke, lambda tried: _told(progress, tried), limits, settings)
    scan = search.scan()
    feasible = [trial.feasible for trial in scan]
    if not any(feasible):
        return FrequencyRange(None, scan[0].frequency, scan[0].broken, (), tuple(search.trials))
    # the stretch that holds the stroke's own frequency, or the first one below it
    first = feasible.index(True)
    end = first + [*feasible[first:], False].index(False)
    islands = tuple(trial.frequency for trial in scan[end:] if trial.feasible)
    inside, outside = search.edge(scan[end - 1].frequency)
    while inside and outside and outside.frequency > (1.0 + PRECISION) * inside.frequency:
        middle = search.try_at(float(np.sqrt(inside.frequency * outside.frequency)), rig)
        inside, outside = (middle, outside) if middle.feasible else (inside, middle)
    return FrequencyRange(
        inside.frequency if inside else None,
        outside.frequency if outside else None,
        outside.broken if outside else (),
        islands,
        tuple(search.trials),
    )


class _Search:
    """Frequencies tried so far, on the screen and on the rig's own model."""

    def __init__(
        self,
        rig: Rig,
        stroke: Stroke,
        told: Callable[[int], None],
        limits: Limits | None,
        settings: dict[str, Any],
    ) -> None:
        self.rig, self.stroke, self.told = rig, stroke, told
        self.settings = settings | {"limits": limits}
        self.trials: list[Trial] = []
        self.screen = rig.with_(model=QuasiSteady())

    def try_at(self, frequency: float, rig: Rig) -> Trial:
        """Judge the stroke at a frequency in [Hz]."""
        report = check_feasibility(rig, at_frequency(self.stroke, frequency), **self.settings)
        broken = tuple(verdict.key for verdict in report.broken)
        trial = Trial(frequency, report.feasible, broken, rig is not self.rig)
        self.trials.append(trial)
        self.told(len(self.trials))
        return trial

    def scan(self) -> list[Trial]:
        """Trials by rising frequency, from the stroke's own or, where that fails, from below it."""
        own = self.stroke.frequency
        highest = min(own * REACH, MOST_FREQUENCY)
        lowest = max(own / REACH, LEAST_FREQUENCY)
        found = [self.try_at(own, self.screen)]
        while not found[0].feasible and found[0].frequency > lowest:
            below = max(found[0].frequency / STEP, lowest)
            found.insert(0, self.try_at(below, self.screen))
        while found[-1].frequency < highest and any(t.feasible for t in found[-GIVE_UP:]):
            found.append(self.try_at(min(found[-1].frequency * STEP, highest), self.screen))
        return found

    def edge(self, frequency: float) -> tuple[Trial | None, Trial | None]:
        """By the rig's own model: the first feasible frequency at or below, the next one above."""
        highest = min(self.stroke.frequency * REACH, MOST_FREQUENCY)
        lowest = max(self.stroke.frequency / REACH, LEAST_FREQUENCY)
        inside, outside = self.try_at(frequency, self.rig), None
        while not inside.feasible:
            outside = inside
            if inside.frequency <= lowest:
                return None, outside
            inside = self.try_at(max(inside.frequency / STEP, lowest), self.rig)
        while outside is None and inside.frequency < highest:
            above = self.try_at(min(inside.frequency * STEP, highest), self.rig)
            inside, outside = (above, None) if above.feasible else (inside, above)
        return inside, outside


def _told(progress: Progress | None, tried: int) -> None:
    """Nobody knows how many trials are needed: the fraction nears one as they grow."""
    if progress is not None:
        progress(1.0 - 0.95**tried)
