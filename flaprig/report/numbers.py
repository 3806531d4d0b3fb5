"""Numbers as JSON: one object, NaN and infinity as null."""

from __future__ import annotations

import json
from typing import Any

from flaprig.files import plain

__all__ = ["as_json", "plain"]


def as_json(value: dict[str, Any]) -> str:
    """The object as indented JSON text, without a line feed at the end."""
    return json.dumps(plain(value), indent=2, allow_nan=False)
