"""simulate: signs, power, substeps, progress, refusals; and results with their means and files."""

import csv
import json
from dataclasses import replace

import numpy as np
import pytest

from flaprig.aero.air import Air
from flaprig.aero.batch import simulate_batch
from flaprig.aero.models import UVLM, QuasiSteady
from flaprig.aero.result import averaged_cycles
from flaprig.aero.rigid_motion import RigidMotion
from flaprig.aero.simulate import mean_speed, reference_force, simulate
from flaprig.fluid import WATER
from flaprig.strokes import SunTangStroke
from flaprig.wing import RIG_WING, Wing

STROKE = SunTangStroke(0.2, np.pi / 3, np.pi / 4)
COARSE = UVLM(chordwise=3, spanwise=5, steps_per_cycle=40)


@pytest.fixture(scope="module")
def result():
    return simulate(RIG_WING, STROKE, COARSE, cycles=4)


def test_reference_of_the_paper():
    assert mean_speed(RIG_WING, STROKE) == pytest.approx(0.13945, rel=1e-4)
    assert reference_force(RIG_WING, STROKE, WATER) == pytest.approx(0.15193, rel=1e-4)


def test_power_is_force_times_speed(result):
    """Power from joint torques equals minus the wrench on the twist, whatever the frames."""
    motion = RigidMotion.from_stroke(STROKE.motion(result.time[:40]))
    loads = Air(RIG_WING, WATER, COARSE, 0.2).run(motion, STROKE.period / 40).total
    power = -np.einsum("nj,nj->n", loads, motion.twist)
    np.testing.assert_allclose(result.power[:40], power, atol=1e-12)


def test_drag_opposes_the_sweep(result):
    h = result.histories
    moving = np.abs(h.sweep_rate) > 0.5 * np.abs(h.sweep_rate).max()
    assert np.all(result.drag[moving] > 0)
    assert np.all(result.sweep_torque[moving] * h.sweep_rate[moving] < 0)


def test_substeps_report_more_of_the_same():
    once, twice = (simulate(RIG_WING, STROKE, COARSE, cycles=2, substeps=n) for n in (1, 2))
    assert twice.steps_per_cycle == 80 and twice.time[1] == pytest.approx(once.time[1] / 2)
    # ticks fall on the same instants
    np.testing.assert_allclose(twice.lift[:40:2], once.lift[:20], atol=1e-12)
    assert twice.cl == pytest.approx(once.cl, rel=0.02)


def test_means_are_over_the_last_three_cycles():
    assert [averaged_cycles(n) for n in (1, 2, 3, 4, 5, 8)] == [
        (1, 1), (2, 2), (3, 3), (3, 4), (3, 5), (6, 8),
    ]  # fmt: skip


def test_coefficients_are_means(result):
    lift = result.lift.reshape(4, 40)[2:].mean()
    assert result.cl == pytest.approx(lift / result.reference_force, rel=1e-12)
    means = result.cycle_means(result.lift)
    assert result.cl_spread == pytest.approx(means.std(ddof=1) / result.reference_force, rel=1e-12)
    assert result.lift_to_drag == pytest.approx(result.cl / result.cd, rel=1e-12)


def test_one_cycle_has_no_spread():
    assert np.isnan(simulate(RIG_WING, STROKE, QuasiSteady(), cycles=1).cl_spread)


def test_progress_goes_from_little_to_all():
    told = []
    simulate(RIG_WING, STROKE, COARSE, cycles=1, progress=told.append)
    assert told[-1] == 1.0 and told == sorted(told) and len(told) > 10


def test_progress_may_stop_the_run():
    def stop(done):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        simulate(RIG_WING, STROKE, COARSE, cycles=1, progress=stop)


