"""Orders and uncertainties: on known sequences, and on a coarse rig."""

import math

import pytest

from flaprig.validation import convergence
from flaprig.validation.convergence import Convergence, left_to_gain, order


@pytest.mark.parametrize("power", [1.0, 2.0])
def test_order_and_limit_of_a_known_sequence(power):
    values = [3.0 + 0.1 * h**power for h in (1.5, 1.0, 1 / 1.5)]
    assert order(values) == pytest.approx(power, rel=1e-9)
    # what is left of the middle one is 0.1, times the factor of safety
    assert left_to_gain(values) == pytest.approx(1.25 * 0.1, rel=1e-9)


def test_no_order_where_nothing_converges():
    assert math.isnan(order([1.0, 1.2, 1.1]))
    # first order is assumed then
    assert left_to_gain([1.0, 1.2, 1.1]) == pytest.approx(1.25 * 0.3)


def test_all_settings_are_swept_around_the_default():
    for sweep in convergence.sweeps(convergence.UVLM()):
        assert convergence.UVLM() in sweep.models and len(sweep.models) == len(sweep.values)
        if sweep.refines:
            assert sweep.models.index(convergence.UVLM()) == len(sweep.models) - 2


@pytest.mark.slow
def test_defaults_are_converged():
    outcome = Convergence().run()
    rows = {row.quantity: row.value for row in outcome.rows}
    (table,) = outcome.tables
    lift = dict(zip(table.header, table.lines[0], strict=True))
    # differences of 1 % between lattices whose free wakes spread by 0.3 %: of single strokes, whose
    # neighbours' orders lie between 0.9 and 2.5, nothing could be asked
    assert 1.0 <= float(lift["order in panels along the chord"]) <= 3.0
    for name, most in (("C_L", 3.0), ("C_D", 3.0), ("L/D", 1.5), ("sweep torque, peak", 8.0)):
        assert rows[f"{name}, numerical uncertainty [%]"] < most
