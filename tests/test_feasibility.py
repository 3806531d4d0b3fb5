"""Can the rig do it: laws of the margins, verdicts by name, what limits cost, files."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import flaprig
from flaprig import (
    QuasiSteady,
    Rig,
    SunTangStroke,
    Tolerances,
    TwinRun,
    check_feasibility,
)
from flaprig.aero.simulate import reference_force
from flaprig.feasibility import FeasibilityReport
from flaprig.limits import PAPER_KINEMATICS, SINUSOID, rig_limits
from flaprig.motors import RIG_MOTORS

RIG = Rig.load().with_(model=QuasiSteady())
# amplitudes of the paper [rad]
SWEEP, PITCH = math.pi / 3.0, math.pi / 4.0


def stroke(frequency: float = 0.2, sweep: float = 0.5, pitch: float = 0.5) -> SunTangStroke:
    return SunTangStroke(frequency, SWEEP, PITCH, sweep, pitch)


@cache
def report(frequency: float = 0.2, sweep: float = 0.5, pitch: float = 0.5) -> FeasibilityReport:
    return check_feasibility(RIG, stroke(frequency, sweep, pitch))


def test_motion_of_a_sinusoid_in_closed_form() -> None:
    """A (2 pi f)^k against the bound of order k, and the position against the stops."""
    found, rate = report(), 2.0 * math.pi * 0.2
    assert found.verdict("sweep_velocity_rad_per_s").value == pytest.approx(SWEEP * rate)
    assert found.verdict("pitch_acceleration_rad_per_s2").value == pytest.approx(PITCH * rate**2)
    assert found.verdict("pitch_jerk_rad_per_s3").value == pytest.approx(PITCH * rate**3, rel=1e-4)
    assert found.verdict("sweep_position_rad").margin == pytest.approx(1.0 / 3.0)
    assert found.verdict("pitch_position_rad").margin == pytest.approx(0.5)


def test_paper_sinusoid_today() -> None:
    """Pins: torques as the quasi-steady twin has them."""
    found = report()
    assert found.feasible and not found.broken
    assert found.worst.key == "sweep_position_rad"
    assert found.verdict("sweep_peak_torque_Nm").value == pytest.approx(0.1338, rel=5e-3)
    assert found.verdict("sweep_rms_torque_Nm").value == pytest.approx(0.0978, rel=5e-3)
    assert found.verdict("pitch_peak_torque_Nm").value == pytest.approx(0.01871, rel=1e-2)
    assert found.verdict("sweep_winding_temperature_degC").value == pytest.approx(25.64, abs=0.02)
    assert abs(found.verdict("cl_change").value) < 0.005
    assert abs(found.verdict("lift_to_drag_change").value) < 0.005


@pytest.mark.parametrize("sweep", [0.16, 0.32, 0.5])
@pytest.mark.parametrize("pitch", [0.16, 0.32, 0.5])
def test_nine_kinematics_of_the_paper(sweep: float, pitch: float) -> None:
    found = report(0.2, sweep, pitch)
    assert found.feasible, found.broken
    # the servo is far from its line; the motion's margin is the narrow one
    assert found.verdict("sweep_torque_at_speed_Nm").margin > 0.9
    assert found.worst.margin == pytest.approx(
        min(1.0 / 3.0, found.verdict("pitch_velocity_rad_per_s").margin), abs=1e-3
    )


def test_loads_grow_with_the_square_of_the_frequency() -> None:
    """Drag and inertia alike, power with the cube; the pitch also carries the plate."""
    slow, fast = report(0.2), report(0.4)
    for key in ("sweep_rms_torque_Nm", "sweep_p99_torque_Nm", "sweep_peak_current_A"):
        assert fast.verdict(key).value / slow.verdict(key).value == pytest.approx(4.0, rel=0.02)
    ratio = fast.verdict("sweep_mean_power_W").value / slow.verdict("sweep_mean_power_W").value
    assert ratio == pytest.approx(8.0, rel=0.02)


def test_power_is_that_of_the_run() -> None:
    found = report(0.2, 0.16, 0.16)
    for joint in ("sweep", "pitch"):
        out = found.verdict(f"{joint}_mean_power_W").value
        back = found.verdict(f"{joint}_mean_regenerative_power_W").value
        mean = found.run.summary()[f"mean_{joint}_motor_power_W"]
        assert out - back == pytest.approx(mean, rel=1e-3, abs=2e-5)


def test_an_acceleration_that_jumps_is_forgiven_within_one_count() -> None:
    """The half-sine flip has infinite jerk, and a motion within the limits 4e-5 rad away."""
    found = report(0.2, 0.5, 0.16)
    distance = found.verdict("pitch_nearest_motion_rad")
    assert 0.0 < distance.value < 1e-4 < distance.bound
    assert found.verdict("pitch_jerk_rad_per_s3").holds
    strict = check_feasibility(RIG, stroke(0.2, 0.5, 0.16), tolerances=Tolerances(resolution=1e-6))
    broken = {verdict.key for verdict in strict.broken}
    assert broken == {"pitch_jerk_rad_per_s3", "pitch_nearest_motion_rad"}
    assert strict.verdict("pitch_jerk_rad_per_s3").value == math.inf
    assert strict.summary()["verdicts"]["pitch_jerk_rad_per_s3"]["value"] is None


def test_too_fast_is_named_limit_by_limit() -> None:
    found = report(0.62)
    broken = {verdict.key for verdict in found.broken}
    assert not found.feasible and not found.feasible_joint("sweep")
    assert {"sweep_velocity_rad_per_s", "sweep_acceleration_rad_per_s2"} <= broken
    assert "sweep_nearest_motion_rad" in broken and "cl_change" in broken
    # 1.0472 (2 pi 0.62)^2 = 15.9 against half the continuous torque over the inertia
    assert found.verdict("sweep_acceleration_rad_per_s2").value == pytest.approx(15.9, abs=0.05)
    assert found.projection.changed
    assert found.verdict("sweep_position_rad").holds


def test_limits_cost_lift() -> None:
    """With 0.7 of the acceleration it needs the sinusoid keeps 0.86 of its sweep.

    Coefficients divide by the speed asked for, so lift falls with the mean square of the rate.
    """
    limits = rig_limits(RIG_MOTORS).with_accelerations(SINUSOID.times(0.7, 1.0))
    found = check_feasibility(RIG, stroke(), limits=limits)
    assert found.projection.sweep.amplitude_ratio == pytest.approx(0.864, abs=0.005)
    left, whole = (s.sample(400).sweep_rate for s in (found.projection.stroke, stroke()))
    assert found.run.result.reference_force == reference_force(RIG.wing, stroke(), RIG.fluid)
    assert found.verdict("cl_change").value == pytest.approx(
        np.mean(left**2) / np.mean(whole**2) - 1.0, abs=0.03
    )
    assert not found.verdict("cl_change").holds
    # the error is against what was asked for: the projection's own, and the servo's small one
    asked, limited = found.verdict("sweep_rms_tracking_error_rad"), found.projection.sweep
    assert asked.value == pytest.approx(limited.distance_rms, rel=0.03)


def test_paper_limits_hold_the_papers_fastest_reversals() -> None:
    limits = rig_limits(RIG_MOTORS).with_accelerations(PAPER_KINEMATICS)
    found = check_feasibility(RIG, stroke(0.2, 0.16, 0.5), limits=limits)
    assert found.feasible
    assert found.verdict("sweep_acceleration_rad_per_s2").margin == pytest.approx(0.0, abs=1e-6)
    faster = check_feasibility(RIG, stroke(0.21, 0.16, 0.5), limits=limits)
    assert not faster.verdict("sweep_acceleration_rad_per_s2").holds


def test_stroke_beyond_the_stops_is_infeasible_and_not_an_error() -> None:
    wide = SunTangStroke(0.1, math.radians(100.0), PITCH)
    found = check_feasibility(RIG, wide)
    assert found.verdict("sweep_position_rad").margin == pytest.approx(-1.0 / 9.0)
    assert not found.verdict("sweep_position_rad").holds


def test_stroke_without_lift_is_not_judged_by_percents_of_nothing() -> None:
    found = check_feasibility(RIG, SunTangStroke(0.2, SWEEP, 0.0))
    exact, reached = found.prescribed, found.run.result
    assert abs(exact.cl) < 0.1 * exact.cd
    change = found.verdict("cl_change").value
    assert change == pytest.approx((reached.cl - exact.cl) / (0.1 * exact.cd))
    assert found.feasible, found.broken


def test_without_a_start_from_rest(monkeypatch: pytest.MonkeyPatch) -> None:
    run = flaprig.Twin.run

    def fails(twin: flaprig.Twin, *more: object) -> TwinRun:
        if twin.limits is not None:
            raise RuntimeError("no way onto the stroke")
        return run(twin, *more)  # type: ignore[arg-type]

    monkeypatch.setattr(flaprig.Twin, "run", fails)
    found = check_feasibility(RIG, stroke())
    assert found.feasible
    key = "sweep_rms_torque_Nm"
    assert found.verdict(key).value == pytest.approx(report().verdict(key).value, rel=1e-3)


def test_a_long_start_is_not_judged(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where the stroke is joined after 1.4 of 2 cycles, the run goes on for three more."""
    run, asked = flaprig.Twin.run, list[int]()

    def slow(twin: flaprig.Twin, wanted: SunTangStroke, cycles: int, *_: object) -> TwinRun:
        asked.append(cycles)
        return replace(run(twin, wanted, cycles), joined_at=1.4 * wanted.period)

    monkeypatch.setattr(flaprig.Twin, "run", slow)
    found = check_feasibility(RIG, stroke(), cycles=2)
    assert asked == [2, 5]
    assert found.run.result.averaged_cycles == (3, 5)


