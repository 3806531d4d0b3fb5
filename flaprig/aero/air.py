"""One run of the native air: the solver, its memory and the loads on a rigid wing."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from time import perf_counter
from typing import Self

import numpy as np
from numpy.typing import NDArray

from flaprig.aero.models import SWEEP_AMPLITUDE, AirModel
from flaprig.aero.rigid_motion import RigidMotion
from flaprig.fluid import Fluid
from flaprig.native import _native
from flaprig.wing import Wing

Array = NDArray[np.float64]
# called with the fraction done, 0 to 1
Progress = Callable[[float], None]
# seconds between two words of progress, about
_SLICE = 0.2
# words of progress of a run, however quick it is, about
_LEAST = 20


@dataclass(frozen=True, eq=False)
class WingLoads:
    """Force and torque on the wing, wing axes, about the wing frame's origin. Shape (n, 6) each.

    Attributes:
        base: the lattice's potential part without added mass, or translation [N, N m].
        extra: the leading-edge suction, or rotation [N, N m].
        added_mass: minus the added mass times the acceleration [N, N m].
    """

    base: Array
    extra: Array
    added_mass: Array

    @property
    def total(self) -> Array:
        """All parts together [N, N m]."""
        return self.base + self.extra + self.added_mass


class Air:
    """The air around one wing, with its wake; advances by calls of `run`.

    `copy.copy`, `copy.deepcopy` and `pickle` give an air that continues bit for bit, and alone.
    """

    def __init__(
        self,
        wing: Wing,
        fluid: Fluid,
        model: AirModel,
        frequency: float,
        sweep_amplitude: float = SWEEP_AMPLITUDE,
        **attributes: str,
    ) -> None:
        """Still air; further attributes are the plugin's, for instance wind="1 0 0"."""
        settings = model.attributes(wing, fluid, frequency, sweep_amplitude) | attributes
        self.native = _native.Air(model.plugin, settings)
        self.state: Array = np.zeros(self.native.state_size)

    def __copy__(self) -> Self:
        """A copy whose wake goes its own way; it shares the solver, which remembers nothing."""
        twin = object.__new__(type(self))
        twin.__dict__.update(self.__dict__, state=self.state.copy())
        return twin

    def run(self, motion: RigidMotion, step: float, progress: Progress | None = None) -> WingLoads:
        """Loads along the motion, whose instants are step seconds apart.

        Ctrl-C stops it within about a tenth of a second, in the middle of a step too; `state` is
        then as `progress` was last told of it.

        Warns:
            RuntimeWarning: `state` is none that a run leaves behind: its wake is cleared.

        Raises:
            ValueError: a motion without instants, a step that is not above 0.
        """
        if len(motion) == 0:
            raise ValueError("Air.run: motion must have at least one instant, got 0")
        parts = []
        done, size = 0, 1
        while done < len(motion):
            began = perf_counter()
            m = motion.part(slice(done, done + size))
            parts.append(
                self.native.run(self.state, step, m.position, m.rotation, m.twist, m.twist_rate)
            )
            done += len(m)
            if progress is not None:
                progress(done / len(motion))
            # as many steps as go into a slice, by the last one; the wake grows, so not many more
            fitting = round(size * _SLICE / (perf_counter() - began))
            size = max(1, min(fitting, 2 * size, len(motion) // _LEAST))
        base, extra, added = (np.concatenate(columns) for columns in zip(*parts, strict=True))
        return WingLoads(base, extra, added)

    def wake(self) -> tuple[Array, Array]:
        """Wake vertices (rows + 1, strips + 1, 3) [m, world], newest first, and the frozen rings'
        circulation (rows, strips) [m2/s]."""
        return self.native.wake(self.state)

    @property
    def lattice(self) -> Array:
        """Corners of the bound rings in wing axes [m]. Shape (chordwise + 1, spanwise + 1, 3)."""
        return self.native.lattice
