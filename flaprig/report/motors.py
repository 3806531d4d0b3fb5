"""The picture of the servos at work: angles, tracking errors, torques and currents."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from flaprig.report import style

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from flaprig.motor_histories import MotorHistories
    from flaprig.strokes.stroke import Motion, Stroke

Array = NDArray[np.float64]

# the first part of a run, in cycles, whose jolt must not set the scale: servos start from rest
START_UP = 0.1
# difference of angles that a picture shows [rad]: half a degree
LEAST_DIFFERENCE = np.radians(0.5)
# the two servos and their colours
SERVOS = (("sweep", style.VERMILION), ("pitch", style.BLUE))


def draw_motors(path: Path, motors: MotorHistories, asked: Stroke, title: str) -> None:
    """Picture of both servos over the whole run.

    Args:
        path: where to write; the ending chooses the format.
        motors: histories, angles in [rad], torques in [N m], currents in [A].
        asked: the stroke that was asked for, drawn in grey where it is not what was commanded.
        title: above the picture.
    """
    cycles = motors.time / asked.period
    wanted = asked.motion(motors.time)
    with style.figure(7.0, 7.2) as drawing:
        rows = drawing.subplots(4, 1, sharex=True, gridspec_kw={"height_ratios": [3, 2, 3, 2]})
        for name, colour in SERVOS:
            _draw_asked(rows[0], cycles, motors, wanted, name)
            _draw_servo(rows, cycles, motors, name, colour)
        units = ("angle [°]", "error [°]", "torque [N m]", "current [A]")
        for axes, unit in zip(rows, units, strict=True):
            axes.set_ylabel(unit)
            axes.axhline(0.0, color=style.GREY, linewidth=0.8, zorder=1)
            _scale(axes, cycles)
        _legend(rows[0])
        rows[-1].set(xlabel="time [cycles]", xlim=(0.0, np.ceil(cycles[-1] - 1e-6)))
        drawing.align_ylabels()
        drawing.suptitle(title, x=0.01, ha="left", fontsize=11.5)
        style.save(drawing, path)


def _draw_asked(
    axes: Axes, cycles: Array, motors: MotorHistories, wanted: Motion, name: str
) -> None:
    """The angle asked for, where another one was commanded."""
    angle, command = getattr(wanted, name), getattr(motors, f"{name}_command")
    steady = cycles >= min(START_UP, 0.5 * cycles[-1])
    if np.abs(angle - command)[steady].max() > LEAST_DIFFERENCE:
        axes.plot(cycles, np.degrees(angle), color=style.GREY, lw=1.0, label=f"{name} asked")


def _draw_servo(rows: Any, cycles: Array, motors: MotorHistories, name: str, colour: str) -> None:
    angle, command = getattr(motors, name), getattr(motors, f"{name}_command")
    rows[0].plot(cycles, np.degrees(angle), color=colour, label=name)
    rows[0].plot(cycles, np.degrees(command), ":", color=style.INK, lw=1.2)
    rows[1].plot(cycles, np.degrees(angle - command), color=colour, lw=1.2)
    rows[2].plot(cycles, getattr(motors, f"{name}_motor_torque"), color=colour, lw=1.2)
    rows[3].plot(cycles, getattr(motors, f"{name}_current"), color=colour, lw=1.2)


def _scale(axes: Axes, cycles: Array) -> None:
    """Limits from what follows the start-up; say what is cut off."""
    steady = cycles >= min(START_UP, 0.5 * cycles[-1])
    lines = [np.asarray(line.get_ydata()) for line in axes.lines]
    drawn = [y for y in lines if y.size == cycles.size]
    most = 1.15 * max(max(np.abs(y[steady]).max() for y in drawn), 1e-12)
    axes.set_ylim(-most, most)
    peak = max(np.abs(y).max() for y in drawn)
    if peak > most:
        words = f"start-up reaches {peak:.2g}"
        axes.set_title(words, loc="right", fontsize=8.0, color=style.GREY, pad=2.0)


def _legend(axes: Axes) -> None:
    axes.plot([], [], ":", color=style.INK, lw=1.2, label="command")
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=5, borderaxespad=0.2)
