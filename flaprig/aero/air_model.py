"""What every model of the air offers: settings that a run and the plugins read."""

from __future__ import annotations

import math
from typing import ClassVar, Protocol, runtime_checkable

from flaprig.fluid import Fluid
from flaprig.wing import Wing

# half sweep amplitude where only a frequency is known [rad]: the paper's 60 degrees
SWEEP_AMPLITUDE = math.pi / 3


@runtime_checkable
class AirModel(Protocol):
    """An air model, as settings."""

    # name of the MuJoCo plugin, and of the two parts that its loads are kept in
    plugin: ClassVar[str]
    parts: ClassVar[tuple[str, str]]

    @property
    def label(self) -> str:
        """What people call the model."""
        ...

    @property
    def steps_per_cycle(self) -> int:
        """Instants per cycle at which the model works."""
        ...

    def attributes(
        self, wing: Wing, fluid: Fluid, frequency: float, sweep_amplitude: float = SWEEP_AMPLITUDE
    ) -> dict[str, str]:
        """The attributes of the MuJoCo plugin with these settings."""
        ...


def geometry_attributes(wing: Wing, fluid: Fluid) -> dict[str, str]:
    """Attributes that both plugins share: planform, thickness, the fluid's density and wind."""
    return {
        "stations": " ".join(repr(float(x)) for x in wing.stations.ravel()),
        "thickness": repr(wing.thickness),
        "density": repr(fluid.density),
        "wind": " ".join(repr(speed) for speed in fluid.wind),
    }


def reynolds_number(wing: Wing, fluid: Fluid, frequency: float, sweep_amplitude: float) -> float:
    """Mean speed at R2, 4 f phi0 R2, times the mean chord, over the kinematic viscosity."""
    speed = 4.0 * frequency * sweep_amplitude * wing.radius_of_second_moment
    return float(speed * wing.mean_chord / fluid.kinematic_viscosity)
