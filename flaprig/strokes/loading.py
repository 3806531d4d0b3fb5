"""Read a stroke back from its file: JSON for formula strokes, CSV for samples."""

from __future__ import annotations

import json
import os
from dataclasses import MISSING, fields
from pathlib import Path

from flaprig.strokes.fourier import FourierStroke
from flaprig.strokes.sampled import HEADER, SampledStroke
from flaprig.strokes.stroke import Stroke
from flaprig.strokes.sun_tang import SunTangStroke

# formula strokes by the name in their file
FORMULAS: dict[str, type[SunTangStroke] | type[FourierStroke]] = {
    "sun_tang": SunTangStroke,
    "fourier": FourierStroke,
}


def load(path: str | os.PathLike[str]) -> Stroke:
    """The stroke in a file that a stroke's `save` wrote, or in a hand-made one of the same form.

    JSON: {"stroke": "sun_tang" or "fourier", "parameters": {fields in Hz, rad, cycles}}.
    CSV: header time_s,sweep_rad,pitch_rad and one row a sample.

    Raises:
        FileNotFoundError: there is no such file.
        ValueError: one sentence that says what in the file is wrong.
    """
    file = Path(path)
    try:
        text = file.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError:
        raise ValueError(f"{file}: a stroke file must be UTF-8 text") from None
    try:
        return _from_json(text) if text.lstrip().startswith("{") else _from_csv(text)
    except ValueError as error:
        raise ValueError(f"{file}: {error}") from None


def _from_json(text: str) -> Stroke:
    try:
        document = json.loads(text)
    except RecursionError:
        raise ValueError("the JSON must not be nested so deeply") from None
    except json.JSONDecodeError as error:
        raise ValueError(f"not valid JSON: {error}") from None
    name, values = document.get("stroke"), document.get("parameters")
    kind = FORMULAS.get(name) if isinstance(name, str) else None
    if kind is None:
        raise ValueError(f'"stroke" must be one of {", ".join(FORMULAS)}, got {name!r}')
    if not isinstance(values, dict):
        raise ValueError('"parameters" must be an object of names and values')
    known = [field.name for field in fields(kind)]
    needed = [field.name for field in fields(kind) if field.default is MISSING]
    wrong = [key for key in values if key not in known]
    missing = [key for key in needed if key not in values]
    if wrong or missing:
        complaint = f"unknown {wrong}" if wrong else f"missing {missing}"
        raise ValueError(f'"parameters" of {name} must be {", ".join(known)}; {complaint}')
    return kind(**values)


def _from_csv(text: str) -> SampledStroke:
    lines = text.splitlines()
    header = lines[0].replace(" ", "") if lines else ""
    if header != HEADER:
        raise ValueError(f"a stroke file must be JSON or start with {HEADER}, got {header[:60]!r}")
    rows = [_row(number, line) for number, line in enumerate(lines[1:], 2) if line.strip()]
    columns = list(zip(*rows, strict=True)) or [(), (), ()]
    return SampledStroke(*columns)


def _row(number: int, line: str) -> tuple[float, float, float]:
    try:
        time, sweep, pitch = (float(cell) for cell in line.split(","))
    except ValueError:
        raise ValueError(f"line {number} must be three numbers, got {line[:60]!r}") from None
    return time, sweep, pitch
