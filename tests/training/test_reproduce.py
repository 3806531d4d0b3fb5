"""`flaprig reproduce`: the whole way on few strokes, and what it refuses."""

from __future__ import annotations

import json

import pytest

from flaprig.cli import main
from flaprig.strokes import load


@pytest.mark.slow
def test_the_whole_way_on_few_strokes(tmp_path, capsys):
    few = ["--quasi-steady-steps", "1024", "--uvlm-steps", "400", "--cycles", "1", "--json"]
    assert main(["reproduce", "--seed", "2", "--out", str(tmp_path), *few]) == 0
    summary = json.loads(capsys.readouterr().out)
    assert list(summary["cases"]) == ["sinusoid", "case A", "case B"]
    for case in ("case A", "case B"):
        parts = summary["cases"][case]
        # measured in the paper (its Table 1), and some gain after however few strokes
        assert parts["paper"]["cl"] in (2.44, 2.63)
        assert parts["uvlm"]["lift_to_drag_gain_percent"] > 0.0
        # the motors follow: lift within 5 % of the prescribed motion's
        assert parts["twin"]["cl"] == pytest.approx(parts["uvlm"]["cl"], rel=0.05)
    for name in ("profiles.png", "strokes.png", "learning.png", "summary.json"):
        assert (tmp_path / name).stat().st_size > 500
    for name in ("case_a.json", "case_b.json"):
        assert load(tmp_path / name).frequency == 0.2


def test_wrong_settings_are_one_sentence(tmp_path, capsys):
    out = tmp_path / "run"
    for words, sentence in (
        (["--sweep-acceleration", "0.5"], "--sweep-acceleration must be a number from 1"),
        (["--uvlm-steps", "0"], "--uvlm-steps must be a whole number from 1"),
    ):
        assert main(["reproduce", "--out", str(out), *words]) == 2
        assert sentence in capsys.readouterr().err
    assert not out.exists()
