import numpy as np
import pytest

from flaprig.limits import SINUSOID, Bound, filtered
from flaprig.logs import XM430_RIG, JointCounts, PositionCounts
from flaprig.strokes import SampledStroke

A = np.pi / 3


@pytest.fixture(scope="module")
def limits(rig):
    """Accelerations 20 % below what the sinusoid needs."""
    return rig.with_accelerations(SINUSOID.times(0.8))


@pytest.fixture(scope="module")
def trajectory(sine, limits):
    return filtered(sine, limits, cycles=2, interval=0.005)


def test_sinusoid_with_a_fifth_less_acceleration_than_it_needs(trajectory, sine, limits):
    motion = trajectory.motion
    table = np.array(
        [
            [motion.sweep, motion.pitch],
            [motion.sweep_rate, motion.pitch_rate],
            [motion.sweep_acceleration, motion.pitch_acceleration],
        ]
    )
    for order, bound in enumerate(list(Bound)[:3]):
        allowed = limits.ranges(bound)[:, 1:]
        assert (np.abs(table[order]) <= allowed * (1.0 + 1e-9)).all()
    jerk = np.abs(np.diff(table[2], axis=1)) / trajectory.interval
    assert (jerk <= limits.ranges(Bound.JERK)[:, 1:] * (1.0 + 1e-9)).all()
    followed = (motion.time >= trajectory.joined_at) & (motion.time <= trajectory.left_at)
    wanted = sine.motion(motion.time[followed])
    rms = np.sqrt(np.mean((motion.sweep[followed] - wanted.sweep) ** 2)) / A
    assert rms < 0.03
    # the projection's own error, 2.14 % of the amplitude
    assert rms == pytest.approx(trajectory.projection.sweep.distance_rms / A, rel=1e-3)
    # period: a cycle later the same angles
    one = round(5.0 / trajectory.interval)
    angles = motion.sweep[followed]
    np.testing.assert_allclose(angles[one:], angles[:-one], atol=1e-12)
    assert trajectory.stroke.period == pytest.approx(sine.period, rel=1e-15)


def test_begins_and_ends_at_rest_and_follows_whole_cycles(trajectory, sine):
    motion = trajectory.motion
    for name in ("sweep_rate", "pitch_rate", "sweep_acceleration", "pitch_acceleration"):
        assert getattr(motion, name)[[0, -1]].tolist() == [0.0, 0.0]
    first = trajectory.stroke.motion(0.0)
    assert (motion.sweep[0], motion.pitch[0]) == (first.sweep, first.pitch)
    assert trajectory.left_at - trajectory.joined_at == pytest.approx(10.0, abs=0.005)
    np.testing.assert_allclose(np.diff(motion.time), 0.005, rtol=1e-9)
    # rates are those of the angles
    slope = np.gradient(motion.sweep, 0.005)[1:-1]
    assert np.abs(slope - motion.sweep_rate[1:-1]).max() < 0.002


def test_from_another_posture_and_another_stroke(sine, rig):
    found = filtered(sine, rig, cycles=1, interval=0.01, posture=(0.3, -0.2))
    assert (found.motion.sweep[0], found.motion.pitch[0]) == (0.3, -0.2)
    assert found.stroke is sine and found.projection.distance_rms == 0.0


def test_csv_has_units_in_its_names_and_torques_of_the_caller(trajectory, tmp_path):
    count = trajectory.motion.time.size
    torque = np.arange(2.0 * count).reshape(count, 2)
    trajectory.save(tmp_path / "set_points.csv", torque)
    header, *rows = (tmp_path / "set_points.csv").read_text().splitlines()
    assert header == (
        "time_s,sweep_rad,pitch_rad,sweep_rate_rad_per_s,pitch_rate_rad_per_s,"
        "sweep_acceleration_rad_per_s2,pitch_acceleration_rad_per_s2,"
        "following,sweep_torque_Nm,pitch_torque_Nm"
    )
    table = np.loadtxt(rows, delimiter=",")
    assert len(table) == count
    np.testing.assert_allclose(table[:, 1], trajectory.motion.sweep, rtol=1e-9)
    np.testing.assert_allclose(table[:, 6], trajectory.motion.pitch_acceleration, rtol=1e-9)
    following = (table[:, 0] >= trajectory.joined_at) & (table[:, 0] <= trajectory.left_at)
    np.testing.assert_array_equal(table[:, 7], following)
    np.testing.assert_array_equal(table[:, 8:], torque)
    trajectory.save(tmp_path / "bare.npz")
    bare = np.load(tmp_path / "bare.npz")
    assert "sweep_torque_Nm" not in bare and bare["sweep_rad"].size == count


