"""Today's loads at instants of the first cycle, which rounding moves little."""

import numpy as np
import pytest

from flaprig.aero.models import UVLM, QuasiSteady
from flaprig.aero.simulate import simulate
from flaprig.strokes import SunTangStroke
from flaprig.wing import RIG_WING, Wing

SINUSOID = SunTangStroke(0.2, np.pi / 3, np.pi / 4)
FAST = SunTangStroke(0.2, np.pi / 3, np.pi / 4, 0.32, 0.16)
# tenths of the cycle
AT = np.arange(1, 10)


BRUTE = {"chordwise": 4, "spanwise": 8, "wake_detail": 0}
# name: wing, stroke, model
CASES = {
    "uvlm": (RIG_WING, SINUSOID, UVLM()),
    "uvlm_brute_force": (RIG_WING, SINUSOID, UVLM(wake_detail=0)),
    "uvlm_beta_fast": (Wing.beta(0.24, 0.06, 0.5), FAST, UVLM(**BRUTE)),
    "extended": (RIG_WING, FAST, UVLM.extended(**BRUTE)),
    "quasi_steady": (RIG_WING, FAST, QuasiSteady()),
}
# lift [N], sweep and pitch torque [N m] at these instants
TODAY = {
    "uvlm": {
        "lift": [
            0.1597444,
            0.5389029,
            0.6321139,
            0.1905639,
            0.0,
            0.1335716,
            0.4740086,
            0.6432012,
            0.2317264,
        ],
        "sweep_torque": [
            -0.06049463,
            -0.1115908,
            -0.1293369,
            -0.07123436,
            0.02681155,
            0.05192868,
            0.09800135,
            0.1295686,
            0.08357139,
        ],
        "pitch_torque": [
            0.002134723,
            -0.0006086144,
            -0.0008235444,
            -0.001834599,
            -0.004045901,
            -0.003073149,
            -0.0005777457,
            -0.0006759653,
            0.0005978871,
        ],
    },
    "uvlm_brute_force": {
        "lift": [
            0.1597444,
            0.5389029,
            0.6321139,
            0.1905639,
            0.0,
            0.1335737,
            0.4740167,
            0.6435186,
            0.2312835,
        ],
        "sweep_torque": [
            -0.06049463,
            -0.1115908,
            -0.1293369,
            -0.07123436,
            0.02681155,
            0.05192946,
            0.09800302,
            0.1296322,
            0.08335916,
        ],
        "pitch_torque": [
            0.002134723,
            -0.0006086144,
            -0.0008235444,
            -0.001834599,
            -0.004045902,
            -0.003073195,
            -0.0005778378,
            -0.0006799897,
            0.0005976417,
        ],
    },
    "uvlm_beta_fast": {
        "lift": [
            0.2743902,
            0.2963157,
            0.3031022,
            0.1701123,
            0.0,
            0.1876607,
            0.2266764,
            0.2667121,
            0.1642637,
        ],
        "sweep_torque": [
            -0.04178122,
            -0.04748237,
            -0.04865601,
            -0.02816754,
            -0.009788975,
            0.02931734,
            0.03741934,
            0.04306299,
            0.0271974,
        ],
        "pitch_torque": [
            0.003689801,
            -0.0003560003,
            -0.0009252498,
            -0.002479952,
            0.001184717,
            -0.003385785,
            -6.957564e-05,
            0.0005177221,
            0.002106194,
        ],
    },
    "extended": {
        "lift": [
            0.3393055,
            0.4545037,
            0.4773735,
            0.2923696,
            0.0,
            0.2351151,
            0.3789425,
            0.4382604,
            0.3035059,
        ],
        "sweep_torque": [
            -0.06644743,
            -0.09146092,
            -0.09517357,
            -0.05919008,
            -0.002533959,
            0.04917939,
            0.07656652,
            0.08670929,
            0.05932898,
        ],
        "pitch_torque": [
            0.00396965,
            0.002063584,
            0.002043507,
            -0.0004117817,
            0.0002660371,
            -0.003387826,
            -0.001752843,
            -0.001844277,
            7.463911e-05,
        ],
    },
    "quasi_steady": {
        "lift": [
            0.3902188,
            0.465353,
            0.465353,
            0.253217,
            0.0,
            0.3902188,
            0.465353,
            0.465353,
            0.253217,
        ],
        "sweep_torque": [
            -0.07531547,
            -0.09064398,
            -0.09064398,
            -0.05001646,
            0.04553701,
            0.07531547,
            0.09064398,
            0.09064398,
            0.05001646,
        ],
        "pitch_torque": [
            0.001651879,
            0.0001999141,
            0.0001999141,
            -0.001375461,
            -0.003853072,
            -0.001651879,
            -0.0001999141,
            -0.0001999141,
            0.001375461,
        ],
    },
}


@pytest.mark.parametrize("name", CASES)
def test_first_cycle_is_that_of_today(name):
    wing, stroke, model = CASES[name]
    result = simulate(wing, stroke, model, cycles=1)
    # the wake rolls up in single precision, and vectors differ from processor to processor
    within = 1e-6 if isinstance(model, QuasiSteady) else 1e-4
    for quantity, expected in TODAY[name].items():
        ours = getattr(result, quantity)[:: model.steps_per_cycle // 10][AT]
        bound = within * np.abs(expected).max()
        np.testing.assert_allclose(ours, expected, atol=bound, err_msg=quantity)
