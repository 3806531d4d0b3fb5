"""Numbers as JSON: one object, NaN and infinity as null."""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np


def plain(value: Any) -> Any:
    """The value made of dict, list, str, int, float, bool and None only."""
    if isinstance(value, dict):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, np.ndarray | np.generic):
        return plain(value.tolist())
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def as_json(value: dict[str, Any]) -> str:
    """The object as indented JSON text, without a line feed at the end."""
    return json.dumps(plain(value), indent=2, allow_nan=False)
