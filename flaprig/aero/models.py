"""The models of the air, for `simulate` and the plugins; a new one is listed here."""

from flaprig.aero.air_model import SWEEP_AMPLITUDE, AirModel
from flaprig.aero.quasi_steady import QuasiSteady
from flaprig.aero.suction_law import SuctionLaw
from flaprig.aero.uvlm import SUCTION_EFFICIENCY, UVLM, Precision, Rate

# by the name of the plugin that carries it in a model file
MODELS: dict[str, type[UVLM] | type[QuasiSteady]] = {
    model.plugin: model for model in (UVLM, QuasiSteady)
}

__all__ = [
    "MODELS",
    "SUCTION_EFFICIENCY",
    "SWEEP_AMPLITUDE",
    "UVLM",
    "AirModel",
    "Precision",
    "QuasiSteady",
    "Rate",
    "SuctionLaw",
]
