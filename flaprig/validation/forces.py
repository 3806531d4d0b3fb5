"""Mean forces of the extended lattice in the slope of its suction law, in which they are linear."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from flaprig.aero.air_model import reynolds_number
from flaprig.aero.models import UVLM, SuctionLaw
from flaprig.aero.simulate import simulate
from flaprig.fluid import WATER, Fluid
from flaprig.strokes import Stroke
from flaprig.validation.measured_file import Measured
from flaprig.validation.measured_score import mean_cycle
from flaprig.validation.measuring_chain import OneCycle, reading
from flaprig.validation.paper import LIFT, LIFT_TO_DRAG, SINUSOID
from flaprig.wing import RIG_WING, Wing

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Parts:
    """What is simulated.

    Attributes:
        model: the lattice; its leading-edge suction is replaced.
        law: of slope 1, so that its efficiency multiplies the slope asked for.
        cycles: of each run.
    """

    model: UVLM
    law: SuctionLaw
    cycles: int


@dataclass(frozen=True, eq=False)
class Forces:
    """C_L and C_D, published and after the measuring chain: without leading-edge suction, and what
    each unit of the law's slope adds. Shape (4,) each.

    Attributes:
        plain: without leading-edge suction.
        suction: with a slope of one.
        reference: the measured values.
    """

    plain: Array
    suction: Array
    reference: Array

    def errors(self, slope: float) -> Array:
        """C_L, C_D, L/D published, and the same measured alike, in percent. Shape (6,)."""
        lift, drag, lift_alike, drag_alike = (self.plain + slope * self.suction) / self.reference
        ratios = (lift, drag, lift / drag, lift_alike, drag_alike, lift_alike / drag_alike)
        return 100.0 * (np.array(ratios) - 1.0)


def measured_forces(parts: Parts, case: Measured) -> Forces:
    """Of a measured stroke."""
    plain, suction, _ = _cycles(parts, case.wing, case.stroke, case.fluid)
    both = OneCycle(case.stroke, plain.lift + suction.lift, plain.drag + suction.drag)
    alike, more = reading(case, plain), reading(case, both)
    without = np.array([f.mean() for f in (plain.lift, plain.drag, alike.lift, alike.drag)])
    with_it = np.array([f.mean() for f in (both.lift, both.drag, more.lift, more.drag)])
    force = case.reference_force
    reference = np.tile([case.mean_lift, case.mean_drag], 2)
    return Forces(without / force, (with_it - without) / force, reference)


def paper_forces(parts: Parts) -> Forces:
    """Of the paper's sinusoid, whose balance is not known: published twice."""
    plain, suction, force = _cycles(parts, RIG_WING, SINUSOID, WATER)
    means = [np.array([c.lift.mean(), c.drag.mean()]) / force for c in (plain, suction)]
    reference = np.tile([LIFT, LIFT / LIFT_TO_DRAG], 2)
    return Forces(np.tile(means[0], 2), np.tile(means[1], 2), reference)


def _cycles(
    parts: Parts, wing: Wing, stroke: Stroke, fluid: Fluid
) -> tuple[OneCycle, OneCycle, float]:
    """Mean cycle without leading-edge suction, the suction of slope one, and 0.5 rho U^2 S."""
    speed = stroke.frequency, stroke.sweep_amplitude
    efficiency = parts.law.efficiency(reynolds_number(wing, fluid, *speed))
    model = replace(parts.model, suction_efficiency=0.0)
    plain = simulate(wing, stroke, model, fluid, parts.cycles)
    first = OneCycle(stroke, mean_cycle(plain, plain.lift), mean_cycle(plain, plain.drag))
    if efficiency == 0.0:
        nothing = OneCycle(stroke, 0.0 * first.lift, 0.0 * first.drag)
        return first, nothing, plain.reference_force
    model = replace(parts.model, suction_efficiency=efficiency, side_suction_efficiency=0.0)
    result = simulate(wing, stroke, model, fluid, parts.cycles)
    h = result.histories
    assert h.lift_extra is not None and h.drag_extra is not None
    only = OneCycle(stroke, mean_cycle(result, h.lift_extra), mean_cycle(result, h.drag_extra))
    return first, only, plain.reference_force
