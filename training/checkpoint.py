"""Checkpoints: one file that appears whole or not at all, read back without executing anything.

The file is torch's format restricted to tensors, numbers, texts, lists and dictionaries; whatever
else is in a file from elsewhere, reading refuses it (`weights_only`).
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import torch

from flaprig.files import written_whole
from training.export import check_size

# raised when the meaning of a file changes
VERSION = 1
# most that a checkpoint may hold, unpacked: a hundred times one of 4096 environments [bytes]
MOST_BYTES = 2**30
# key under which a value is wrapped that torch's restricted format does not know
_ARRAY, _JSON = "__array__", "__json__"


def packed(value: Any) -> Any:
    """The value made of tensors, numbers, texts, lists and dictionaries only.

    Raises:
        TypeError: something else is in it.
    """
    if isinstance(value, dict):
        if any(isinstance(v, int) and abs(v) >= 2**63 for v in value.values()):
            return {_JSON: json.dumps(value)}
        return {key: packed(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [packed(item) for item in value]
    if isinstance(value, np.ndarray):
        return {_ARRAY: torch.from_numpy(_signed(value).copy()), "dtype": str(value.dtype)}
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, torch.Tensor | int | float | str) or value is None:
        return value
    raise TypeError(f"a checkpoint cannot hold a {type(value).__name__}")


def unpacked(value: Any) -> Any:
    """What was packed; tuples come back as lists."""
    if isinstance(value, dict):
        if _ARRAY in value:
            return value[_ARRAY].numpy().astype(value["dtype"])
        if _JSON in value:
            return json.loads(value[_JSON])
        return {key: unpacked(item) for key, item in value.items()}
    return [unpacked(item) for item in value] if isinstance(value, list) else value


def _signed(array: np.ndarray) -> np.ndarray:
    """Old torch knows few unsigned types: wider signed ones carry them."""
    return array.astype(np.int64) if array.dtype.kind == "u" else array


def write(path: Path, state: dict[str, Any]) -> None:
    """Write a checkpoint; a kill at any instant leaves the former file or the new one.

    Raises:
        OSError: the file cannot be written.
    """
    with written_whole(path) as draft:
        torch.save({"version": VERSION, **packed(state)}, draft)


def read(path: Path) -> dict[str, Any]:
    """The state in a checkpoint; nothing in the file is executed.

    Raises:
        FileNotFoundError: there is no such file.
        ValueError: not a checkpoint of this program, or of another version.
    """
    if not path.is_file():
        raise FileNotFoundError(f"there is no checkpoint {path}")
    check_size(path, MOST_BYTES)
    try:
        state = torch.load(path, map_location="cpu", weights_only=True)
    except MemoryError:
        raise
    except Exception:
        # torch would tell how to switch the safety off
        why = "it is damaged, or it holds more than numbers and texts"
        raise ValueError(f"{path} is no checkpoint that can be read safely: {why}") from None
    if not isinstance(state, dict) or state.get("version") != VERSION:
        raise ValueError(f"{path} is no checkpoint of version {VERSION}")
    return unpacked(state)


def random_state() -> dict[str, Any]:
    """State of the generators that SB3 draws from: torch's and numpy's global ones."""
    _, keys, position, has_gauss, gauss = np.random.get_state()  # noqa: NPY002
    return {
        "torch": torch.get_rng_state(),
        "numpy": {"keys": keys, "position": position, "has_gauss": has_gauss, "gauss": gauss},
    }


def set_random_state(state: dict[str, Any]) -> None:
    """Continue from what `random_state` gave."""
    torch.set_rng_state(state["torch"])
    n = state["numpy"]
    numbers = (np.asarray(n["keys"], np.uint32), n["position"], n["has_gauss"], n["gauss"])
    np.random.set_state(("MT19937", *numbers))  # noqa: NPY002
