"""The modified unsteady vortex lattice method as frozen settings."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, ClassVar, Self

from flaprig import _checks as check
from flaprig.aero.air_model import SWEEP_AMPLITUDE, geometry_attributes, given, reynolds_number
from flaprig.aero.suction_law import SuctionLaw
from flaprig.fluid import Fluid
from flaprig.wing import Wing

# suction efficiency of eq. 6 that gives the paper's sinusoid its measured C_L of 1.94 with the
# other defaults below: a calibration on one case, not a prediction (docs/model.md)
SUCTION_EFFICIENCY = 0.70
# the wing meets what it has shed for half a cycle: docs/model.md
WAKE_DETAIL = 0.5
# of the extended lattice, fitted as docs/validation.md says: travel in chords, and the law
EXTENDED_LAG = 0.15
EXTENDED_SUCTION = SuctionLaw(slope=0.36, onset=3000.0)


# defaults of the plugin that are rows and seconds there, cycles and steps here: native/settings.hpp
_WAKE_STEP = 0.05
_ROWS = (("wake_cycles", "wake_rows", 100), ("wake_detail", "wake_detail", 50))


class Rate(StrEnum):
    """How the rate of the circulation is told from the last steps."""

    RAMPED = "ramped"
    BACKWARD = "backward"
    SECOND_ORDER = "second_order"


class Precision(StrEnum):
    """Of the velocities that move the wake; loads always have double precision."""

    SINGLE = "single"
    DOUBLE = "double"


@dataclass(frozen=True)
class UVLM:
    """The modified unsteady vortex lattice method (paper, section 2.1).

    Attributes:
        chordwise: panels along the chord, 1 to 64.
        spanwise: panels along the span, 1 to 128; at most 1024 panels together.
        steps_per_cycle: wake rows shed in one cycle.
        suction_efficiency: eta_s of eq. 6, or how it depends on the Reynolds number; the default
            is calibrated on the paper's sinusoid.
        suction_factor: 1 for eq. 6 as printed, 4/pi to make eta_s = 1 the exact flat-plate
            suction (the lattice returns pi/4 of it).
        wake_cycles: length of the wake kept, in cycles.
        wake_detail: age in cycles up to which the wake convects itself with all its velocities at
            every step. Older rows are moved by velocities found every second step and, at twice
            that age, every fourth; there rows merge into longer ones, too, and the cost of a step
            stays nearly the same however long the wake is. 0 for brute force (docs/model.md).
        wake_fade: share of the wake's rows, the oldest, over which its circulation fades to
            nothing. At 0 the wake ends in a strong vortex, another one at every step.
        core: radius of the vortex core, in mean chords.
        shedding_fraction: where a new wake row is placed, of the way from the trailing edge to
            the last free row (1/3: paper and Ramesh 2014; 1/4: the more accurate one).
        tip_inset: how far the lattice's ends lie inside the tips, in strips (Hough 1973).
        side_suction_efficiency: the same of the suction around the tips, as a share of its exact
            value (Lamar 1974); 0, the paper's model, has none.
        circulation_lag: travel in chords over which the circulation that the loads see follows
            the bound one, as a leading-edge vortex builds up; 0, the paper's model, has no lag.
        rate: how dG/dt is told from the last steps: "ramped", smooth but a step and a half late;
            "backward", the last difference (Katz & Plotkin); "second_order".
        precision: of the roll-up's velocities: "single", or "double", at half the speed, for
            checking.
        threads: threads of the wake's roll-up; results do not depend on it.

    Raises:
        ValueError: a setting out of its range.
    """

    chordwise: int = 6
    spanwise: int = 12
    steps_per_cycle: int = 100
    suction_efficiency: float | SuctionLaw = SUCTION_EFFICIENCY
    suction_factor: float = 1.0
    wake_cycles: float = 1.0
    wake_detail: float = WAKE_DETAIL
    wake_fade: float = 0.1
    core: float = 0.15
    shedding_fraction: float = 1.0 / 3.0
    tip_inset: float = 0.25
    side_suction_efficiency: float = 0.0
    circulation_lag: float = 0.0
    rate: Rate = Rate.RAMPED
    precision: Precision = Precision.SINGLE
    threads: int = 1
    plugin: ClassVar[str] = "flaprig.uvlm"
    parts: ClassVar[tuple[str, str]] = ("potential", "suction")

    def __post_init__(self) -> None:
        owner = "UVLM"
        check.whole(owner, "chordwise", self.chordwise, 1, 64)
        check.whole(owner, "spanwise", self.spanwise, 1, 128)
        if self.chordwise * self.spanwise > 1024:
            product = self.chordwise * self.spanwise
            raise check.fail(owner, "chordwise * spanwise", "at most 1024", product)
        check.whole(owner, "steps_per_cycle", self.steps_per_cycle, 4, 100_000)
        if not isinstance(self.suction_efficiency, SuctionLaw):
            check.in_range(owner, "suction_efficiency", self.suction_efficiency, 0, 10)
        check.in_range(owner, "suction_factor", self.suction_factor, 0, 2)
        check.in_range(owner, "wake_cycles", self.wake_cycles, 0.01, 100)
        check.in_range(owner, "wake_detail", self.wake_detail, 0, 100)
        check.in_range(owner, "wake_fade", self.wake_fade, 0, 1)
        check.positive(owner, "core", self.core, "mean chords", most=2)
        check.in_range(owner, "shedding_fraction", self.shedding_fraction, 0.01, 0.99)
        check.in_range(owner, "tip_inset", self.tip_inset, 0, 0.5, "strips")
        check.in_range(owner, "side_suction_efficiency", self.side_suction_efficiency, 0, 10)
        check.in_range(owner, "circulation_lag", self.circulation_lag, 0, 10, "chords")
        check.one_of(owner, "rate", self.rate, Rate)
        check.one_of(owner, "precision", self.precision, Precision)
        check.whole(owner, "threads", self.threads, 1, 64)

    @classmethod
    def extended(cls, **changes: Any) -> Self:
        """The lattice for separated flow: three additions to the paper's model (docs/model.md).

        The loads' circulation lags by some of a chord of travel, the tips have the suction of
        theory (Lamar 1974), and the leading edge's depends on the Reynolds number. Lag and law
        were fitted to 26 measured strokes at Re 3000 to 5000 and the paper's sinusoid (Re 8700).

        Args:
            changes: settings that differ, by name.
        """
        named: dict[str, Any] = {
            "suction_efficiency": EXTENDED_SUCTION,
            "side_suction_efficiency": 1.0,
            "circulation_lag": EXTENDED_LAG,
            "rate": Rate.BACKWARD,
        }
        return cls(**named | changes)

    @classmethod
    def accurate(cls, **changes: Any) -> Self:
        """The lattice for attached flow at the accuracy of its panels: no suction, a wake that
        leaves as if it went on with the lattice's own spacing, rates to second order.

        Choose steps so that the wing moves a panel a step. A free wing may become unstable with it.

        Args:
            changes: settings that differ, by name.
        """
        named: dict[str, Any] = {
            "suction_efficiency": 0.0,
            "shedding_fraction": 0.2,
            "rate": Rate.SECOND_ORDER,
        }
        return cls(**named | changes)

    @property
    def label(self) -> str:
        """What people call the model."""
        if isinstance(self.suction_efficiency, SuctionLaw) or self.circulation_lag:
            return "extended UVLM"
        return "accurate UVLM" if self.rate == Rate.SECOND_ORDER else "UVLM"

    def attributes(
        self, wing: Wing, fluid: Fluid, frequency: float, sweep_amplitude: float = SWEEP_AMPLITUDE
    ) -> dict[str, str]:
        """The attributes of the plugin `flaprig.uvlm` with these settings.

        Args:
            wing: the wing.
            fluid: the fluid.
            frequency: strokes per second in [Hz]; sets the wake step.
            sweep_amplitude: half of the peak-to-peak sweep in [rad]; with the frequency it sets
                the Reynolds number of a SuctionLaw.
        """
        check.positive("UVLM", "frequency", frequency, "Hz")
        efficiency = self.suction_efficiency
        if isinstance(efficiency, SuctionLaw):
            reynolds = reynolds_number(wing, fluid, frequency, sweep_amplitude)
            efficiency = efficiency.efficiency(reynolds)
        settings = {
            "chordwise": int(self.chordwise),
            "spanwise": int(self.spanwise),
            "wake_step": float(1.0 / (frequency * self.steps_per_cycle)),
            "wake_rows": _rows(self.wake_cycles, self.steps_per_cycle),
            "wake_detail": self._detail_rows,
            "wake_fade": float(self.wake_fade),
            "core": float(self.core),
            "shedding_fraction": float(self.shedding_fraction),
            "tip_inset": float(self.tip_inset),
            "suction_efficiency": float(efficiency),
            "suction_factor": float(self.suction_factor),
            "side_suction_efficiency": float(self.side_suction_efficiency),
            "circulation_lag": float(self.circulation_lag),
            "rate": Rate(self.rate),
            "precision": Precision(self.precision),
            "threads": int(self.threads),
        }
        text = {n: v.value if isinstance(v, StrEnum) else repr(v) for n, v in settings.items()}
        return geometry_attributes(wing, fluid) | text

    def numerics(self) -> dict[str, tuple[float, ...]]:
        """What whole rows of the wake round, and the law behind the suction efficiency."""
        found: dict[str, tuple[float, ...]] = {
            "wake_cycles": (self.wake_cycles,),
            "wake_detail": (self.wake_detail,),
        }
        law = self.suction_efficiency
        if isinstance(law, SuctionLaw):
            found["suction_law"] = (law.slope, law.onset)
        return found

    @classmethod
    def from_attributes(
        cls,
        attributes: Mapping[str, str],
        numerics: Mapping[str, tuple[float, ...]],
        frequency: float,
        reynolds: float,
    ) -> Self:
        """The settings of a model file."""
        usual = cls()
        names = (
            *("wake_fade", "core", "shedding_fraction", "tip_inset"),
            *("suction_factor", "side_suction_efficiency", "circulation_lag"),
        )
        steps = round(1.0 / (frequency * wake_step(attributes)))
        settings: dict[str, Any] = {n: given(attributes, n, getattr(usual, n)) for n in names}
        settings |= {
            n: int(given(attributes, n, getattr(usual, n)))
            for n in ("chordwise", "spanwise", "threads")
        }
        settings |= {
            n: kind(attributes.get(n, "").strip() or getattr(usual, n))
            for n, kind in (("rate", Rate), ("precision", Precision))
        }
        for name, attribute, default in _ROWS:
            rows = int(given(attributes, attribute, default))
            cycles = numerics.get(name, (math.nan,))[0]
            kept = math.isfinite(cycles) and _rows(cycles, steps) == rows
            settings[name] = cycles if kept else rows / max(steps, 1)
        settings["suction_efficiency"] = _suction(attributes, numerics, reynolds)
        return cls(steps_per_cycle=steps, **settings)

    @property
    def _detail_rows(self) -> int:
        return _rows(self.wake_detail, self.steps_per_cycle)


def wake_step(attributes: Mapping[str, str]) -> float:
    """Time between two rows of the wake in a model file, in [s]."""
    return given(attributes, "wake_step", _WAKE_STEP)


def _rows(cycles: float, steps: int) -> int:
    """Rows of wake in some cycles; none only in none."""
    return max(1, round(cycles * steps)) if cycles else 0


def _suction(
    attributes: Mapping[str, str], numerics: Mapping[str, tuple[float, ...]], reynolds: float
) -> float | SuctionLaw:
    """The number in the file, or the law that gives it at this Reynolds number."""
    efficiency = given(attributes, "suction_efficiency", SUCTION_EFFICIENCY)
    parts = numerics.get("suction_law", ())
    if len(parts) == 2:
        law = SuctionLaw(*parts)
        if math.isclose(law.efficiency(reynolds), efficiency, rel_tol=1e-9, abs_tol=1e-12):
            return law
    return efficiency
