"""Every benchmark at a size that takes no time: its numbers, its parameters; never a speed."""

import dataclasses
import math
import sys

import pytest

from flaprig.benchmark import benchmark
from flaprig.benchmark.benchmark import command_of
from flaprig.benchmark.suite import BENCHMARKS, benchmark_named
from flaprig.validation.peer import MISSING

GRID = {"chordwise": 1, "spanwise": 2, "steps_per_cycle": 8}
ONE = GRID | {"cycles": 1, "turns": 1}
TINY = {
    "peer": GRID
    | {"cycles": 2, "threads": (1,), "repeats": 1, "peer_repeats": 1, "peer_cycles": (1,)},
    "dial": GRID
    | {"details": (0.25, 0.5), "kinematics": 2, "neighbours": 2, "cycles": 2, "turns": 1},
    "growth": {"steps": (8, 16), "spanwise": (2, 4), "steps_per_cycle": 8, "turns": 1},
    "kernel": {"rows": 3, "strips": 2, "duration": 1e-4, "turns": 1},
    "window": ONE,
    "twin": ONE,
    "batch": ONE | {"strokes": 2},
    "learning": {"envs": 2, "rigs": 2, "actions": 1, "turns": 1},
    "start": ONE,
    "shares": ONE | {"twin_cycles": 1, "strokes": 2},
}
# what may be nothing, or less where noise is all there is
SIGNED = {"%", "exponent", "sd"}


def tiny(name):
    return benchmark_named(name)(**TINY[name])


@pytest.fixture
def alone(monkeypatch):
    """The peer is not there."""
    monkeypatch.setitem(sys.modules, "pterasoftware", None)


@pytest.mark.parametrize("name", BENCHMARKS)
def test_numbers(name, tmp_path, alone):
    told = []
    outcome = tiny(name).run(told.append)
    assert told == sorted(told) and (not told or told[-1] == pytest.approx(1.0))
    assert outcome.rows
    for row in outcome.rows:
        assert row.unit and all(math.isfinite(value) for value in row.turns), row
        assert row.value > 0.0 or row.unit in SIGNED, row
    names = [row.quantity for row in outcome.rows]
    assert len(set(names)) == len(names)
    if outcome.draw is not None:
        outcome.draw(tmp_path / "picture.png")
        assert (tmp_path / "picture.png").stat().st_size > 5_000


def test_without_the_peer_ours_still_runs(alone):
    outcome = tiny("peer").run()
    assert outcome.notes == (MISSING,) and "pip install flaprig[bench]" in MISSING
    assert not any(row.quantity.startswith("Ptera") for row in outcome.rows)
    assert any(row.quantity == "brute force, 1 thread" for row in outcome.rows)


def test_beside_the_peer():
    pytest.importorskip("pterasoftware", reason="the extra «bench» brings Ptera Software")
    rows = {row.quantity: row for row in tiny("peer").run().rows}
    theirs, ours = rows["Ptera Software, 1 thread"], rows["brute force, 1 thread"]
    ratio = rows["Ptera Software over brute force, 1 thread"]
    assert ratio.high == pytest.approx(theirs.value / ours.low)
    assert ratio.at_least == 30.0
    assert math.isfinite(rows["Ptera Software, growth over 8 to 16 steps"].value)


def test_shares_add_up():
    rows = tiny("shares").run().rows
    for case in ("window", "twin", "batch"):
        parts = [row.value for row in rows if row.quantity.startswith(case)]
        assert sum(parts) == pytest.approx(100.0)


@pytest.mark.parametrize(("name", "threads"), [("peer", (1, 2)), ("kernel", 2)])
def test_threads_without_a_core_are_left_out(name, threads, monkeypatch, alone):
    monkeypatch.setattr(benchmark, "cores", lambda: 1)
    outcome = benchmark_named(name)(**TINY[name] | {"threads": threads}).run()
    assert outcome.notes[-1] == "2 threads are left out: this machine has fewer cores."
    assert not any("2 threads" in row.quantity for row in outcome.rows)


@pytest.mark.parametrize(
    ("name", "field", "value"),
    [
        ("peer", "cycles", 0),
        ("peer", "threads", ()),
        ("peer", "threads", (0,)),
        ("peer", "peer_repeats", 0),
        ("peer", "peer_cycles", (0,)),
        ("dial", "details", ()),
        ("dial", "details", (0.0,)),
        ("dial", "neighbours", 1),
        ("growth", "steps", (50,)),
        ("growth", "cycles", (1, 3, 2)),
        ("growth", "spanwise", (2, 3)),
        ("growth", "turns", 0),
        ("kernel", "rows", 0),
        ("kernel", "duration", math.nan),
        ("kernel", "threads", 0),
        ("window", "cycles", 0.5),
        ("twin", "steps_per_cycle", 10_000),
        ("twin", "turns", 0),
        ("batch", "strokes", 0),
        ("learning", "rigs", 0),
        ("start", "chordwise", 0),
        ("shares", "twin_cycles", 0),
    ],
)
def test_bad_parameters_are_refused_by_name(name, field, value):
    with pytest.raises(ValueError, match=f"{name}: {field} must be"):
        benchmark_named(name)(**{field: value}).run()


def test_command_repeats_what_was_changed():
    assert command_of(benchmark_named("peer")()) == "flaprig bench peer"
    changed = benchmark_named("peer")(steps_per_cycle=8, threads=(1, 4))
    assert command_of(changed) == "flaprig bench peer --steps-per-cycle 8 --threads 1 4"
    assert command_of(benchmark_named("peer")(peer_cycles=())).endswith("--peer-cycles")


def test_every_benchmark_is_complete():
    assert set(TINY) == set(BENCHMARKS)
    for name, kind in BENCHMARKS.items():
        assert kind.name == name and kind.claim and kind.__doc__
        assert dataclasses.is_dataclass(kind) and kind.__dataclass_params__.frozen
    with pytest.raises(ValueError, match="NAME must be one of peer, "):
        benchmark_named("nothing")
