from dataclasses import replace

import numpy as np
import pytest

from flaprig.fluid import AIR, WATER
from flaprig.limits import (
    PAPER_KINEMATICS,
    SINUSOID,
    Accelerations,
    Bound,
    JointLimits,
    Limits,
    peaks,
    rig_limits,
    servo_limits,
)
from flaprig.limits.servo import load_inertias
from flaprig.motors import RIG_MOTORS, XM430_W350
from flaprig.strokes import SunTangStroke
from flaprig.wing import RIG_WING

GOOD = {"position": (-1.5, 1.5), "velocity": 4.0, "acceleration": 10.0, "jerk": 300.0}


def test_named_accelerations_are_what_the_strokes_reach(sine):
    found = peaks(sine)
    assert found["sweep"].acceleration == pytest.approx(SINUSOID.sweep, rel=1e-12)
    assert found["pitch"].acceleration == pytest.approx(SINUSOID.pitch, rel=1e-12)
    nine = [
        peaks(SunTangStroke(0.2, np.pi / 3, np.pi / 4, a, b))
        for a in (0.16, 0.32, 0.5)
        for b in (0.16, 0.32, 0.5)
    ]
    for joint in ("sweep", "pitch"):
        most = max(one[joint].acceleration for one in nine)
        assert most == pytest.approx(getattr(PAPER_KINEMATICS, joint), rel=1e-9)
    # as the notes on the paper print them
    assert SINUSOID.sweep == pytest.approx(1.654, abs=5e-4)
    assert SINUSOID.pitch == pytest.approx(1.240, abs=5e-4)
    assert PAPER_KINEMATICS.sweep == pytest.approx(3.72, abs=5e-3)
    assert PAPER_KINEMATICS.pitch == pytest.approx(12.1, abs=5e-2)


def test_factors_of_accelerations():
    assert SINUSOID.times(2.0) == Accelerations(2.0 * SINUSOID.sweep, 2.0 * SINUSOID.pitch)
    assert SINUSOID.times(1.5, 2.0).pitch == 2.0 * SINUSOID.pitch


def test_servo_limits_lie_under_the_torque_speed_line():
    inertia = 0.02
    found = servo_limits(XM430_W350, inertia)
    # at the corner of the box half of the available torque accelerates
    available = XM430_W350.available_torque(found.velocity)
    assert available == pytest.approx(XM430_W350.continuous_torque, rel=1e-12)
    total = inertia + XM430_W350.rotor_inertia
    assert found.acceleration * total == pytest.approx(0.5 * available, rel=1e-12)
    # jerk: acceleration over the position loop's time constant
    frequency = found.jerk / found.acceleration
    assert frequency**2 * total == pytest.approx(XM430_W350.stiffness, rel=1e-12)
    assert found.current == pytest.approx(XM430_W350.voltage / XM430_W350.resistance)


def test_added_mass_against_closed_form_and_vortex_lattice():
    sweep, pitch = load_inertias(RIG_WING, WATER)
    b, c, r0, rho = 0.25, 0.0625, 0.025, 1000.0
    plate = RIG_WING.inertia
    strip = np.pi / 4 * rho * c**2 * ((r0 + b) ** 3 - r0**3) / 3
    assert sweep - plate[0, 0] == pytest.approx(strip, rel=1e-12)
    assert pitch - plate[1, 1] == pytest.approx(3 / 128 * np.pi * rho * b * c**4, rel=1e-12)
    # prototype vortex lattice: 1.87e-2 and 2.67e-4 kg m2; strips lie above
    assert 1.0 < strip / 1.87e-2 < 1.15
    assert 1.0 < (pitch - plate[1, 1]) / 2.67e-4 < 1.06
    assert load_inertias(RIG_WING, AIR)[0] == pytest.approx(plate[0, 0], rel=0.02)


def test_default_rig_today():
    found = rig_limits(RIG_MOTORS)
    assert found.sweep.velocity == pytest.approx(3.8537, rel=1e-4)
    assert found.sweep.acceleration == pytest.approx(10.955, rel=1e-4)
    assert found.pitch.acceleration == pytest.approx(27.421, rel=1e-4)
    assert found.sweep.jerk == pytest.approx(347.95, rel=1e-4)
    # what the paper's rig has done is allowed
    assert found.sweep.acceleration > PAPER_KINEMATICS.sweep
    assert found.pitch.acceleration > PAPER_KINEMATICS.pitch
    changed = found.with_accelerations(SINUSOID)
    assert changed.pitch == replace(found.pitch, acceleration=SINUSOID.pitch)
    assert changed.ranges(Bound.ACCELERATION)[0, 1] == SINUSOID.sweep


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"position": (1.0, -1.0)}, r"position must be \(lowest, highest\)"),
        ({"position": (1.0,)}, "position must be a list of 2 numbers"),
        ({"position": (-90.0, 90.0)}, r"position\[0\] must be a finite number of size at most"),
        ({"velocity": 0.0}, "velocity must be a positive number in rad/s, got 0.0"),
        ({"velocity": np.nan}, "velocity must be a positive number"),
        ({"acceleration": -1.0}, "acceleration must be a positive number in rad/s2"),
        ({"jerk": np.inf}, "jerk must be a number from"),
        ({"jerk": "300"}, "jerk must be a positive number in rad/s3, got '300'"),
        ({"torque": 0.0}, "torque must be a positive number in N m"),
        ({"rms_torque": None, "current": True}, "current must be a positive number in A"),
        ({"temperature": 1e5}, "temperature must be a number from -100 to 1000 degC"),
    ],
)
def test_bad_joint_limits_give_one_sentence(changes, sentence):
    with pytest.raises(ValueError, match=f"^JointLimits: {sentence}"):
        JointLimits(**(GOOD | changes))


def test_other_bad_input_gives_one_sentence():
    joint = JointLimits(**GOOD)
    limits = Limits(joint, joint)
    with pytest.raises(ValueError, match=r"^Limits: pitch must be a JointLimits, got None"):
        Limits(joint, None)
    with pytest.raises(ValueError, match="bounds must be an Accelerations"):
        limits.with_accelerations(3.0)
    with pytest.raises(ValueError, match=r"^Accelerations.times: sweep must be a positive number"):
        SINUSOID.times(0.0)
    with pytest.raises(ValueError, match=r"^Accelerations: pitch must be a positive number"):
        Accelerations(1.0, -1.0)
    with pytest.raises(ValueError, match=r"^servo_limits: inertia must be a positive number"):
        servo_limits(XM430_W350, 0.0)
    with pytest.raises(ValueError, match=r"^servo_limits: servo must be a Motor"):
        servo_limits(None, 0.1)
    with pytest.raises(ValueError, match=r"^rig_limits: wing must be a Wing"):
        rig_limits(RIG_MOTORS, wing=0.25)
    with pytest.raises(ValueError, match=r"^rig_limits: servos must be a Motors"):
        rig_limits(XM430_W350)