def test_counts_are_angles_within_half_a_count(trajectory, tmp_path):
    motion = trajectory.motion
    table = XM430_RIG.table(motion)
    half = np.pi / 4096
    assert np.abs(XM430_RIG.sweep.angles(table[:, 0]) - motion.sweep).max() <= half * (1 + 1e-9)
    assert np.abs(XM430_RIG.pitch.angles(table[:, 1]) - motion.pitch).max() <= half * (1 + 1e-9)
    XM430_RIG.save(tmp_path / "counts.csv", motion)
    header, *rows = (tmp_path / "counts.csv").read_text().splitlines()
    assert header == "time_s,sweep_count,pitch_count"
    assert rows[1] == f"0.005,{table[1, 0]},{table[1, 1]}" and len(rows) == motion.time.size


def test_zero_and_direction_of_a_mounting():
    plain = JointCounts()
    angles = np.array([0.0, np.pi / 2, -np.pi / 2])
    assert plain.counts(angles).tolist() == [2048, 3072, 1024]
    turned = JointCounts(zero=2000, direction=-1)
    assert turned.counts(angles).tolist() == [2000, 976, 3024]
    np.testing.assert_allclose(turned.angles(turned.counts(angles)), angles, atol=1e-12)
    # a gear of one half on another servo, in extended position mode
    geared = JointCounts(per_turn=8192, zero=0, lowest=-10_000, highest=10_000)
    assert geared.counts(angles).tolist() == [0, 2048, -2048]


def test_counts_of_projected_samples_at_a_slower_rate(trajectory):
    stroke = trajectory.stroke
    assert isinstance(stroke, SampledStroke)
    table = PositionCounts().table(stroke.sample(50))
    assert table.shape == (50, 2) and table[0, 0] == XM430_RIG.sweep.counts(
        np.array([stroke.sweep[0]])
    )


def test_bad_input_gives_one_sentence(trajectory, sine, rig, tmp_path):
    for changes, sentence in (
        ({"stroke": None}, "filtered: stroke must be a stroke"),
        ({"limits": 1}, "filtered: limits must be a Limits"),
        ({"cycles": 0}, "filtered: cycles must be a whole number from 1 to 1000"),
        ({"interval": -1.0}, "RuckigFilter: interval must be a number"),
        ({"interval": 1e-5, "cycles": 900}, "filtered: interval must be long enough"),
        ({"posture": (2.0, 0.0)}, "RuckigFilter: posture must be inside the range"),
    ):
        with pytest.raises(ValueError, match=f"^{sentence}"):
            filtered(**({"stroke": sine, "limits": rig} | changes))
    with pytest.raises(ValueError, match=r"^Trajectory: torque must be finite numbers in N m"):
        trajectory.columns(np.zeros(3))
    with pytest.raises(ValueError, match=r"^Trajectory.save: path must end in"):
        trajectory.save(tmp_path / "set_points.txt")
    with pytest.raises(ValueError, match="angle must be within 0 to 4095 counts, got '5120 counts"):
        JointCounts().counts(np.array([0.0, 1.5 * np.pi]))
    with pytest.raises(ValueError, match="angle must be finite"):
        JointCounts().counts(np.array([np.nan]))
    for changes, sentence in (
        ({"per_turn": 0}, "per_turn must be a whole number"),
        ({"direction": 0}, "direction must be 1 or -1"),
        ({"zero": 5000}, "zero must be from lowest to highest"),
        ({"lowest": 0.5}, "lowest must be a whole number"),
    ):
        with pytest.raises(ValueError, match=f"^JointCounts: {sentence}"):
            JointCounts(**changes)
    with pytest.raises(ValueError, match=r"^PositionCounts: sweep must be a JointCounts"):
        PositionCounts(sweep=2048)
