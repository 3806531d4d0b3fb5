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
            0.1606615, 0.5422962, 0.6363256, 0.192689, 0.0,
            0.1339541, 0.4762392, 0.6469733, 0.2334375,
        ],
        "sweep_torque": [
            -0.06085081, -0.1122815, -0.130172, -0.07199586, 0.02671391,
            0.05209583, 0.09847318, 0.1303257, 0.08412905,
        ],
        "pitch_torque": [
            0.002107916, -0.0006736456, -0.0009042618, -0.001896722, -0.004054353,
            -0.003062073, -0.0005352426, -0.0006137803, 0.0006606079,
        ],
    },
    "uvlm_beta_fast": {
        "lift": [
            0.2749367, 0.2975067, 0.3044388, 0.1711833, 0.0,
            0.1877555, 0.2272371, 0.2675428, 0.1650352,
        ],
        "sweep_torque": [
            -0.04186164, -0.04765211, -0.04884386, -0.02831604, -0.009885542,
            0.02933338, 0.03750373, 0.0431835, 0.02730815,
        ],
        "pitch_torque": [
            0.003679684, -0.0003781085, -0.0009500809, -0.002499861, 0.001174332,
            -0.00338407, -5.921738e-05, 0.0005331075, 0.002120483,
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
