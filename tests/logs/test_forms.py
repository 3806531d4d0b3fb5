"""Every form of table that a lab writes is the same record."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import flaprig
from flaprig.logs import JointCounts, PositionCounts
from flaprig.logs.units import Quantity, column_of, is_unit
from tests.logs.records import HEADER, angles, clock, text, written

TIME = clock(2.0)
SWEEP, PITCH = angles(TIME)
COLUMNS = (TIME, SWEEP, PITCH)


def german(content: str) -> str:
    return content.replace(".", ",")


def quoted(content: str) -> str:
    lines = content.strip().split("\n")
    return "\n".join(",".join(f'"{cell}"' for cell in line.split(",")) for line in lines)


def quoted_german(content: str) -> str:
    head, *lines = content.strip().split("\n")
    cells = [[german(cell) for cell in line.split(",")] for line in lines]
    return "\n".join([head, *(",".join(f'"{cell}"' for cell in row) for row in cells)])


def with_delimiter(mark: str) -> str:
    return text(*COLUMNS, header=HEADER.replace(",", mark), delimiter=mark)


FORMS = {
    "commas": text(*COLUMNS),
    "semicolons": with_delimiter(";"),
    "tabs": with_delimiter("\t"),
    "bars": with_delimiter("|"),
    "blanks": with_delimiter("  "),
    "decimal comma, semicolons": german(with_delimiter(";")),
    "decimal comma, tabs": german(with_delimiter("\t")),
    "quotes": quoted(text(*COLUMNS)),
    "quotes and decimal commas": quoted_german(text(*COLUMNS)),
    "windows": text(*COLUMNS).replace("\n", "\r\n"),
    "comments": "# rig 3, run 12\n" + text(*COLUMNS) + "# end\n",
    "remarks without a mark": "Rig 3, run 12\nDate: 2026-01-01\n\n" + text(*COLUMNS),
    "line of units": text(*COLUMNS, header="time,sweep,pitch\ns,deg,deg"),
    "units in brackets": text(*COLUMNS, header="Time [s],Sweep angle (deg),Pitch {°}"),
    "milliseconds": text(1e3 * TIME, SWEEP, PITCH, header="time_ms,sweep_deg,pitch_deg"),
    "ms in a line of units": text(1e3 * TIME, SWEEP, PITCH, header="t,phi,theta\nms,deg,deg"),
    "microseconds": text(1e6 * TIME, SWEEP, PITCH, header="timestamp_us;phi/deg;theta/deg").replace(
        ",", ";"
    ),
    "nanoseconds": text(1e9 * TIME, SWEEP, PITCH, header="stamp_ns,φ_deg,θ_deg"),
    "radians": text(
        TIME, np.radians(SWEEP), np.radians(PITCH), header="time_s,sweep_rad,pitch_rad", form="%.9f"
    ),
    "camel case": text(1e3 * TIME, SWEEP, PITCH, header="timeMs,sweepDeg,pitchDeg"),
    "other columns": text(*COLUMNS, TIME, header=HEADER + ",status")
    .replace("\n", ",OK\n")
    .replace("status,OK", "status,word"),
}


@pytest.mark.parametrize("name", FORMS)
def test_every_form_is_the_same_stroke(name: str, tmp_path: Path) -> None:
    log = flaprig.read_log(written(tmp_path / "log.txt", FORMS[name]))
    assert log.stroke.frequency == pytest.approx(0.2, rel=1e-6)
    assert np.degrees(log.stroke.sweep_amplitude) == pytest.approx(60.0, abs=0.01)
    assert np.degrees(log.stroke.pitch_amplitude) == pytest.approx(45.0, abs=0.01)
    assert not log.doubts and "2 cycles" in log.fitted


@pytest.mark.parametrize(
    "encoding", ["utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "utf-32", "latin-1"]
)
def test_every_encoding(encoding: str, tmp_path: Path) -> None:
    content = text(*COLUMNS, header="time [s],sweep [°],pitch [°]")
    log = flaprig.read_log(written(tmp_path / "log.csv", content, encoding))
    assert np.degrees(log.stroke.sweep_amplitude) == pytest.approx(60.0, abs=0.01)
    # one byte a letter is a guess, and said
    assert any("Latin-1" in doubt for doubt in log.doubts) == (encoding == "latin-1")


def test_counts_with_the_rigs_zero_and_direction(tmp_path: Path) -> None:
    own = PositionCounts(JointCounts(zero=1000, direction=-1, lowest=-4096), JointCounts())
    motion = [own.sweep.counts(np.radians(SWEEP)), own.pitch.counts(np.radians(PITCH))]
    content = text(TIME, *motion, header="time_s,sweep_count,pitch_ticks", form="%.10g")
    log = flaprig.read_log(written(tmp_path / "log.csv", content), counts=own)
    assert np.degrees(log.stroke.sweep_cos[0]) == pytest.approx(-60.0, abs=0.02)
    assert "sweep_count was read as counts of 4096 a turn with the zero at 1000" in log.doubts


def test_without_units_a_guess_is_said(tmp_path: Path) -> None:
    log = flaprig.read_log(written(tmp_path / "log.csv", text(*COLUMNS, header="t,sweep,pitch")))
    assert log.doubts == (
        "t has no unit: it was read as seconds",
        "sweep has no unit: it was read as degrees",
        "pitch has no unit: it was read as degrees",
    )


def test_columns_nobody_needs_are_kept_or_ignored(tmp_path: Path) -> None:
    force = np.cos(2.0 * np.pi * 0.4 * TIME)
    current = np.where(np.arange(TIME.size) % 7 == 0, np.nan, 1.0)
    content = text(*COLUMNS, force, current, header=HEADER + ",lift_N,current_mA")
    log = flaprig.read_log(written(tmp_path / "log.csv", content))
    assert list(log.columns) == ["lift_N", "current_mA"]
    # its periodic course, at any instant
    course = log.course("lift_N")
    np.testing.assert_allclose(course(np.array([0.0, 1.0])), np.cos([0.0, 0.8 * np.pi]), atol=1e-4)
    with pytest.raises(KeyError, match="no column drag_N; there are lift_N, current_mA"):
        log.course("drag_N")


def test_names_for_a_table_without_any(tmp_path: Path) -> None:
    path = written(tmp_path / "log.csv", text(*COLUMNS).split("\n", 1)[1])
    with pytest.raises(ValueError, match=r"must have a line of names, .* line 1 already holds 3"):
        flaprig.read_log(path)
    log = flaprig.read_log(path, names=("time_s", "sweep_deg", "pitch_deg"))
    assert log.stroke.frequency == pytest.approx(0.2, rel=1e-6)
    with pytest.raises(ValueError, match="names must be as many as the columns, 3, got 2"):
        flaprig.read_log(path, names=("time_s", "sweep_deg"))


@pytest.mark.parametrize(
    ("head", "words"),
    [
        ("time_s,angle,pitch_deg", "columns missing: sweep_rad, sweep_deg or sweep_count; this"),
        ("time_s,sweep_rate_deg,pitch_deg", "columns missing: sweep_rad"),
        ("time_s,sweep_goal_deg,pitch_deg", "columns missing: sweep_rad"),
        ("time_s,sweep_deg,sweep_rad", "sweep must be given once, got sweep_deg and sweep_rad"),
        ("time_s,sweep_deg,sweep_deg", "columns must be named once, got sweep_deg again"),
        ("time_deg,sweep_deg,pitch_deg", "time_deg: the unit of time must be s, ms, us or ns"),
        ("time_s,sweep_mm,pitch_deg", "columns missing: sweep_rad"),
        ("time_s,sweep [mm],pitch_deg", r"sweep \[mm\]: the unit of sweep must be rad, mrad, deg"),
        ("time_s,sweep_rad,pitch_deg", r"sweep_rad must be within .* \(degrees\? then name"),
    ],
)
def test_heads_that_say_something_else(head: str, words: str, tmp_path: Path) -> None:
    path = written(tmp_path / "log.csv", text(*COLUMNS, header=head))
    with pytest.raises(ValueError, match=words) as caught:
        flaprig.read_log(path)
    assert str(caught.value).startswith(f"{path}: ") and "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "a log must have a line of names, got an empty file"),
        (b"PK\x03\x04xxxx", "this is a zip archive"),
        (b"MATLAB 5.0 MAT-file", "this is a MATLAB file; what can be read is a table of text"),
        (b"\x89HDF\r\n", "this is an HDF5 file"),
        (bytes(range(256)) * 4, "this is no text"),
        (b"time_s,sweep_deg,pitch_deg\n", "must have 8 to 2000000 rows, got 0"),
    ],
)
def test_what_is_no_table(content: bytes, words: str, tmp_path: Path) -> None:
    path = tmp_path / "log.csv"
    path.write_bytes(content)
    with pytest.raises(ValueError, match=words):
        flaprig.read_log(path)


def test_names_of_columns() -> None:
    assert column_of("Present Position Sweep [deg]").quantity is Quantity.SWEEP
    assert column_of("theta_rad").quantity is Quantity.PITCH
    assert column_of("heave_deg").quantity is Quantity.DEVIATION
    for other in ("sweep_rate_rad_per_s", "pitch_command_rad", "sweep_torque_Nm", "sweep_error"):
        assert column_of(other).quantity is None, other
    assert is_unit("[deg]") and is_unit("mA") and not is_unit("sweep")
