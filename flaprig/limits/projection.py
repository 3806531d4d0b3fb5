"""The stroke nearest to a given one that the rig's joints can follow.

Nearest: smallest mean square of the angle's difference over the cycle, each joint by itself, under
bounds on position, velocity, acceleration and jerk at every instant. Period and phase are kept.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from flaprig import _checks as check
from flaprig.limits import spline
from flaprig.limits.limits import JOINTS, Bound, JointLimits, Limits
from flaprig.limits.nearest import FAVARD, POINTS, Amplitude, excess, nearest
from flaprig.limits.peaks import check_limits, violations
from flaprig.strokes.sampled import SampledStroke
from flaprig.strokes.stroke import Stroke, check_stroke

Array = NDArray[np.float64]

# samples of a projected stroke: twice as many move the answer by 1e-5 of the amplitude
SAMPLES = 400
LEAST_SAMPLES, MOST_SAMPLES = 32, 5000
# a bound is active when the stroke comes this near, relative
ACTIVE_WITHIN = 1e-6
# an amplitude is kept when it is met this well, relative
KEPT_WITHIN = 1e-6
# least amplitude that can be lost [rad]
LEAST_AMPLITUDE = 1e-9
# a change that is told [rad]: one count of the rig's encoders, less a servo cannot tell
TOLD = 2.0 * np.pi / 4096.0


@dataclass(frozen=True)
class JointProjection:
    """What the projection did to one joint.

    Attributes:
        distance_rms: root mean square of projected minus wanted angle in [rad].
        distance_max: largest size of it in [rad].
        amplitude: half of the wanted peak-to-peak angle in [rad].
        amplitude_ratio: projected over wanted amplitude; 1 where there is none to lose.
        amplitude_kept: whether the ratio is 1 within 1e-6.
        active: bounds that the projected stroke reaches within 1e-6; none where nothing changed.
        blocking: bounds that forbid the amplitude, when it was to be kept and could not.
    """

    distance_rms: float = 0.0
    distance_max: float = 0.0
    amplitude: float = 0.0
    amplitude_ratio: float = 1.0
    amplitude_kept: bool = True
    active: tuple[Bound, ...] = ()
    blocking: tuple[Bound, ...] = ()


@dataclass(frozen=True)
class Projection:
    """A stroke within the limits, and how far it is from the wanted one.

    Attributes:
        stroke: the projected stroke; the wanted one itself, the same object, where it is feasible.
        sweep: what was done to the sweep.
        pitch: what was done to the pitch.
        notices: sentences on what was changed by more than an encoder can tell, and on amplitudes
            that were to be kept and could not.
    """

    stroke: Stroke
    sweep: JointProjection
    pitch: JointProjection
    notices: tuple[str, ...] = ()

    @property
    def changed(self) -> bool:
        """Whether the wanted stroke was beyond the limits."""
        return self.sweep.distance_max > 0.0 or self.pitch.distance_max > 0.0

    @property
    def distance_rms(self) -> float:
        """The larger of both joints' in [rad]."""
        return max(self.sweep.distance_rms, self.pitch.distance_rms)

    @property
    def distance_max(self) -> float:
        """The larger of both joints' in [rad]."""
        return max(self.sweep.distance_max, self.pitch.distance_max)

    @property
    def amplitude_kept(self) -> bool:
        """Whether both joints keep their amplitude."""
        return self.sweep.amplitude_kept and self.pitch.amplitude_kept


