"""Pictures of strokes: sweep and pitch over one cycle, as the paper's figures 4 and 8."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from flaprig.report import style
from flaprig.strokes import Stroke, SunTangStroke

# instants of a cycle in a picture
POINTS = 400
# reversals of the paper's measured kinematics [cycles]: section 2.2
DURATIONS = (0.16, 0.32, 0.50)


def draw_strokes(path: Path, strokes: Mapping[str, Stroke], title: str) -> None:
    """Sweep and pitch of several strokes in degrees, one panel each (paper, figure 8)."""
    phase = np.linspace(0.0, 1.0, POINTS + 1)
    with style.figure(8.0, 3.4) as drawing:
        panels = drawing.subplots(1, 2, sharex=True)
        for panel, angle in zip(panels, ("sweep", "pitch"), strict=True):
            for colour, (name, stroke) in zip(_colours(), strokes.items(), strict=False):
                values = np.degrees(getattr(stroke.motion(phase * stroke.period), angle))
                panel.plot(phase, values, color=colour, label=name)
            panel.set(xlim=(0, 1), xticks=np.linspace(0, 1, 5), xlabel="time over period $t/T$")
            panel.xaxis.set_major_formatter("{x:g}")
            panel.set_ylabel(f"{angle} [°]")
        panels[0].legend(loc="best")
        drawing.suptitle(title, x=0.01, ha="left", fontsize=11.5)
        style.save(drawing, path)


def draw_profiles(path: Path, sinusoid: Stroke) -> None:
    """The profiles of the nine measured kinematics (paper, figure 4)."""
    sizes = sinusoid.frequency, sinusoid.sweep_amplitude, sinusoid.pitch_amplitude
    strokes = {f"reversal {d:.2f} T": SunTangStroke(*sizes, d, d) for d in DURATIONS}
    draw_strokes(path, strokes, "Profiles of sweep and pitch by the length of the reversal")


def _colours() -> tuple[str, ...]:
    return (style.INK, style.BLUE, style.VERMILION, style.GREEN, style.PURPLE)
