"""Any file of a stroke: JSON of a formula, or a record of angles, which has one reader."""

from __future__ import annotations

import os
import warnings
from pathlib import Path

from flaprig.logs.rig_log import read_log
from flaprig.strokes.formulas import is_formula, load_formula
from flaprig.strokes.stroke import Stroke


def load(path: str | os.PathLike[str]) -> Stroke:
    """The stroke in a file that a stroke's `save` wrote, in one of the same form, or in a log.

    JSON: {"stroke": "sun_tang" or "fourier", "parameters": {fields in Hz, rad, cycles}}. Anything
    else is read by `flaprig.read_log`, which also tells the other columns and how the stroke
    was fitted; here each of its doubts is a warning.

    Raises:
        FileNotFoundError: there is no such file.
        ValueError: one sentence that says what in the file is wrong.
    """
    file = Path(path)
    if is_formula(file):
        return load_formula(file)
    log = read_log(file)
    for doubt in log.doubts:
        warnings.warn(f"{file}: {doubt}", stacklevel=2)
    return log.stroke
