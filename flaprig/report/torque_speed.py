"""The picture of what a stroke asks of its servos: torque against speed, under the motor's line.

Speed is counted along the motion: torque above zero drives, below zero it brakes. The line from
stall to no-load is what a DC motor gives at its voltage.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from flaprig.report import style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from flaprig.feasibility import FeasibilityReport
    from flaprig.motors import Motor
    from flaprig.servo_verdicts import LinePoint, Work

Array = NDArray[np.float64]

# colours of the two loops
COLOURS = {"sweep": style.VERMILION, "pitch": style.BLUE}
# a loop smaller than this share of the diagram is drawn once more, enlarged
_SMALL = 0.15
# where the enlarged loop stands, in shares of the axes: above the line, where nothing else is
_INSET = (0.53, 0.57, 0.45, 0.36)
# top of the diagram over the stall torque: room for the enlarged loop
_TOP = 1.5
# powers of the hyperbolas, as shares of the most that the motor gives
_POWERS = (0.1, 0.4)


def draw_torque_speed(path: Path, report: FeasibilityReport, title: str) -> None:
    """Picture of both servos.

    Args:
        path: where to write; the ending chooses the format.
        report: of the stroke.
        title: above the picture.
    """
    from flaprig.servo_verdicts import line_point, warm_stall_torque

    with style.figure(9.6, 5.2) as drawing:
        for axes, (joint, colour) in zip(drawing.subplots(1, 2), COLOURS.items(), strict=True):
            motor, work = getattr(report.rig.motors, joint), report.work(joint)
            # what is judged: a stroke that the rig cannot make stands in grey beside the flown one
            asked = report.asked_work.get(joint)
            point = line_point(motor, asked or work)
            _draw_motor(axes, motor, warm_stall_torque(motor, work.rms_torque))
            speed, torque = folded(work)
            _scale(axes, motor, *(folded(asked) if asked else (speed, torque)))
            if asked:
                _draw_loop(axes, asked, point, style.GREY)
            _draw_loop(axes, work, line_point(motor, work), colour)
            if _is_small(axes, torque):
                _draw_inset(axes, motor, work, line_point(motor, work), colour)
            _tell_point(axes, point)
            axes.set_title(_heading(report, joint))
            axes.set_xlabel(f"speed of the {joint} [rad/s]")
        drawing.axes[0].set_ylabel("torque [N m], below zero: braking")
        _legend(drawing, report)
        drawing.suptitle(title, x=0.01, ha="left", fontsize=11.5)
        style.save(drawing, path)


def folded(work: Work) -> tuple[Array, Array]:
    """Size of the speed, and torque along the motion; NaN where the motion turns round.

    There the torque changes sides, driving for braking, and no line is to join the two.
    """
    direction = np.where(work.speed < 0.0, -1.0, 1.0)
    turns = np.flatnonzero(np.diff(direction)) + 1
    return (
        np.insert(np.abs(work.speed), turns, np.nan),
        np.insert(work.demand * direction, turns, np.nan),
    )


def _draw_motor(axes: Axes, motor: Motor, warm: float) -> None:
    """The line, the band that is borne for ever, and lines of equal power."""
    stall, free = motor.stall_torque, motor.no_load_speed
    ends = np.array([0.0, free])
    axes.fill_between(ends, [stall, 0.0], color=style.PALE, alpha=0.45, lw=0)
    axes.axhspan(-motor.continuous_torque, motor.continuous_torque, color=style.SKY, alpha=0.22)
    axes.axhline(0.0, color=style.GREY, lw=0.8)
    axes.plot(ends, [stall, 0.0], color=style.INK, lw=2.0)
    if warm < 0.99 * stall:
        axes.plot(ends, [warm, 0.0], "--", color=style.INK, lw=1.0)
    _tell(axes, 0.0, 1.01 * stall, f" stall {stall:.3g} N m", va="bottom")
    for share in _POWERS:
        # power p meets the line where x (1 - x) = p/(stall free)
        root = np.sqrt(1.0 - share)
        speeds = np.linspace(0.5 - 0.5 * root, 0.5 + 0.5 * root, 200) * free
        power = 0.25 * share * stall * free
        axes.plot(speeds, power / speeds, ":", color=style.GREY, lw=1.0)
        at = 0.35 * speeds[-1]
        _tell(axes, at, power / at, f" {power:.2g} W", va="bottom")


def _tell(axes: Axes, x: float, y: float, words: str, ha: str = "left", va: str = "center") -> None:
    axes.text(x, y, words, color=style.GREY, fontsize=8.0, ha=ha, va=va)


def _scale(axes: Axes, motor: Motor, speed: Array, torque: Array) -> None:
    right = max(1.03 * motor.no_load_speed, 1.05 * np.nanmax(speed))
    top = max(_TOP * motor.stall_torque, 1.1 * np.nanmax(torque))
    bottom = min(-0.28 * motor.stall_torque, 1.1 * np.nanmin(torque))
    axes.set(xlim=(0.0, right), ylim=(bottom, top))
    axes.grid(False)


def _is_small(axes: Axes, torque: Array) -> bool:
    low, high = axes.get_ylim()
    size = np.nanmax(torque) - np.nanmin(torque)
    return bool(size < _SMALL * (high - low) and np.nanmax(torque) < 0.5 * high)


def _draw_loop(axes: Axes, work: Work, point: LinePoint, colour: str) -> None:
    axes.plot(*folded(work), color=colour, lw=1.4)
    axes.axhline(work.rms_torque, color=colour, lw=0.9, ls=(0, (6, 3)))
    axes.plot(point.speed, point.torque, "o", color=colour, mec=style.INK, mew=1.0, ms=6.5)


def _draw_inset(axes: Axes, motor: Motor, work: Work, point: LinePoint, colour: str) -> None:
    """The loop enlarged."""
    inset = axes.inset_axes(_INSET)
    inset.set_facecolor("white")
    inset.axhspan(-motor.continuous_torque, motor.continuous_torque, color=style.SKY, alpha=0.22)
    inset.axhline(0.0, color=style.GREY, lw=0.8)
    _draw_loop(inset, work, point, colour)
    speed, torque = folded(work)
    low, high = float(np.nanmin(torque)), float(np.nanmax(torque))
    room = 0.12 * max(high - low, 1e-9)
    inset.set(xlim=(0.0, 1.06 * np.nanmax(speed)), ylim=(low - room, high + room))
    inset.grid(False)
    inset.tick_params(labelsize=7.5, length=2.5)
    for spine in inset.spines.values():
        spine.set(visible=True, color=style.GREY, linewidth=0.8)
    inset.set_title("enlarged", fontsize=8.0, color=style.GREY, loc="right", pad=2.0)
    axes.indicate_inset_zoom(inset, edgecolor=style.GREY, alpha=0.35)


def _tell_point(axes: Axes, point: LinePoint) -> None:
    """What the nearest point uses of what is there, above the diagram."""
    used = point.torque / point.available if point.available > 0.0 else np.inf
    words = (
        f"{'nearest point' if used <= 1.0 else 'beyond the line'}: {point.torque:.3g} of "
        f"{point.available:.3g} N m at {point.speed:.3g} rad/s, {100.0 * used:.3g} % used"
    )
    colour, weight = (style.INK, "normal") if used <= 1.0 else (style.VERMILION, "bold")
    where: dict[str, Any] = {
        "xy": (0.995, 0.995),
        "xycoords": "axes fraction",
        "ha": "right",
        "va": "top",
    }
    axes.annotate(words, color=colour, weight=weight, fontsize=8.5, **where)


def _legend(drawing: Figure, report: FeasibilityReport) -> None:
    """One row under both diagrams."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    own = report.rig.motors
    asked = [Line2D([], [], color=style.GREY, lw=1.4, label="as asked")] * bool(report.asked_work)
    volts = " and ".join(sorted({f"{motor.voltage:g} V" for motor in (own.sweep, own.pitch)}))
    handles = [
        Line2D([], [], color=style.INK, lw=2.0, label=f"the motor at {volts}"),
        Line2D([], [], color=style.INK, lw=1.0, ls="--", label="when warm"),
        Patch(color=style.SKY, alpha=0.35, lw=0, label="continuous torque"),
        Line2D([], [], color=style.GREY, lw=1.0, ls=":", label="equal power"),
        Line2D([], [], color=style.VERMILION, lw=1.4, label="the stroke flown"),
        *asked,
        Line2D([], [], color=style.VERMILION, lw=0.9, ls=(0, (6, 3)), label="its rms torque"),
        Line2D([], [], ls="", marker="o", color="white", mec=style.INK, label="nearest point"),
    ]
    settings: dict[str, Any] = {
        "ncols": len(handles),
        "fontsize": 8.0 if asked else 8.5,
        "columnspacing": 1.3 - 0.3 * bool(asked),
        "handlelength": 1.8,
    }
    drawing.legend(handles=handles, loc="outside lower center", **settings)


def _heading(report: FeasibilityReport, joint: str) -> str:
    """Verdict on a joint, with the limit that has least left or is broken most."""
    from flaprig.verdict import narrowest

    own = [verdict for verdict in report.verdicts if verdict.joint == joint]
    if not report.feasible_joint(joint):
        names = ", ".join(v.name.replace("_", " ") for v in own if not v.holds)
        return f"{joint}: not feasible ({_shortened(names)})"
    worst = narrowest(own)
    name, margin = worst.name.replace("_", " "), 100.0 * (worst.margin or 0.0)
    return f"{joint}: feasible, smallest margin {margin:.0f} % ({name})"


def _shortened(words: str, most: int = 34) -> str:
    """The first names of a list that have room."""
    return words if len(words) <= most else words[: words.rfind(",", 0, most)] + ", ..."