def project(
    stroke: Stroke,
    limits: Limits,
    keep_amplitude: bool = False,
    strict: bool = False,
    samples: int = SAMPLES,
) -> Projection:
    """The nearest periodic stroke within the limits, of the same period.

    A stroke within the limits (1e-9) is returned as it is, the same object.

    Args:
        stroke: what is wanted.
        limits: what both joints can do.
        keep_amplitude: keep both peak-to-peak angles, with the extremes at the instants of the
            wanted stroke. Where the limits forbid that, the joint gets its nearest motion without
            it, and `notices` names the bound.
        strict: raise the notice as an error instead.
        samples: of the projected stroke, 32 to 5000; fewer where the solver fails with so many,
            as it may far beyond the limits.

    Raises:
        ValueError: a bad argument, or, if strict, an amplitude that the limits forbid; the
            sentence names the bound.
        RuntimeError: the solver gave up.
    """
    samples = _checked(stroke, limits, keep_amplitude, strict, samples)
    if not violations(stroke, limits):
        amplitudes = stroke.sweep_amplitude, stroke.pitch_amplitude
        sweep, pitch = (JointProjection(amplitude=amplitude) for amplitude in amplitudes)
        return Projection(stroke, sweep, pitch)
    while True:
        try:
            return _projected(stroke, limits, keep_amplitude, strict, samples)
        except RuntimeError:
            if samples < 2 * LEAST_SAMPLES:
                raise
            samples //= 2


def _projected(
    stroke: Stroke, limits: Limits, keep_amplitude: bool, strict: bool, samples: int
) -> Projection:
    """`project` of a stroke beyond the limits, with so many samples."""
    motion = stroke.sample(POINTS * samples)
    angles, parts, notices = [], list[JointProjection](), list[str]()
    for joint in JOINTS:
        wanted, allowed = getattr(motion, joint), getattr(limits, joint)
        amplitude = getattr(stroke, f"{joint}_amplitude")
        found, part = _joint(wanted, allowed, stroke.frequency, amplitude, keep_amplitude)
        if part.blocking:
            notices.append(_notice(joint, part, allowed, stroke.frequency))
            if strict:
                raise ValueError(f"project: {notices[-1]}")
        if part.distance_max > TOLD:
            notices.append(_change(joint, part, wanted, allowed))
        angles.append(spline.values(found, np.arange(samples + 1) / samples))
        parts.append(part)
    # closed sampling: the last sample is the first again
    time = np.arange(samples + 1) / samples * stroke.period
    projected = SampledStroke(time, *angles)  # type: ignore[arg-type]
    sweep, pitch = parts
    return Projection(projected, sweep, pitch, tuple(notices))


def _checked(stroke: Stroke, limits: Limits, keep: bool, strict: bool, samples: int) -> int:
    """The number of samples; refuses bad arguments."""
    owner = "project"
    check_stroke(owner, stroke)
    check_limits(owner, limits)
    for name, value in (("keep_amplitude", keep), ("strict", strict)):
        if not isinstance(value, bool):
            raise check.fail(owner, name, "True or False", value)
    return check.whole(owner, "samples", samples, LEAST_SAMPLES, MOST_SAMPLES)


def _joint(
    wanted: Array, allowed: JointLimits, frequency: float, amplitude: float, keep: bool
) -> tuple[Array, JointProjection]:
    """Spline of one joint and what was done to it."""
    ranges = _per_cycle(allowed, frequency)
    start = spline.interpolate(wanted[::POINTS])
    blocking: tuple[Bound, ...] = ()
    found = None
    if keep and amplitude > LEAST_AMPLITUDE and excess(start, ranges) > 0.0:
        kept = _amplitude(start, amplitude)
        found = nearest(wanted, ranges, kept)
        blocking = () if found is not None else _blocking(wanted, ranges, kept)
    if found is None:
        found = nearest(wanted, ranges)
    if found is None:
        raise RuntimeError("project: the solver found no motion where rest is one")
    return found, _compared(wanted, found, ranges, amplitude, blocking)


def _per_cycle(allowed: JointLimits, frequency: float) -> Array:
    """Bounds on the derivatives with phase. Shape (4, 2)."""
    return np.array(
        [np.array(allowed.range_of(bound)) / frequency**k for k, bound in enumerate(Bound)]
    )


