"""Quasi-steady blade elements as frozen settings."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar, Self

from flaprig import _checks as check
from flaprig.aero.air_model import SWEEP_AMPLITUDE, geometry_attributes, given, reynolds_number
from flaprig.aero.coefficients import DICKINSON_1999, LEE_2016, Coefficients
from flaprig.fluid import Fluid
from flaprig.wing import Wing

# share by which a Reynolds number in a file may be rounded
_SAME_REYNOLDS = 0.01


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

    def numerics(self) -> dict[str, tuple[float, ...]]:
        """Instants per cycle, of which the plugin knows nothing."""
        return {"steps_per_cycle": (float(self.steps_per_cycle),)}

    @classmethod
    def from_attributes(
        cls,
        attributes: Mapping[str, str],
        numerics: Mapping[str, tuple[float, ...]],
        frequency: float,
        reynolds: float,
    ) -> Self:
        """The settings of a model file; a Reynolds number of another motion is refused."""
        usual = cls()
        steps = numerics.get("steps_per_cycle", (usual.steps_per_cycle,))[0]
        words = {
            name: attributes.get(name, "").strip() or "true" for name in ("rotation", "added_mass")
        }
        return cls(
            coefficients=_coefficients(attributes, reynolds),
            strips=int(given(attributes, "strips", usual.strips)),
            steps_per_cycle=check.whole("QuasiSteady", "steps_per_cycle", steps, 4, 100_000),
            **{name: word == "true" for name, word in words.items()},
        )


def _coefficients(attributes: Mapping[str, str], reynolds: float) -> Coefficients:
    name = attributes.get("coefficients", "").strip() or DICKINSON_1999.name
    if name == "table":
        rows = [float(word) for word in attributes.get("coefficient_table", "").split()]
        return Coefficients.from_table(rows[::3], rows[1::3], rows[2::3])
    if name != LEE_2016.name:
        return DICKINSON_1999
    written = given(attributes, "reynolds", math.nan)
    if not math.isclose(written, reynolds, rel_tol=_SAME_REYNOLDS):
        allowed = (
            f"{reynolds:.6g}, which frequency, sweep_amplitude and kinematic_viscosity of the same "
            "file give"
        )
        raise check.fail("QuasiSteady", "reynolds", allowed, written)
    return LEE_2016
