"""The models of the air, for `simulate` and the plugins; a new one is listed here."""

from flaprig.aero.air_model import SWEEP_AMPLITUDE, AirModel
from flaprig.aero.quasi_steady import QuasiSteady
from flaprig.aero.suction_law import SuctionLaw
from flaprig.aero.uvlm import SUCTION_EFFICIENCY, UVLM, Precision, Rate

__all__ = [
    "SUCTION_EFFICIENCY",
    "SWEEP_AMPLITUDE",
    "UVLM",
    "AirModel",
    "Precision",
    "QuasiSteady",
    "Rate",
    "SuctionLaw",
]
