"""Makes the tables and the picture of docs/feasibility.md: `python docs/feasibility_tables.py`.

The nine kinematics of the paper on the rig as built, and the frequency at which each limit is first
broken. Prints Markdown; takes some minutes.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np

import flaprig
from flaprig.feasibility import FeasibilityReport, check_feasibility
from flaprig.limits import JointLimits, Limits, project, rig_limits
from flaprig.limits.limits import JOINTS, Bound
from flaprig.limits.peaks import peaks
from flaprig.report.torque_speed import draw_torque_speed
from flaprig.scaling import at_frequency, highest_frequency
from flaprig.servo_choice import smallest_servo

# durations of the paper's reversals [cycles]: section 2.2
DURATIONS = (0.16, 0.32, 0.50)
# columns of the first table: heading and name of a verdict; the smaller margin of both joints
COLUMNS = {
    "position": "position",
    "velocity": "velocity",
    "acceleration": "acceleration",
    "jerk": "jerk",
    "nearest motion": "nearest_motion",
    "peak torque": "peak_torque",
    "rms torque": "rms_torque",
    "torque at speed": "torque_at_speed",
    "heat": "winding_temperature",
    "tracking, rms": "rms_tracking_error",
    "tracking, peak": "peak_tracking_error",
}
# limits of the servo in the second table: heading and name of a verdict
SERVO = {
    "tracking, rms": "rms_tracking_error",
    "tracking, peak": "peak_tracking_error",
    "torque at speed": "torque_at_speed",
    "rms torque": "rms_torque",
    "heat": "winding_temperature",
    "peak torque": "peak_torque",
}
# bounds that are forgiven where the nearest motion within them is near enough
MOTION = ("velocity", "acceleration")
# frequencies of the second table [Hz]: steps of 6 %, between which margins are interpolated
FREQUENCIES = np.geomspace(0.2, 0.8, 25)
PICTURE = Path(__file__).parent / "images" / "torque_speed.png"


def main() -> None:
    """Print everything."""
    rig = flaprig.Rig.load()
    strokes = dict(kinematics())
    reports = {name: check_feasibility(rig, stroke) for name, stroke in strokes.items()}
    print_margins(reports)
    print_first_bites(rig, strokes)
    print_scale(rig, strokes)
    title = "The fastest reversals of the paper at 0.2 Hz on the rig as built (UVLM)"
    draw_torque_speed(PICTURE, reports[".16 / .16"], title)


def kinematics() -> Iterator[tuple[str, flaprig.SunTangStroke]]:
    """The nine strokes by their durations, sweep / pitch."""
    for sweep in DURATIONS:
        for pitch in DURATIONS:
            name = f"{sweep:.2f} / {pitch:.2f}".replace("0.", ".")
            yield name, flaprig.SunTangStroke(0.2, math.pi / 3, math.pi / 4, sweep, pitch)


def print_row(cells: list[str]) -> None:
    """One row of a Markdown table."""
    print("| " + " | ".join(cells) + " |", flush=True)


def print_head(cells: list[str]) -> None:
    """Headings of a Markdown table."""
    print()
    print_row(cells)
    print_row(["---"] * len(cells))


def print_margins(reports: dict[str, FeasibilityReport]) -> None:
    """Margins in percent: the smaller one of both joints, s or p says whose."""
    print_head(["durations", "feasible", *COLUMNS, "C_L", "L/D"])
    for name, report in reports.items():
        cells = [smaller(report, verdict) for verdict in COLUMNS.values()]
        changes = (100.0 * report.verdict(f"{key}_change").value for key in ("cl", "lift_to_drag"))
        verdict = "yes" if report.feasible else "no"
        print_row([name, verdict, *cells, *(f"{change:+.1f}" for change in changes)])


def smaller(report: FeasibilityReport, name: str) -> str:
    """The smaller margin of both joints in percent, and the joint's first letter."""
    found = [v for v in report.verdicts if v.name == name and v.margin is not None]
    least = min(found, key=lambda v: v.margin or 0.0)
    return f"{100.0 * (least.margin or 0.0):.0f} {least.joint[0]}"


