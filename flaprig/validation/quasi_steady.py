"""The quasi-steady model at the limits that Sane & Dickinson and thin-plate theory give it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from flaprig import _checks as check
from flaprig import theory
from flaprig.aero.air import Air, Progress
from flaprig.aero.models import QuasiSteady
from flaprig.aero.rigid_motion import RigidMotion
from flaprig.aero.simulate import simulate
from flaprig.fluid import WATER
from flaprig.strokes import SunTangStroke
from flaprig.strokes.stroke import Motion
from flaprig.validation.flight import FLUID, flight
from flaprig.validation.outcome import Outcome, Row
from flaprig.wing import RIG_WING, Wing

DICKINSON = "Dickinson 1999"
SANE = "Sane & Dickinson 2002"


@dataclass(frozen=True)
class QuasiSteadyLimits:
    """A revolving wing, a rotating and an accelerating strip, and means over a symmetric stroke.

    Attributes:
        angle_deg: angle of attack of the revolving wing.
        pitch_axis: of the rotating strip, from the leading edge [chords].
    """

    name: ClassVar[str] = "quasi-steady"
    claim: ClassVar[str] = "limits of Sane & Dickinson's model"

    angle_deg: float = 45.0
    pitch_axis: float = 0.25

    def run(self, progress: Progress | None = None) -> Outcome:
        """Run the case. ValueError for a parameter out of range."""
        check.in_range(self.name, "angle_deg", self.angle_deg, 0.0, 90.0, "degrees")
        check.in_range(self.name, "pitch_axis", self.pitch_axis, 0.0, 1.0, "chords")
        return Outcome((*self._revolving(), self._rotation(), self._added_mass(), *_means()))

    def _revolving(self) -> list[Row]:
        """A wing that sweeps steadily at constant pitch has the coefficients themselves."""
        pitch = np.full(1, math.radians(90.0 - self.angle_deg))
        zero, one = np.zeros(1), np.ones(1)
        motion = RigidMotion.from_stroke(Motion(zero, zero, pitch, one, zero, zero, zero))
        loads = Air(RIG_WING, FLUID, QuasiSteady(strips=1000), 1.0).run(motion, 1.0)
        force = motion.rotation[0] @ loads.total[0, :3]
        scale = 0.5 * RIG_WING.radius_of_second_moment**2 * RIG_WING.area
        a = self.angle_deg
        lift = 0.225 + 1.58 * math.sin(math.radians(2.13 * a - 7.20))
        drag = 1.92 - 1.55 * math.cos(math.radians(2.04 * a - 9.82))
        return [
            Row(f"revolving at {a:g}°, C_L", force[2] / scale, lift, DICKINSON, 0.01),
            Row(f"revolving at {a:g}°, C_D", -force[1] / scale, drag, DICKINSON, 0.01),
        ]

    def _rotation(self) -> Row:
        """pi (3/4 - x0) rho U omega c^2 of a strip that pitches up in flight."""
        wing = Wing.rectangular(1.0, 1.0, pitch_axis=self.pitch_axis)
        motion = flight(np.zeros(1), 2.0, pitch=(0.2, 0.3, 0.0))
        force = Air(wing, FLUID, QuasiSteady(strips=1), 1.0).run(motion, 1.0).extra[0, 2]
        exact = math.pi * (0.75 - self.pitch_axis) * 2.0 * 0.3
        return Row("rotational force of a strip [N/m]", float(force), exact, SANE, 1e-6)

    def _added_mass(self) -> Row:
        """pi/4 rho c^2 on the normal acceleration at mid-chord."""
        motion = flight(np.zeros(1), 0.0, (0, 0, 2.0), (0, 0, 3.0))
        wing = Wing.rectangular(1.0, 1.0, pitch_axis=0.5)
        force = Air(wing, FLUID, QuasiSteady(strips=1), 1.0).run(motion, 1.0).added_mass[0, 2]
        exact = -2.0 * float(theory.added_mass_per_span(1.0, 1.0))
        return Row("added-mass force of a strip [N/m]", float(force), exact, "Lamb 1932", 1e-6)


def _means() -> list[Row]:
    """Rotation and added mass lift nothing on average over a symmetric stroke."""
    # a pitch axis at mid-chord: ahead of it the added mass has a small mean
    wing = Wing.rectangular(0.25, 0.0625, 0.025, pitch_axis=0.5)
    stroke = SunTangStroke(0.2, math.pi / 3, math.pi / 4)
    result = simulate(wing, stroke, QuasiSteady(), WATER, cycles=1)
    h, force = result.histories, result.reference_force
    assert h.lift_extra is not None and h.lift_added_mass is not None
    parts = (("rotation", h.lift_extra), ("added mass", h.lift_added_mass))
    return [
        Row(f"mean C_L of the {name}", float(part.mean() / force), 0.0, SANE, 1e-9, False)
        for name, part in parts
    ]