def test_lattice_judges_as_the_quasi_steady_model() -> None:
    coarse = flaprig.UVLM(chordwise=4, spanwise=6, steps_per_cycle=40)
    found = check_feasibility(RIG.with_(model=coarse), stroke())
    assert found.feasible
    assert found.verdict("sweep_peak_torque_Nm").value == pytest.approx(0.123, rel=0.1)


def test_summary_is_ready_for_json_and_names_units() -> None:
    summary = json.loads(json.dumps(report().summary(), allow_nan=False))
    # one averaged cycle has no spread
    assert summary["cl_spread"] is None
    assert summary["feasible"] is True and summary["broken"] == []
    assert set(summary["verdicts"]["sweep_peak_current_A"]) == {"value", "bound", "margin", "holds"}
    assert summary["verdicts"]["sweep_mean_power_W"]["bound"] is None
    assert len(summary["verdicts"]) == len(report().verdicts) == 36


@pytest.mark.parametrize("name", ["report.json", "report", "report.CSV"])
def test_other_endings_are_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(ValueError, match=r"FeasibilityReport.save: path must be one that"):
        report().save(tmp_path / name)


def test_saved_table(tmp_path: Path) -> None:
    path = tmp_path / "report.csv"
    report().save(path)
    table = np.genfromtxt(path, delimiter=",", names=True, dtype=None, encoding="utf-8")
    assert table.size == 36
    row = next(row for row in table if row["quantity"] == "peak_torque")
    assert row["joint"] == "sweep" and row["bound"] == pytest.approx(4.1)
    assert row["margin"] == pytest.approx(1.0 - row["value"] / 4.1)
    with pytest.raises(ValueError, match="path must be one that ends in .csv"):
        report().save(tmp_path / "report.txt")


