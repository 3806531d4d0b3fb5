import numpy as np
import pytest

from flaprig.logs import read_log
from flaprig.strokes import FourierStroke

STROKE = FourierStroke(0.5, [-1.0, 0.1], [0.0, 0.05], [0.1, 0.0], [0.7, 0.05])


def rows(count=100, cycles=1.0, start=3.0, closed=False):
    """Time, sweep, pitch and a force. Shape (n, 4)."""
    time = np.arange(round(count * cycles) + closed) / count * STROKE.period
    motion = STROKE.motion(time)
    return np.column_stack([start + time, motion.sweep, motion.pitch, np.cos(np.pi * time)])


def written(path, table, header="time_s,sweep_rad,pitch_rad,lift_N"):
    lines = [header, *(",".join(repr(float(v)) for v in row) for row in table)]
    path.write_text("\n".join(lines) + "\n")
    return path


@pytest.fixture
def file(tmp_path):
    return tmp_path / "log.csv"


@pytest.mark.parametrize("closed", [False, True])
def test_one_cycle_reads_back(file, closed):
    found = read_log(written(file, rows(closed=closed)))
    assert found.stroke.frequency == pytest.approx(0.5, rel=1e-12)
    time = np.linspace(0.0, 2.0, 333)
    ours, theirs = found.stroke.motion(3.0 + time), STROKE.motion(time)
    np.testing.assert_allclose(ours.sweep, theirs.sweep, atol=1e-8)
    np.testing.assert_allclose(ours.pitch_rate, theirs.pitch_rate, atol=1e-5)
    assert list(found.columns) == ["lift_N"] and found.cycles == 1
    assert found.columns["lift_N"].size == len(found.stroke.time)


def test_degrees_as_the_header_says(file):
    table = rows()
    table[:, 1] = np.degrees(table[:, 1])
    found = read_log(written(file, table, "time_s,sweep_deg,pitch_rad,lift_N"))
    assert found.stroke.sweep_amplitude == pytest.approx(STROKE.sweep_amplitude, rel=1e-6)
    assert found.stroke.pitch_amplitude == pytest.approx(STROKE.pitch_amplitude, rel=1e-6)


def test_order_of_columns_comments_and_other_columns(file):
    table = rows()[:, [2, 0, 3, 1]]
    written(file, table, "# rig 2\npitch_rad, time_s, drag_N, sweep_rad")
    found = read_log(file)
    assert found.stroke.sweep[7] == table[7, 3] and found.stroke.pitch[7] == table[7, 0]
    np.testing.assert_array_equal(found.columns["drag_N"], table[:, 2])


def test_many_cycles_are_averaged(file):
    table = rows(cycles=8.4)
    noise = np.random.default_rng(9).normal(scale=0.01, size=len(table))
    table[:, 1] += noise
    table[:, 3] += noise
    found = read_log(written(file, table), frequency=0.5)
    assert found.cycles == 8 and len(found.stroke.time) == 100
    error = np.array(found.stroke.sweep) - STROKE.motion(np.array(found.stroke.time) - 3.0).sweep
    # noise falls with the root of the number of cycles
    assert 0.5 * 0.01 / np.sqrt(8) < error.std() < 1.5 * 0.01 / np.sqrt(8)
    assert np.abs(found.columns["lift_N"] - rows()[:, 3]).std() < 0.005


def test_steps_that_do_not_divide_the_cycle(file):
    time = np.arange(0.0, 6.5, 0.0137)
    motion = STROKE.motion(time)
    table = np.column_stack([time, motion.sweep, motion.pitch, time])
    found = read_log(written(file, table), frequency=0.5)
    assert found.cycles == 3
    wanted = STROKE.motion(np.array(found.stroke.time)).sweep
    np.testing.assert_allclose(found.stroke.sweep, wanted, atol=1e-6)


def swapped(table):
    table[[30, 31], 0] = table[[31, 30], 0]
    return table


def holed(table):
    table[12, 2] = np.nan
    return table


BAD = {
    "missing columns": (rows(), "time_s,angle,pitch_rad,lift_N", "columns missing: sweep_rad or"),
    "all missing": (rows(), "a,b,c,d", "columns missing: time_s, sweep_rad or sweep_deg, pitch"),
    "NaN": (holed(rows()), None, "line 14: pitch_rad must be a finite number, got 'nan'"),
    "time back": (swapped(rows()), None, "line 33: time_s must increase, got 3.6 after 3.62"),
    "degrees": (
        rows() * [1.0, 57.3, 57.3, 1.0],
        None,
        r"sweep_rad must be within 3.14159, got 6\d\.\d+ \(degrees\? then name .* sweep_deg\)",
    ),
    "half a cycle": (rows(cycles=0.5), None, "must cover one whole cycle, but sweep ends 1.9"),
    "more cycles": (rows(cycles=2.3), None, r"whole cycle, .* \(half a cycle\? several, then"),
    "few rows": (rows()[:5], None, "a log must have 8 to 100000 rows, got 5"),
    "twice": (rows(), "time_s,sweep_rad,pitch_rad,sweep_rad", "named once, got sweep_rad again"),
    "both units": (rows(), "time_s,sweep_rad,pitch_rad,sweep_deg", "given once, got sweep_rad and"),
    "cells": (rows(), "time_s,sweep_rad,pitch_rad", "line 2 must have 3 cells, got 4"),
}


@pytest.mark.parametrize("fault", BAD)
def test_bad_logs_give_one_sentence(fault, file):
    table, header, sentence = BAD[fault]
    written(file, table, *([header] if header else []))
    with pytest.raises(ValueError, match=sentence) as caught:
        read_log(file)
    assert str(caught.value).startswith(f"{file}: ") and "\n" not in str(caught.value)


def test_other_bad_files(file):
    with pytest.raises(FileNotFoundError):
        read_log(file)
    file.write_text("")
    with pytest.raises(ValueError, match="must have a line of names, got an empty file"):
        read_log(file)
    file.write_bytes(b"\xff\xfe\x00time")
    with pytest.raises(ValueError, match="a log must be UTF-8 text"):
        read_log(file)
    written(file, rows())
    file.write_text(file.read_text().replace("3.02,", "soon,"))
    with pytest.raises(ValueError, match="line 3: time_s must be a finite number, got 'soon'"):
        read_log(file)
    written(file, rows(cycles=0.5))
    with pytest.raises(ValueError, match=r"must cover one whole cycle of 2 s, got 0\.98 s"):
        read_log(file, frequency=0.5)
    with pytest.raises(ValueError, match="frequency must be a positive number in Hz"):
        read_log(file, frequency=0.0)
    written(file, rows(count=5, cycles=4.0))
    with pytest.raises(ValueError, match="a log must have 8 samples in a cycle, got 5"):
        read_log(file, frequency=0.5)
