"""What a stroke from a file is probably not meant to be: off centre, or with its lift downwards."""

from __future__ import annotations

from dataclasses import replace
from math import degrees, pi

import numpy as np

from flaprig.logs.motion import JOINTS
from flaprig.strokes.fourier import FourierStroke
from flaprig.strokes.sampled import SampledStroke
from flaprig.strokes.stroke import Motion

# both joints' stops [rad]: models/rig.xml
STOPS = pi / 2.0
# instants of a cycle that are looked at
_SAMPLES = 720
# share of the stroke's lift-making that must point down before it is told
_DOWN = -0.1
# a cycle that takes so long or so short is of another unit of time [s]
_LONGEST, _SHORTEST = 1000.0, 1e-3


def doubts_of(stroke: FourierStroke | SampledStroke) -> list[str]:
    """Sentences on a motion that no rig is likely to have made."""
    motion = stroke.sample(_SAMPLES)
    found = [said for joint in JOINTS if (said := _off_centre(joint, motion))]
    if points_down(motion):
        found.append(
            "lift points down: the pitch has the other sign than here, where positive pitch leans "
            "the leading edge towards increasing sweep (flip_pitch or --flip-pitch turns it)"
        )
    if stroke.period > _LONGEST:
        found.append(f"one cycle takes {stroke.period:.4g} s: is the time in ms or us?")
    if stroke.period < _SHORTEST:
        found.append(f"one cycle takes {stroke.period:.4g} s: is the time in seconds?")
    return found


def points_down(motion: Motion) -> bool:
    """Whether the wing meets the fluid with its upper side: by the angle of attack alone."""
    drive = motion.sweep_rate * np.abs(motion.sweep_rate)
    lean = np.sin(2.0 * motion.pitch)
    size = float(np.mean(np.abs(drive) * np.abs(lean)))
    return size > 0.0 and float(np.mean(drive * lean)) < _DOWN * size


def shift_of(
    stroke: FourierStroke | SampledStroke,
) -> tuple[FourierStroke | SampledStroke, str]:
    """The stroke with the middle of both ranges at zero, and a sentence that says so."""
    motion = stroke.sample(_SAMPLES)
    sweep, pitch = (_middle(getattr(motion, joint)) for joint in JOINTS)
    said = f"shifted to the middle: sweep by {-degrees(sweep):+.3g} deg, pitch by "
    said += f"{-degrees(pitch):+.3g} deg (center)"
    if isinstance(stroke, FourierStroke):
        moved = replace(
            stroke, sweep_mean=stroke.sweep_mean - sweep, pitch_mean=stroke.pitch_mean - pitch
        )
        return moved, said
    angles = (np.array(stroke.sweep) - sweep, np.array(stroke.pitch) - pitch)
    return SampledStroke(stroke.time, *(tuple(angle.tolist()) for angle in angles)), said


def _middle(angle: np.ndarray) -> float:
    return 0.5 * float(angle.max() + angle.min())


def _off_centre(joint: str, motion: Motion) -> str:
    angle = getattr(motion, joint)
    middle, half = _middle(angle), 0.5 * float(np.ptp(angle))
    if np.abs(angle).max() <= STOPS or half > STOPS:
        return ""
    return (
        f"{joint} is centred at {degrees(middle):.3g} deg and leaves the joints' range of +-90 "
        f"deg; shifted by {-degrees(middle):+.3g} deg it fits (center or --center)"
    )
