"""JSON text: plain types only, NaN as null."""

from __future__ import annotations

import json
import math

import numpy as np

from flaprig.report.numbers import as_json, plain


def test_nan_and_infinity_are_null() -> None:
    text = as_json({"a": math.nan, "b": [math.inf, 1.5], "c": np.float64("nan")})
    assert json.loads(text) == {"a": None, "b": [None, 1.5], "c": None}


def test_numpy_becomes_plain() -> None:
    value = {"array": np.array([[1.0, np.nan]]), "count": np.int64(3), "pair": (True, None)}
    assert plain(value) == {"array": [[1.0, None]], "count": 3, "pair": [True, None]}
    assert type(plain(np.int64(3))) is int and type(plain(np.bool_(True))) is bool
