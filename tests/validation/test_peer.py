"""The peer: what is said without it, flight held to its tolerances, and why hover differs."""

import math
import sys

import pytest

from flaprig.validation import peer_code
from flaprig.validation.peer import MISSING, Peer

# seconds, once the peer is compiled
SMALL = Peer(chordwise=4, spanwise=4, steps_per_cycle=20, cycles=2, distance=4.0)


@pytest.fixture(scope="module")
def outcome():
    pytest.importorskip("pterasoftware", reason="the extra «bench» brings Ptera Software")
    told = []
    outcome = SMALL.run(told.append)
    assert told == [1.0]
    return outcome


def row(outcome, quantity, source):
    (found,) = [r for r in outcome.rows if r.quantity == quantity and r.source.endswith(source)]
    return found


def test_without_the_peer_only_a_note(monkeypatch):
    monkeypatch.setitem(sys.modules, "pterasoftware", None)
    outcome = Peer().run()
    assert outcome.rows == () and outcome.draw is None
    assert outcome.notes == (MISSING,)
    assert "pip install flaprig[bench]" in MISSING


@pytest.mark.parametrize(
    ("name", "value"),
    [("chordwise", 1), ("cycles", 1), ("angle_deg", 0.0), ("reduced_frequency", math.nan)],
)
def test_bad_parameters_are_refused(name, value):
    with pytest.raises(ValueError, match=f"peer: {name} must be"):
        Peer(**{name: value}).run()


def test_flight_agrees(outcome):
    held = [r for r in outcome.rows if r.tolerance is not None]
    assert len(held) == 6 and not outcome.missed


def test_hover_is_the_same_motion(outcome):
    assert row(outcome, "hover, panels' corners apart [c]", "our motion").value < 1e-9


def test_hover_differs_by_the_thrust_along_the_chord(outcome):
    """Its normal force is ours; its total is ours with the suction turned along the chord."""
    theirs = peer_code.source()
    assert row(outcome, "hover, C_L", theirs).error < -30.0
    assert abs(row(outcome, "hover, C_L", "a step earlier").error) < 5.0
    assert abs(row(outcome, "hover, L/D", "a step earlier").error) < 5.0
    assert abs(row(outcome, "hover, its settings, suction along chord, C_L", theirs).error) < 10.0
    assert row(outcome, "hover, correlation of the lifts", "a step earlier").value > 0.98


def test_picture_and_data(outcome, tmp_path):
    outcome.draw(tmp_path / "peer.png")
    assert (tmp_path / "peer.png").stat().st_size > 10_000
    assert outcome.data["hover_lift_theirs_N"].shape == (40,)
