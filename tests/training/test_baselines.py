"""CMA-ES and random search, on few strokes."""

from __future__ import annotations

import numpy as np
import pytest

from flaprig.tasks.hover import Hover
from flaprig.tasks.hover_settings import HoverSettings
from training import baselines


@pytest.mark.parametrize("search", ["cma_es", "random"])
def test_searches_improve_within_their_count_and_repeat_themselves(search):
    found = []
    for _ in range(2):
        judge = baselines.Judge(Hover(HoverSettings(threads=1)))
        baselines.SEARCHES[search](judge, 1000, 1)
        assert 1000 - baselines.POPULATION < judge.count <= 1000
        found.append(judge.best)
    assert found[0] == found[1]
    assert found[0].reward > 1.0


def test_the_best_stroke_is_worth_what_is_said(tmp_path):
    hover = Hover(HoverSettings(threads=1))
    judge = baselines.Judge(hover)
    baselines.evolution(judge, 320, 2)
    again = hover.evaluate(np.array([judge.best.coefficients]))
    assert again.reward[0] == pytest.approx(judge.best.reward, rel=1e-9)
    assert not again.exceeded[0]


def test_strokes_beyond_the_bounds_are_sloped_and_never_the_best():
    judge = baselines.Judge(Hover(HoverSettings(threads=1)))
    wild = np.zeros((2, 12))
    wild[:, 0], wild[:, 9] = -1.0, 1.0
    wild[:, 2] = 0.5, 1.0
    values = judge(wild)
    assert judge.best is None
    assert values[1] < values[0] < -2.0


def test_wrong_settings_are_one_sentence(tmp_path, capsys):
    assert baselines.main(["--out", str(tmp_path / "x"), "--what", "dance"]) == 2
    assert "--what must be one of compare, sweep" in capsys.readouterr().err
