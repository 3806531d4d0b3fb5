"""Formula strokes in their JSON files."""

from __future__ import annotations

import json
from dataclasses import MISSING, fields
from pathlib import Path

from flaprig.strokes.fourier import FourierStroke
from flaprig.strokes.sun_tang import SunTangStroke

# formula strokes by the name in their file
FORMULAS: dict[str, type[SunTangStroke] | type[FourierStroke]] = {
    "sun_tang": SunTangStroke,
    "fourier": FourierStroke,
}


def is_formula(path: Path) -> bool:
    """Whether a file holds JSON, by its first letter.

    Raises:
        OSError: the file cannot be read.
    """
    with open(path, "rb") as stream:
        return stream.read(1000).lstrip(b"\xef\xbb\xbf \t\r\n").startswith((b"{", b"["))


def load_formula(path: Path) -> SunTangStroke | FourierStroke:
    """The stroke in a JSON file that a formula stroke's `save` wrote.

    {"stroke": "sun_tang" or "fourier", "parameters": {fields in Hz, rad, cycles}}.

    Raises:
        FileNotFoundError: there is no such file.
        ValueError: one sentence that says what in the file is wrong.
    """
    try:
        text = path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError:
        raise ValueError(f"{path}: a stroke file must be UTF-8 text") from None
    try:
        return _from_json(text)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None


def _from_json(text: str) -> SunTangStroke | FourierStroke:
    try:
        document = json.loads(text)
    except RecursionError:
        raise ValueError("the JSON must not be nested so deeply") from None
    except json.JSONDecodeError as error:
        raise ValueError(f"not valid JSON: {error}") from None
    if not isinstance(document, dict) or "stroke" not in document:
        held = ", ".join(map(str, document)) if isinstance(document, dict) else "a list"
        raise ValueError(
            f'"stroke" must be one of {", ".join(FORMULAS)}, got None: a JSON of a stroke holds '
            f'"stroke" and "parameters", and this one holds {held[:80] or "nothing"}; a servo\'s '
            "log is read as a table with the columns time_s, sweep_deg (or _rad, _count) and "
            "pitch_deg alike"
        )
    name, values = document["stroke"], document.get("parameters")
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
