"""The paper's sinusoid by both lattices, and the nine kinematics."""

import pytest

from flaprig.validation.paper import DURATIONS, MODELS, Paper


@pytest.mark.slow
def test_sinusoid_within_tolerance_and_nine_kinematics_told():
    outcome = Paper().run()
    assert not outcome.missed
    rows = {row.quantity: row for row in outcome.rows}
    assert len(rows) == 2 * len(MODELS)
    (nine,) = outcome.tables
    assert len(nine.lines) == len(DURATIONS) ** 2
    assert all(len(line) == len(nine.header) for line in nine.lines)
    assert rows["sinusoid, UVLM, C_L"].value == pytest.approx(1.9376, rel=0.005)
    assert rows["sinusoid, extended UVLM, C_L"].value == pytest.approx(1.980, rel=0.005)
    assert rows["sinusoid, extended UVLM, L/D"].value == pytest.approx(0.768, rel=0.005)
    # every coefficient carries its spread, and it is small
    assert all(0.0 <= row.spread < 0.03 for row in outcome.rows)
    # the faster the flip, the less drag
    ratio = {k: v["lift_to_drag"] for k, v in outcome.data["UVLM"].items()}
    assert ratio["0.16/0.16"] > ratio["0.16/0.32"] > ratio["0.16/0.5"]
