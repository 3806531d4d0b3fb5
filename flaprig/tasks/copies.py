"""Copies that step like their original and share nothing with it."""

from __future__ import annotations

import copy
import pickle
from typing import Any, Self


class Copied:
    """`copy.copy` makes a deep copy: what steps holds states that two must not share."""

    def __copy__(self) -> Self:
        return copy.deepcopy(self)


def packed(mujoco_object: Any) -> bytes:
    """MuJoCo's model or data as bytes; `unpacked` reads them in another process too."""
    return pickle.dumps(mujoco_object)


def unpacked(data: bytes) -> Any:
    """What `packed` wrote; MuJoCo must know the plugins before it reads a model that has one."""
    # the hovering problem with prescribed motion needs no MuJoCo
    from flaprig.native import library

    library.load()
    return pickle.loads(data)