def test_unknown_key_names_those_that_exist() -> None:
    with pytest.raises(KeyError, match="sweep_peak_torque_Nm"):
        report().verdict("sweep_peak_torque")


def test_progress_rises_to_one() -> None:
    told: list[float] = []
    check_feasibility(RIG, stroke(), cycles=2, progress=told.append)
    assert told == sorted(told) and told[-1] == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ({"rig": 3}, "rig must be a Rig"),
        ({"rig": Rig}, "rig must be a Rig"),
        ({"stroke": "flap"}, "stroke must be a stroke"),
        ({"stroke": lambda time: time}, "check_feasibility: stroke must be a stroke"),
        ({"stroke": SunTangStroke}, "check_feasibility: stroke must be a stroke"),
        ({"progress": 1}, "progress must be a function"),
        ({"cycles": 1}, "cycles must be a whole number"),
        ({"limits": 7}, "limits must be a Limits"),
        ({"tolerances": 0.1}, "tolerances must be a Tolerances"),
        ({"time_step": -1.0}, "time_step must be"),
        ({"feedforward": 1}, "feedforward must be True or False"),
    ],
)
def test_bad_argument_is_named(arguments: dict[str, object], said: str) -> None:
    whole = {"rig": RIG, "stroke": stroke(), **arguments}
    with pytest.raises(ValueError, match=said):
        check_feasibility(**whole)  # type: ignore[arg-type]
