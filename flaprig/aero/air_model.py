"""What every model of the air offers: settings that a run and the plugins read."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import ClassVar, Protocol, Self, runtime_checkable

from flaprig.fluid import WATER, Fluid
from flaprig.wing import PITCH_AXIS, PLATE_THICKNESS, Wing

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

    def numerics(self) -> dict[str, tuple[float, ...]]:
        """Settings that attributes hold rounded or not at all, by name in `<custom>` of a file."""
        ...

    @classmethod
    def from_attributes(
        cls,
        attributes: Mapping[str, str],
        numerics: Mapping[str, tuple[float, ...]],
        frequency: float,
        reynolds: float,
    ) -> Self:
        """The settings that a model file has: the inverse of `attributes` and `numerics`.

        Args:
            attributes: of the plugin's instance; those left out have the plugin's defaults.
            numerics: by name; one that the attributes contradict does not count.
            frequency: that the file's wake_step is meant for in [Hz].
            reynolds: at that frequency, as `reynolds_number` gives it.

        Raises:
            ValueError: a setting out of its range.
        """
        ...


def geometry_attributes(wing: Wing, fluid: Fluid) -> dict[str, str]:
    """Attributes that both plugins share: planform, thickness, the fluid's density and wind."""
    return {
        "stations": " ".join(repr(float(x)) for x in wing.stations.ravel()),
        "thickness": repr(wing.thickness),
        "density": repr(fluid.density),
        "wind": " ".join(repr(speed) for speed in fluid.wind),
    }


def given(attributes: Mapping[str, str], name: str, default: float) -> float:
    """A number among text attributes; an empty one counts as left out."""
    text = attributes.get(name, "").strip()
    return float(text) if text else default


def geometry(attributes: Mapping[str, str]) -> tuple[Wing, Fluid]:
    """The wing and the fluid that `geometry_attributes` has written, or that a file says.

    The plate's density and the viscosity are no attributes: acrylic and water stand in for them.

    Raises:
        ValueError: a number out of range.
    """
    stations = tuple(map(float, attributes.get("stations", "").split()))
    if stations:
        radius, chord, leading = (stations[k::3] for k in range(3))
    else:
        root, length = given(attributes, "root_offset", 0.0), given(attributes, "chord", 0.0)
        radius = (root, root + given(attributes, "span", 0.0))
        chord = (length, length)
        leading = (-given(attributes, "pitch_axis", PITCH_AXIS) * length,) * 2
    wing = Wing(radius, chord, leading, given(attributes, "thickness", PLATE_THICKNESS))
    wind = tuple(map(float, attributes.get("wind", "").split())) or WATER.wind
    density = given(attributes, "density", WATER.density)
    return wing, Fluid(density, WATER.kinematic_viscosity, wind)  # type: ignore[arg-type]


def reynolds_number(wing: Wing, fluid: Fluid, frequency: float, sweep_amplitude: float) -> float:
    """Mean speed at R2, 4 f phi0 R2, times the mean chord, over the kinematic viscosity."""
    speed = 4.0 * frequency * sweep_amplitude * wing.radius_of_second_moment
    return float(speed * wing.mean_chord / fluid.kinematic_viscosity)
