"""Records as labs bring them: the paper's sinusoid, rounded to counts, in all kinds of files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from flaprig.strokes import SunTangStroke

Array = NDArray[np.float64]

# of one turn of the encoder, and one of them in degrees
COUNTS = 4096
COUNT = 360.0 / COUNTS
SINUSOID = SunTangStroke(0.2, np.pi / 3, np.pi / 4)
HEADER = "time_s,sweep_deg,pitch_deg"


def clock(cycles: float = 6.0, rate: float = 50.0, jitter: float = 0.0, seed: int = 1) -> Array:
    """Instants of a logger with a rate in [Hz]; jitter is a share of the step. Shape (n,)."""
    steps = np.arange(round(cycles * rate / 0.2))
    return (steps + jitter * np.random.default_rng(seed).uniform(-1.0, 1.0, steps.size)) / rate


def angles(
    time: Array, stroke: SunTangStroke = SINUSOID, noise: float = 0.0, seed: int = 2
) -> tuple[Array, Array]:
    """Sweep and pitch in degrees, with noise in [rad], rounded to counts."""
    motion, rng = stroke.motion(time), np.random.default_rng(seed)
    sweep, pitch = (
        COUNT * np.rint(np.degrees(angle + noise * rng.standard_normal(time.size)) / COUNT)
        for angle in (motion.sweep, motion.pitch)
    )
    return sweep, pitch


def text(*columns: Array, header: str = HEADER, delimiter: str = ",", form: str = "%.6f") -> str:
    """A table as text."""
    rows = [delimiter.join(form % value for value in row) for row in np.column_stack(columns)]
    return "\n".join([header, *rows, ""])


def written(path: Path, content: str, encoding: str = "utf-8") -> Path:
    """The file."""
    path.write_bytes(content.encode(encoding))
    return path
