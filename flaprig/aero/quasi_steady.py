"""Quasi-steady blade elements as frozen settings."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from flaprig import _checks as check
from flaprig.aero.air_model import SWEEP_AMPLITUDE, geometry_attributes, reynolds_number
from flaprig.aero.coefficients import DICKINSON_1999, Coefficients
from flaprig.fluid import Fluid
from flaprig.wing import Wing


@dataclass(frozen=True)
class QuasiSteady:
    """Quasi-steady blade elements (Dickinson 1999; Sane & Dickinson 2002).

    Attributes:
        coefficients: translational lift and drag.
        strips: blade elements along the span, 1 to 1000.
        steps_per_cycle: instants per cycle at which `simulate` reports loads.
        rotation: whether the rotational force is in.
        added_mass: whether the added mass is in.

    Raises:
        ValueError: a setting out of its range.
    """

    coefficients: Coefficients = DICKINSON_1999
    strips: int = 24
    steps_per_cycle: int = 200
    rotation: bool = True
    added_mass: bool = True
    plugin: ClassVar[str] = "flaprig.quasi_steady"
    parts: ClassVar[tuple[str, str]] = ("translation", "rotation")

    def __post_init__(self) -> None:
        owner = "QuasiSteady"
        if not isinstance(self.coefficients, Coefficients):
            allowed = "DICKINSON_1999, LEE_2016 or Coefficients.from_table(...)"
            raise check.fail(owner, "coefficients", allowed, self.coefficients)
        check.whole(owner, "strips", self.strips, 1, 1000)
        check.whole(owner, "steps_per_cycle", self.steps_per_cycle, 4, 100_000)
        for name in ("rotation", "added_mass"):
            if not isinstance(getattr(self, name), bool):
                raise check.fail(owner, name, "True or False", getattr(self, name))

    @property
    def label(self) -> str:
        """What people call the model."""
        return "quasi-steady"

    def attributes(
        self, wing: Wing, fluid: Fluid, frequency: float, sweep_amplitude: float = SWEEP_AMPLITUDE
    ) -> dict[str, str]:
        """The attributes of the plugin `flaprig.quasi_steady` with these settings.

        Args:
            wing: the wing.
            fluid: the fluid.
            frequency: strokes per second in [Hz].
            sweep_amplitude: half of the peak-to-peak sweep in [rad]; with the frequency it sets
                the Reynolds number of Lee et al. 2016, at the mean speed of R2.
        """
        check.positive("QuasiSteady", "frequency", frequency, "Hz")
        settings = geometry_attributes(wing, fluid) | {
            "strips": str(self.strips),
            "coefficients": self.coefficients.name,
            "rotation": str(self.rotation).lower(),
            "added_mass": str(self.added_mass).lower(),
        }
        if self.coefficients.table:
            rows = (repr(x) for row in self.coefficients.table for x in row)
            settings["coefficient_table"] = " ".join(rows)
        if self.coefficients.name == "lee2016":
            reynolds = reynolds_number(wing, fluid, frequency, sweep_amplitude)
            settings["reynolds"] = repr(reynolds)
        return settings