@pytest.mark.parametrize("name", ["cycles", "substeps"])
@pytest.mark.parametrize("value", [0, -1, 1.5, 1001, float("nan"), None])
def test_counts_are_checked(name, value):
    with pytest.raises(ValueError, match=f"simulate: {name} must be"):
        simulate(RIG_WING, STROKE, COARSE, **{name: value})


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("wing", (0.24, 0.06)), ("wing", STROKE), ("wing", None), ("wing", Wing),
        ("stroke", lambda time: time), ("stroke", RIG_WING), ("stroke", SunTangStroke),
        ("stroke", "s.json"), ("model", "uvlm"), ("model", QuasiSteady), ("model", 3),
        ("fluid", "water"), ("fluid", None), ("fluid", 1000.0), ("progress", 1),
    ],
)  # fmt: skip
def test_types_are_checked(name, value):
    arguments = {"wing": RIG_WING, "stroke": STROKE, "model": COARSE} | {name: value}
    with pytest.raises(ValueError, match=f"^simulate: {name} must be a") as caught:
        simulate(**arguments)
    assert "\n" not in str(caught.value)
    if name == "progress":
        return
    strokes = {"strokes": [STROKE, arguments.pop("stroke")]}
    field = r"strokes\[1\]" if name == "stroke" else name
    with pytest.raises(ValueError, match=f"^simulate_batch: {field} must be a"):
        simulate_batch(**arguments, **strokes)


@pytest.mark.parametrize("strokes", [STROKE, None, 3, SunTangStroke])
def test_a_batch_is_a_list_of_strokes(strokes):
    with pytest.raises(ValueError, match="^simulate_batch: strokes must be a list of strokes"):
        simulate_batch(RIG_WING, strokes, COARSE)


def test_whole_numbers_may_be_floats():
    once, again = (simulate(RIG_WING, STROKE, QuasiSteady(), cycles=n) for n in (2, 2.0))
    assert again.averaged_cycles == once.averaged_cycles == (2, 2)
    assert json.dumps(again.summary()) == json.dumps(once.summary())


def test_summary_of_one_cycle_is_valid_json():
    summary = simulate(RIG_WING, STROKE, QuasiSteady(), cycles=1).summary()
    assert summary["cl_spread"] is None
    assert json.loads(json.dumps(summary, allow_nan=False)) == summary


class Breaking(SunTangStroke):
    """A stroke whose pitch is no number from 3 s on."""

    def motion(self, time):
        motion = super().motion(time)
        return replace(motion, pitch=np.where(motion.time < 3, motion.pitch, np.nan))


@pytest.mark.parametrize("model", [COARSE, QuasiSteady(steps_per_cycle=40)])
def test_loads_that_are_no_numbers_are_told(model):
    with pytest.raises(FloatingPointError, match="not finite from t = 3 s on; .* steps_per_cycle"):
        simulate(RIG_WING, Breaking(0.2, 1.0, 0.7), model, cycles=1)


def test_csv_holds_every_column(result, tmp_path):
    path = tmp_path / "run.csv"
    result.save(path)
    rows = list(csv.DictReader(path.read_text().splitlines()))
    assert len(rows) == 160 and list(rows[0]) == list(result.histories.columns())
    lift = [float(row["lift_N"]) for row in rows]
    np.testing.assert_allclose(lift, result.lift, rtol=1e-9, atol=1e-12)


def test_npz_is_exact_and_carries_the_summary(result, tmp_path):
    path = tmp_path / "run.npz"
    result.save(path)
    with np.load(path) as data:
        np.testing.assert_array_equal(data["sweep_torque_Nm"], result.sweep_torque)
        summary = json.loads(str(data["summary"]))
    assert summary["cl"] == result.cl and summary["averaged_cycles"] == [3, 4]
    assert summary["peak_power_W"] >= summary["mean_power_W"]


@pytest.mark.parametrize("name", ["run.txt", "run", "run.CSV "])
def test_other_endings_are_refused(result, tmp_path, name):
    with pytest.raises(ValueError, match=r"must end in \.csv or \.npz"):
        result.save(tmp_path / name)
    assert not list(tmp_path.iterdir())
