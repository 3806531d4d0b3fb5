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


# name: wing, stroke, model
CASES = {
    "uvlm": (RIG_WING, SINUSOID, UVLM()),
    "uvlm_beta_fast": (Wing.beta(0.24, 0.06, 0.5), FAST, UVLM(chordwise=4, spanwise=8)),
    "quasi_steady": (RIG_WING, FAST, QuasiSteady()),
}
# lift [N], sweep and pitch torque [N m] at these instants
TODAY = {
    "uvlm": {
        "lift": [
            0.1597444, 0.5389029, 0.6321139, 0.1905639, 0.0,
            0.1335737, 0.4740167, 0.6435186, 0.2312835,
        ],
        "sweep_torque": [
            -0.06049463, -0.1115908, -0.1293369, -0.07123436, 0.02681155,
            0.05192946, 0.09800302, 0.1296322, 0.08335916,
        ],
        "pitch_torque": [
            0.002134723, -0.0006086144, -0.0008235444, -0.001834599, -0.004045902,
            -0.003073195, -0.0005778378, -0.0006799897, 0.0005976417,
        ],
    },
    "uvlm_beta_fast": {
        "lift": [
            0.2741122, 0.2957871, 0.3025326, 0.1696715, 0.0,
            0.187525, 0.2263554, 0.2662964, 0.1638945,
        ],
        "sweep_torque": [
            -0.04172397, -0.04737734, -0.04854518, -0.02808392, -0.009757483,
            0.02928814, 0.03735267, 0.04298018, 0.02712493,
        ],
        "pitch_torque": [
            0.003693161, -0.0003495436, -0.0009182694, -0.002474533, 0.001186929,
            -0.003387337, -7.342126e-05, 0.0005126927, 0.002101707,
        ],
    },
    "quasi_steady": {
        "lift": [
            0.3902188, 0.465353, 0.465353, 0.253217, 0.0,
            0.3902188, 0.465353, 0.465353, 0.253217,
        ],
        "sweep_torque": [
            -0.07531547, -0.09064398, -0.09064398, -0.05001646, 0.04553701,
            0.07531547, 0.09064398, 0.09064398, 0.05001646,
        ],
        "pitch_torque": [
            0.001651879, 0.0001999141, 0.0001999141, -0.001375461, -0.003853072,
            -0.001651879, -0.0001999141, -0.0001999141, 0.001375461,
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
