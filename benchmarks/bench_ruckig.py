"""Time of one control interval of the filter, of joining a stroke and of projecting one.

Run: pytest benchmarks/bench_ruckig.py --benchmark-enable --benchmark-only
"""

from __future__ import annotations

import numpy as np
import pytest

from flaprig.limits import PAPER_KINEMATICS, SINUSOID, RuckigFilter, project, rig_limits
from flaprig.limits.reference import Mode
from flaprig.motors import RIG_MOTORS
from flaprig.strokes import SunTangStroke

INTERVAL = 1e-3
LIMITS = rig_limits(RIG_MOTORS).with_accelerations(PAPER_KINEMATICS)
SINE = SunTangStroke(0.2, np.pi / 3, np.pi / 4)


def following(limits, stroke):
    control = RuckigFilter(limits, INTERVAL)
    control.follow(stroke)
    while control.mode is not Mode.FOLLOWING:
        control.step()
    return control


@pytest.mark.parametrize("share", [1.0, 0.8])
def test_tick_along_a_stroke(benchmark, share):
    limits = LIMITS if share == 1.0 else LIMITS.with_accelerations(SINUSOID.times(share))
    control = following(limits, project(SINE, limits).stroke)
    benchmark.pedantic(control.step, rounds=5000, iterations=1, warmup_rounds=100)
    assert control.mode is Mode.FOLLOWING


def test_tick_on_the_way_to_a_stroke(benchmark):
    control = RuckigFilter(LIMITS, INTERVAL)
    control.follow(SINE)
    benchmark.pedantic(control.step, rounds=500, iterations=1)
    assert control.mode is Mode.JOINING


def test_search_for_the_earliest_instant(benchmark):
    control = RuckigFilter(LIMITS, INTERVAL)
    control.accept(SINE)
    assert benchmark(control.follow, SINE) == pytest.approx(1.064)


def test_projection(benchmark):
    limits = LIMITS.with_accelerations(SINUSOID.times(0.8))
    found = benchmark(project, SINE, limits)
    assert found.changed