def print_first_bites(rig: flaprig.Rig, strokes: dict[str, flaprig.SunTangStroke]) -> None:
    """Frequency in [Hz] at which each limit is first broken, and the limit that is the first."""
    limits = rig_limits(rig.motors, rig.wing, rig.fluid)
    names = ["velocity", "acceleration", "nearest motion", *SERVO]
    print_head(["durations", "first limit", "kept until", *names])
    for name, stroke in strokes.items():
        bites = motion_bites(stroke, limits) | servo_bites(rig, stroke, limits)
        first = min(bites, key=lambda key: bites[key][0])
        # velocity and acceleration may be broken until the nearest motion is a count away
        until = min(bite for key, (bite, _) in bites.items() if key not in MOTION)
        print_row([name, f"{bites[first][1]} {first}", f"{until:.3f}", *map(told, bites.values())])


def told(bite: tuple[float, str]) -> str:
    """A frequency and the joint's first letter."""
    return f"{bite[0]:.3f} {bite[1][0]}" if math.isfinite(bite[0]) else f"> {FREQUENCIES[-1]:.1f}"


def motion_bites(stroke: flaprig.SunTangStroke, limits: Limits) -> dict[str, tuple[float, str]]:
    """A derivative of order k grows with the frequency's k-th power: exact."""
    need = peaks(stroke)
    found = {}
    for power, bound in ((1, Bound.VELOCITY), (2, Bound.ACCELERATION)):
        found[str(bound)] = min(
            (
                stroke.frequency
                * (getattr(getattr(limits, joint), bound) / getattr(need[joint], bound))
                ** (1.0 / power),
                joint,
            )
            for joint in JOINTS
        )
    found["nearest motion"] = min(distance_bite(stroke, limits, joint) for joint in JOINTS)
    return found


def distance_bite(stroke: flaprig.SunTangStroke, limits: Limits, joint: str) -> tuple[float, str]:
    """Where the nearest motion within the limits is one count away, halved down."""
    low, high = FREQUENCIES[0], FREQUENCIES[-1]
    while high > 1.001 * low:
        middle = math.sqrt(low * high)
        found = project(at_frequency(stroke, middle), limits)
        near = getattr(found, joint).distance_max <= flaprig.Tolerances().resolution
        low, high = (middle, high) if near else (low, middle)
    return low, joint


def servo_bites(
    rig: flaprig.Rig, stroke: flaprig.SunTangStroke, limits: Limits
) -> dict[str, tuple[float, str]]:
    """The stroke as it is, without bounds on its motion: what the servos would need for it."""
    free = Limits(*(unbounded(getattr(limits, joint)) for joint in JOINTS))
    quick = rig.with_(model=flaprig.QuasiSteady())
    reports = [check_feasibility(quick, at_frequency(stroke, f), limits=free) for f in FREQUENCIES]
    found = {}
    for heading, name in SERVO.items():
        found[heading] = min(
            (crossing([margin(report, joint, name) for report in reports]), joint)
            for joint in JOINTS
        )
    return found


def unbounded(allowed: JointLimits) -> JointLimits:
    """The same servo without bounds on the motion but its range."""
    return replace(allowed, velocity=1e3, acceleration=1e5, jerk=1e9)


def margin(report: FeasibilityReport, joint: str, name: str) -> float:
    """Margin of a verdict."""
    found = next(v.margin for v in report.verdicts if (v.joint, v.name) == (joint, name))
    return -math.inf if found is None else found


def crossing(margins: list[float]) -> float:
    """Frequency in [Hz] at which margins first reach zero, by linear interpolation."""
    steps = zip(pairwise(FREQUENCIES), pairwise(margins), strict=True)
    for (below, above), (before, after) in steps:
        if after < 0.0:
            share = before / (before - after) if math.isfinite(after) else 1.0
            return float(below + share * (above - below))
    return math.inf


def print_scale(rig: flaprig.Rig, strokes: dict[str, flaprig.SunTangStroke]) -> None:
    """Highest frequency by the lattice, and the smallest servos at 0.2 Hz."""
    print_head(["durations", "highest [Hz]", "ended by", "sweep servo", "pitch servo", "one servo"])
    for name in (".16 / .16", ".32 / .32", ".50 / .50"):
        found = highest_frequency(rig, strokes[name])
        choice = smallest_servo(rig, strokes[name])
        ended = ", ".join(found.limited_by)
        servos = [str(servo) for servo in (choice.sweep, choice.pitch, choice.both)]
        print_row([name, f"{found.highest:.3f}", ended, *servos])


if __name__ == "__main__":
    main()
