"""The rig of the paper's Figures 2 and 3 as a MuJoCo model, or another lab's: its file.

The file is the truth: wing, fluid, servos and model of the fluid are read from it, and only what
was asked for is written into it, so that whatever Python has no name for stays as it is.
"""

from __future__ import annotations

import os
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from flaprig import _checks as check
from flaprig._paths import RIG_XML
from flaprig.aero.models import UVLM, QuasiSteady
from flaprig.fluid import Fluid
from flaprig.motors import Motors
from flaprig.native import library
from flaprig.rig.document import Document
from flaprig.rig.numbers import Read, RigNumbers, read
from flaprig.rig.writing import written
from flaprig.strokes import Stroke
from flaprig.wing import Wing

# what a Rig holds of its file, and what `with_` may change
_NAMES = tuple(RigNumbers.__dataclass_fields__)
# fields of a compiled model that only say in which words the file has its numbers
_WORDS = (
    *("plugin_attr", "npluginattr", "numeric", "nnumeric", "name", "nname"),
    *("paths", "signature", "nbuffer", "opt"),
)


@dataclass(frozen=True, init=False, eq=False)
class Rig:
    """One rig: its file, and what the file says in numbers.

    Two rigs are equal when their numbers and their compiled models are.

    Args:
        path: the MJCF file.
        wing: as below, and so on: what is asked for is written over what the file says; None
            keeps the file's.

    Attributes:
        path: the file that the rig came from.
        wing: the plate on the pitch shaft: the plugin's planform, the density of the geom `plate`.
        fluid: what the wing moves in.
        motors: the sweep and the pitch servo.
        model: the model of the fluid's forces, UVLM or QuasiSteady.
        frequency: of the stroke that the rig is to run, in [Hz]; sets the clock of the wake.
        sweep_amplitude: half of its peak-to-peak sweep in [rad]; with the frequency it sets the
            Reynolds number, for models of the fluid that ask for one.
        buoyancy: whether the displaced fluid carries the plate, as it does in a tank.
        notices: what the file does not say, and what was taken instead, a sentence each.
        document: the file's text with what was asked for.

    Raises:
        FileNotFoundError: there is no such file.
        ImportError: the plugin library is missing or does not fit MuJoCo.
        ValueError: an attribute of the wrong type, a number that is not positive, or a file that
            is no rig's; the sentence says what a rig's file must have.
    """

    path: Path
    wing: Wing
    fluid: Fluid
    motors: Motors
    model: UVLM | QuasiSteady
    frequency: float
    sweep_amplitude: float
    buoyancy: bool
    notices: tuple[str, ...] = field(init=False, repr=False)
    document: Document = field(init=False, repr=False)

    def __init__(
        self,
        path: str | os.PathLike[str] = RIG_XML,
        wing: Wing | None = None,
        fluid: Fluid | None = None,
        motors: Motors | None = None,
        model: UVLM | QuasiSteady | None = None,
        frequency: float | None = None,
        sweep_amplitude: float | None = None,
        buoyancy: bool | None = None,
    ) -> None:
        given = (wing, fluid, motors, model, frequency, sweep_amplitude, buoyancy)
        changes = {n: v for n, v in zip(_NAMES, given, strict=True) if v is not None}
        if not isinstance(path, str | os.PathLike):
            raise check.fail("Rig", "path", "a path", path)
        file = Path(path)
        if not file.is_file():
            raise FileNotFoundError(f"Rig.load: there is no file {file}")
        document = Document.read(file)
        self._become(file, document, _understood(document, file), changes)

    @classmethod
    def load(cls, path: str | os.PathLike[str] = RIG_XML) -> Rig:
        """The rig of the paper, or that of another file.

        Raises:
            FileNotFoundError: there is no such file.
            ImportError: the plugin library is missing or does not fit MuJoCo.
            ValueError: the file is no rig's: one sentence says what it must have, lacks and has,
                where it contradicts itself, or which of its numbers is out of range.
        """
        return cls(path)

    def with_(self, **changes: Any) -> Rig:
        """A new rig with wing, fluid, motors, model, frequency and so on changed.

        Only what differs from the file is written into it.

        Raises:
            ValueError: a name that a rig does not have, a bad value, or one that this file cannot
                be given.
        """
        for name in changes:
            if name not in _NAMES:
                raise check.fail("Rig.with_", "argument", f"one of {', '.join(_NAMES)}", name)
        other = object.__new__(type(self))
        other._become(self.path, self.document, Read(self.numbers, self.notices), changes)
        return other

    def running(self, stroke: Stroke) -> Rig:
        """The rig set to a stroke's frequency and sweep amplitude."""
        return self.with_(frequency=stroke.frequency, sweep_amplitude=stroke.sweep_amplitude)

    @property
    def numbers(self) -> RigNumbers:
        """All that the file says."""
        return RigNumbers(*(getattr(self, name) for name in _NAMES))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the rig's file, whole or not at all; it loads to an equal rig.

        Raises:
            ValueError: an ending other than .xml.
            OSError: the folder does not exist or cannot be written.
        """
        file = Path(path)
        if file.suffix != ".xml":
            raise check.fail("Rig.save", "path", "one that ends in .xml", str(file))
        self.document.save(file)

    def spec(self) -> mujoco.MjSpec:
        """The rig as an editable MuJoCo specification, not yet compiled.

        Raises:
            ImportError: the plugin library is missing or does not fit MuJoCo.
        """
        library.load()
        return self.document.spec()

    def compile(self) -> mujoco.MjModel:
        """The compiled model, with joint stops that know the water's added mass.

        Raises:
            ImportError: the plugin library is missing or does not fit MuJoCo.
            ValueError: a file that the rig's names is no longer there.
        """
        model = self.spec().compile()
        weigh_stops(model)
        return model

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Rig):
            return NotImplemented
        if self.document == other.document:
            return True
        return self.numbers == other.numbers and _same_models(
            self.spec().compile(), other.spec().compile()
        )

    def __hash__(self) -> int:
        return hash(self.numbers)

    def _become(self, path: Path, document: Document, found: Read, changes: dict[str, Any]) -> None:
        """Take the values of a file and what is changed in it."""
        new = replace(found.numbers, **changes)
        if new != found.numbers:
            document = written(document, found.numbers, new)
            reread = _understood(document, path)
            for name in _NAMES:
                if getattr(reread.numbers, name) != getattr(new, name):
                    allowed = "one that this file can be given"
                    raise check.fail("Rig", name, allowed, getattr(new, name))
            found = reread
        values = {"path": path, "notices": found.notices, "document": document}
        for name, value in (values | {n: getattr(new, n) for n in _NAMES}).items():
            object.__setattr__(self, name, value)


@lru_cache(maxsize=64)
def _read_once(document: Document) -> Read:
    return read(document)


def _understood(document: Document, path: Path) -> Read:
    """What a document says; what is wrong in it as one sentence that names the file."""
    library.load()
    try:
        return _read_once(document)
    except (ValueError, mujoco.FatalError) as error:
        words = " ".join(str(error).split())
        raise ValueError(f"Rig.load: {path}: {words}") from None


def _same_models(one: mujoco.MjModel, two: mujoco.MjModel) -> bool:
    """Whether two models are the same in all numbers."""
    fields = [n for n in dir(one) if not n.startswith("_") and not n.startswith(_WORDS)]
    pairs = [(getattr(one, name), getattr(two, name)) for name in fields]
    return all(
        np.array_equal(a, b) for a, b in pairs if isinstance(a, np.ndarray | int | float)
    ) and _options(one) == _options(two)


def _options(model: mujoco.MjModel) -> list[Any]:
    names = [n for n in dir(model.opt) if not n.startswith("_")]
    return [np.asarray(getattr(model.opt, name)).tolist() for name in names]


def weigh_stops(model: mujoco.MjModel) -> None:
    """Set the constraint weights of the degrees of freedom to the diagonal of M^-1.

    MuJoCo computes them from rigid inertia alone, which leaves the joint stops up to 500 times
    too soft in water; the plugin's added mass is in M after a forward pass. Changes the model.
    """
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    inverse = np.zeros((model.nv, model.nv))
    mujoco.mj_solveM(model, data, inverse, np.eye(model.nv))
    model.dof_invweight0[:] = np.diag(inverse)
