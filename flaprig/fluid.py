"""The fluid around the wing: density and viscosity, constant and incompressible."""

from __future__ import annotations

from dataclasses import dataclass

from flaprig import _checks as check

# acceleration of gravity [m/s2]: that of models/rig.xml
GRAVITY = 9.81
# fastest wind that the native code accepts [m/s]
MOST_WIND = 1000.0


@dataclass(frozen=True)
class Fluid:
    """An incompressible fluid.

    Attributes:
        density: mass density in [kg/m3], positive.
        kinematic_viscosity: viscosity over density in [m2/s], positive.
        wind: uniform velocity of the undisturbed fluid, world axes, in [m/s]. Length 3.

    Raises:
        ValueError: a density or viscosity that is not a positive finite number, or a wind that is
            not three numbers within 1000 m/s.
    """

    density: float
    kinematic_viscosity: float
    wind: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        density = check.positive("Fluid", "density", self.density, "kg/m3")
        viscosity = check.positive("Fluid", "kinematic_viscosity", self.kinematic_viscosity, "m2/s")
        object.__setattr__(self, "density", density)
        object.__setattr__(self, "kinematic_viscosity", viscosity)
        wind = check.array("Fluid", "wind", self.wind, "m/s", length=3, most=MOST_WIND)
        object.__setattr__(self, "wind", tuple(wind.tolist()))

    @property
    def dynamic_viscosity(self) -> float:
        """Density times kinematic viscosity in [Pa s]."""
        return self.density * self.kinematic_viscosity


# water of the tank: 1000 kg/m3 and 1.0e-6 m2/s (20 degrees Celsius, rounded), the values that
# give the printed Reynolds number 1.4e4 in equation 7 of the paper
WATER = Fluid(density=1000.0, kinematic_viscosity=1.0e-6)

# air at sea level, 15 degrees Celsius: International Standard Atmosphere (ISO 2533:1975),
# 1.225 kg/m3 and 1.4607e-5 m2/s, rounded to three figures
AIR = Fluid(density=1.225, kinematic_viscosity=1.46e-5)
