"""Measured strokes: reading the file, its numbers, and the models' scores."""

import json
from pathlib import Path

import numpy as np
import pytest

from flaprig import UVLM
from flaprig._paths import assets_dir
from flaprig.validation.leave_one_out import LeaveOneOut
from flaprig.validation.measured import MeasuredStrokes
from flaprig.validation.measured_file import FILE, read
from flaprig.validation.measured_score import half_stroke, score

SHARED = Path(__file__).resolve().parents[3] / "shared" / "validation" / "measured_hover.json"


def content():
    return json.loads((assets_dir() / FILE).read_text())


@pytest.fixture
def some(tmp_path):
    """Every seventh stroke in a file of its own."""
    path = tmp_path / "some.json"
    path.write_text(json.dumps({"cases": content()["cases"][::7]}))
    return path


@pytest.mark.skipif(not SHARED.is_file(), reason="the shared measurements are not here")
def test_the_file_is_the_shared_one():
    assert json.loads(SHARED.read_text()) == content()


def test_strokes_are_read_as_the_source_means_them():
    strokes = read()
    assert len(strokes) == 26 and sum(s.reynolds > 4000 for s in strokes) == 7
    first, raw = strokes[0], content()["cases"][0]
    assert first.wing.area == pytest.approx(raw["span_m"] * raw["mean_chord_m"], rel=1e-6)
    assert first.wing.radius_of_second_moment == pytest.approx(
        raw["r2hat"] * raw["span_m"], rel=2e-3
    )
    # nominal and measured sweep differ by a percent or two
    assert np.degrees(2 * first.stroke.sweep_amplitude) == pytest.approx(140.0, rel=0.02)
    speed = np.sqrt(2 * first.reference_force / (first.fluid.density * first.wing.area))
    assert speed * first.wing.mean_chord / first.fluid.kinematic_viscosity == pytest.approx(
        3000, rel=0.01
    )
    assert first.lift_to_drag == pytest.approx(raw["CL_mean"] / raw["CD_mean"])


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"span_m": -1}, "case 0: span_m must be a positive number"),
        ({"rho": "water"}, "case 0: rho must be a positive number"),
        ({"phi": [1, 2]}, "case 0: phi must be a0 and then pairs"),
        ({"CL": [1, None, 2]}, "case 0: CL must be a list of numbers"),
        ({"CD_mean": None}, "case 0: CD_mean must be a positive number"),
        ({"theta": None}, "case 0: theta must be"),
    ],
)
def test_bad_cases_are_refused_by_key(tmp_path, change, words):
    case = content()["cases"][0] | change
    path = tmp_path / "bad.json"
    path.write_text(json.dumps({"cases": [case]}))
    with pytest.raises(ValueError, match=words):
        read(path)


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"cases": []}', '{"cases": [1]}', "\xff"])
def test_files_that_are_no_list_are_refused(tmp_path, text):
    path = tmp_path / "bad.json"
    path.write_bytes(text.encode("latin-1"))
    with pytest.raises(ValueError, match="measured: "):
        MeasuredStrokes(cases=path).run()


def test_a_missing_key_is_named(tmp_path):
    case = content()["cases"][0]
    del case["r1hat"]
    path = tmp_path / "bad.json"
    path.write_text(json.dumps({"cases": [case]}))
    with pytest.raises(ValueError, match="case 0: r1hat must be given"):
        read(path)


def test_a_score_is_what_it_says():
    case = read()[0]
    found = score(case, UVLM(3, 4, 40), 2, 0.15)
    lift, drag, ratio = found.means
    assert found.published[0] == pytest.approx(100 * (lift / case.mean_lift - 1))
    assert found.published[2] == pytest.approx(100 * (lift / drag / case.lift_to_drag - 1))
    assert ratio == pytest.approx(lift / drag)
    assert found.measured[0].mean() == pytest.approx(case.mean_lift, rel=0.01)
    assert found.measured.shape == found.computed.shape == (2, 40)
    assert half_stroke(found.measured).shape == (2, 20)
    # a smooth stroke: the histories agree well even on a coarse mesh
    assert min(found.correlation) > 0.9


def test_any_file_gives_per_case_and_rms_errors(some):
    outcome = MeasuredStrokes(cases=some, model="quasi-steady", beside=("hover-tank",)).run()
    data = outcome.data
    errors = np.array([[c["error_percent"][k] for k in data["rms_percent"]] for c in data["cases"]])
    assert len(errors) == 4
    np.testing.assert_allclose(
        list(data["rms_percent"].values()), np.sqrt(np.mean(errors**2, axis=0))
    )
    np.testing.assert_allclose(list(data["bias_percent"].values()), errors.mean(axis=0))
    assert data["beside"]["hover-tank"]["rms_percent"]["cl"] < data["rms_percent"]["cl"]


@pytest.mark.slow
def test_the_extended_lattice_is_within_the_demands():
    outcome = MeasuredStrokes(beside=()).run()
    assert not outcome.missed
    rms, alike = outcome.data["rms_percent"], outcome.data["measured_alike"]["rms_percent"]
    assert rms == pytest.approx({"cl": 8.0, "cd": 14.4, "lift_to_drag": 11.1}, abs=0.3)
    assert alike == pytest.approx({"cl": 8.8, "cd": 8.8, "lift_to_drag": 8.7}, abs=0.3)
    # and clearly nearer to the histories than translation alone can be
    assert outcome.data["histories"]["cl_correlation"] > 0.93
    assert outcome.data["histories"]["cd_correlation"] > 0.79


@pytest.mark.slow
def test_a_stroke_left_out_is_predicted_as_well(some):
    outcome = LeaveOneOut(cases=some, lags=(0.15,), cycles=2).run()
    assert set(outcome.data["rms_percent"]) == {"cl", "cd", "lift_to_drag"}
    rows = {row.quantity: row.value for row in outcome.rows}
    assert rows["fitted lag [chords]"] == 0.15
    assert abs(rows["paper's sinusoid, C_L error [%]"]) < 4.0
    # four strokes fit what twenty-six fitted
    assert rows["left out, measured alike, C_L rms [%]"] < 15.0


def test_leaving_one_of_two_out_is_refused(tmp_path):
    path = tmp_path / "two.json"
    path.write_text(json.dumps({"cases": content()["cases"][:2]}))
    with pytest.raises(ValueError, match="leave-one-out: cases must be at least three"):
        LeaveOneOut(cases=path).run()
