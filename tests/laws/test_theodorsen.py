"""Harmonic heave and pitch of a section against Theodorsen (1935), amplitude and phase."""

import numpy as np
import pytest

from flaprig import theory
from tests.laws.motions import SECTION, flight, lift_of, section_air, ticks

# of the chord, and in radians: small, since the theory is linear
AMPLITUDE = 0.01
PERIODS = 3


def oscillation(k, kind, chordwise, fraction):
    """Lift over Theodorsen's, complex: from loads, and from the circulation at ticks."""
    omega = 2 * k  # chord and speed are one
    count = round(2 * np.pi / omega * chordwise)
    step = 2 * np.pi / omega / count
    time = step * np.arange(count * PERIODS)
    wave = AMPLITUDE * np.exp(1j * omega * time)
    motion = flight(time, **{kind: [(wave * (1j * omega) ** n).real for n in range(3)]})
    air = section_air(chordwise, step, len(time), shedding_fraction=fraction)
    loads, bound = ticks(air, motion, step)
    heave, pitch = (-AMPLITUDE, 0.0) if kind == "heave" else (0.0, AMPLITUDE)  # his heave is down
    exact, _ = theory.oscillating_aerofoil(1.0, 1.0, 1.0, omega, heave, pitch)

    def amplitude(history):
        return 2 * np.mean(history[-count:] * np.exp(-1j * omega * time[-count:]))

    areas = np.full(chordwise, 1 / chordwise)
    areas[-1] *= 0.5
    impulse = bound[:, :, 0] @ areas
    ticked = amplitude(bound[:, -1, 0]) + 1j * omega * amplitude(impulse)
    return amplitude(lift_of(loads, motion)) / SECTION / exact, ticked / exact


@pytest.mark.parametrize("kind", ["heave", "pitch"])
@pytest.mark.parametrize("k", [0.1, 0.5])
def test_circulation_follows_theodorsen(k, kind):
    # shed as if the wake went on with the lattice's own spacing: nearly exact
    ticked = oscillation(k, kind, 8, 0.2)[1]
    assert abs(ticked) == pytest.approx(1.0, abs=0.003)
    assert np.degrees(np.angle(ticked)) == pytest.approx(0.0, abs=0.3)


@pytest.mark.parametrize("kind", ["heave", "pitch"])
@pytest.mark.parametrize(("k", "within"), [(0.1, 0.012), (0.5, 0.10)])
def test_loads_follow_theodorsen(k, kind, within):
    # our loads lag between ticks and the quarter rule sheds late; both shrink with refinement
    coarse, fine = (oscillation(k, kind, m, 0.25)[0] for m in (4, 8))
    assert abs(abs(fine) - 1) < within
    assert abs(np.angle(fine)) < np.radians(2)
    assert abs(fine - 1) < 0.75 * abs(coarse - 1)


PINS = {
    (0.1, "heave"): 1.010048,
    (0.1, "pitch"): 1.009764,
    (0.5, "heave"): 1.093246,
    (0.5, "pitch"): 1.085811,
}


@pytest.mark.parametrize("where", PINS)
def test_loads_are_those_of_today(where):
    assert abs(oscillation(*where, 8, 0.25)[0]) == pytest.approx(PINS[where], rel=1e-4)