def _amplitude(start: Array, amplitude: float) -> Amplitude:
    """The amplitude to keep, at the extremes of the wanted angle."""
    phases = spline.turning_points(start)
    angles = spline.values(start, phases)
    highest, lowest = phases[np.argmax(angles)], phases[np.argmin(angles)]
    return Amplitude(float(highest), float(lowest), 2.0 * amplitude)


def _blocking(wanted: Array, ranges: Array, kept: Amplitude) -> tuple[Bound, ...]:
    """Bounds that forbid an amplitude: each by itself, else those without which it could be."""
    free = np.array([-np.inf, np.inf])
    single, needed = [], []
    for k, bound in enumerate(Bound):
        alone, without = np.tile(free, (4, 1)), ranges.copy()
        alone[k], without[k] = ranges[k], free
        if nearest(wanted, alone, kept) is None:
            single.append(bound)
        elif nearest(wanted, without, kept) is not None:
            needed.append(bound)
    return tuple(single or needed or Bound)


def _compared(
    wanted: Array, found: Array, ranges: Array, amplitude: float, blocking: tuple[Bound, ...]
) -> JointProjection:
    difference = spline.values(found, np.arange(wanted.size) / wanted.size) - wanted
    low, high = spline.extremes(found)
    ratio = 0.5 * (high - low) / amplitude if amplitude > LEAST_AMPLITUDE else 1.0
    return JointProjection(
        distance_rms=float(np.sqrt(np.mean(difference**2))),
        distance_max=float(np.abs(difference).max()),
        amplitude=amplitude,
        amplitude_ratio=ratio,
        amplitude_kept=abs(ratio - 1.0) <= KEPT_WITHIN,
        active=tuple(
            bound for k, bound in enumerate(Bound) if _reaches(spline.extremes(found, k), ranges[k])
        ),
        blocking=blocking,
    )


def _reaches(values: tuple[float, float], bounds: Array) -> bool:
    room = ACTIVE_WITHIN * 0.5 * (bounds[1] - bounds[0])
    return bool(values[1] >= bounds[1] - room or values[0] <= bounds[0] + room)


def _change(joint: str, part: JointProjection, wanted: Array, allowed: JointLimits) -> str:
    """One sentence on a joint whose motion was changed."""
    kept = part.amplitude_ratio * part.amplitude
    bounds = " and ".join(part.active) or "its limits"
    sentence = (
        f"{joint} was changed to stay within {bounds}: amplitude {in_words(kept)} instead of "
        f"{in_words(part.amplitude)}, {in_words(part.distance_rms)} rms away from the stroke asked "
        "for"
    )
    low, high = allowed.position
    middle = 0.5 * float(wanted.max() + wanted.min())
    beyond = wanted.max() > high or wanted.min() < low
    if beyond and np.ptp(wanted) <= high - low:
        shift = 0.5 * (low + high) - middle
        sentence += f"; shifted by {in_words(shift)} it fits between the joint's stops"
    return sentence


def in_words(angle: float) -> str:
    """An angle in [rad] as «0.34 rad (19.5 deg)»."""
    return f"{angle:.4g} rad ({np.degrees(angle):.4g} deg)"


def _notice(joint: str, part: JointProjection, allowed: JointLimits, frequency: float) -> str:
    """One sentence on an amplitude that cannot be kept."""
    names = []
    for bound in part.blocking:
        low, high = allowed.range_of(bound)
        size = f"{low:.6g} to {high:.6g}" if bound is Bound.POSITION else f"{high:.6g}"
        order = list(Bound).index(bound)
        need = FAVARD.get(order, 0.0) * part.amplitude * frequency**order
        least = f" (at least {need:.6g} is needed)" if need > high else ""
        names.append(f"{bound} {size} {bound.unit}{least}")
    return (
        f"{joint} cannot keep its amplitude of {part.amplitude:.6g} rad at {frequency:.6g} Hz "
        f"within {' and '.join(names)}"
    )
