"""What a balance on the wing, its filter and its clock make of the true forces.

The strokes of assets/validation were measured with a balance that turns with the wing. The
source's own processing, read as facts: readings in wing axes pass a causal Butterworth filter of
order 6 at ten times the stroke frequency, whose delay at low frequency is taken off through the
time stamps; an air run is subtracted from the water run; what is left is turned into the tank's
axes with the pitch that the encoders had at the same time stamp; the buoyancy read at rest is
subtracted as a constant, and the horizontal force gets the sign of the sweep's rate.

The time stamps of balance and encoders disagree. `delay` finds by how much, without any model of
the air: a thin plate bears no force along its chord, and with the true delay the chordwise force of
the published histories is smallest. Since the buoyancy is several times the fluid's force, a delay
of a tenth of a second turns enough of it into drag to matter in the means.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar
from scipy.signal import butter, freqs

from flaprig.aero.buoyancy import buoyant_force
from flaprig.strokes import Stroke
from flaprig.validation.measured_file import Measured, history

Array = NDArray[np.float64]

# mean over the 26 strokes of `delay`; its scatter is 0.02 s [s]
DELAY = 0.15
# filter of the source: order, and cut-off in stroke frequencies
ORDER, CUT_OFF = 6, 10.0
# instants in a cycle
COUNT = 200
# how far the two clocks may disagree [s]
MOST_DELAY = 0.4


@dataclass(frozen=True, eq=False)
class OneCycle:
    """Forces in the tank's axes over one cycle, at equal phases from 0. Shape (n,) each.

    Attributes:
        stroke: the motion.
        lift: upward [N].
        drag: against the sweep [N].
    """

    stroke: Stroke
    lift: Array
    drag: Array

    @property
    def pitch(self) -> Array:
        """[rad]."""
        return self._motion()[0]

    def _motion(self) -> tuple[Array, Array]:
        phase = np.arange(self.lift.size) / self.lift.size
        motion = self.stroke.motion(phase / self.stroke.frequency)
        return motion.pitch, np.sign(motion.sweep_rate)

    def in_wing_axes(self, buoyancy: float) -> tuple[Array, Array]:
        """Chordwise and normal force with a buoyancy [N] added to the lift."""
        pitch, sign = self._motion()
        along, up = -sign * self.drag, self.lift + buoyancy
        chord = -(np.cos(pitch) * up + np.sin(pitch) * along)
        return chord, np.sin(pitch) * up - np.cos(pitch) * along

    def turned_back(self, chord: Array, normal: Array, buoyancy: float) -> OneCycle:
        """From wing axes into the tank's, the buoyancy taken off."""
        pitch, sign = self._motion()
        along = -(np.sin(pitch) * chord + np.cos(pitch) * normal)
        up = np.sin(pitch) * normal - np.cos(pitch) * chord
        return OneCycle(self.stroke, up - buoyancy, -sign * along)


def buoyancy(case: Measured) -> float:
    """Of the plate, in [N]."""
    return buoyant_force(case.wing, case.fluid)


def reading(case: Measured, truth: OneCycle, late: float = DELAY) -> OneCycle:
    """What the source would have published of these forces.

    Args:
        case: the stroke, for its buoyancy.
        truth: forces on the wing.
        late: the balance's time stamps behind the encoders' [s].
    """
    lifted = buoyancy(case)
    chord, normal = truth.in_wing_axes(lifted)
    frequency = case.stroke.frequency
    omega: Array = 2.0 * np.pi * frequency * np.arange(chord.size // 2 + 1.0)
    passed = _filtered(omega, 2.0 * np.pi * CUT_OFF * frequency) * np.exp(-1j * omega * late)

    def through(force: Array) -> Array:
        return np.fft.irfft(np.fft.rfft(force) * passed, force.size)

    return truth.turned_back(through(chord), through(normal), lifted)


def _filtered(omega: Array, cut_off: float) -> NDArray[np.complex128]:
    """The Butterworth filter less its delay at low frequency."""
    numerator, denominator = butter(ORDER, cut_off, analog=True)
    _, response = freqs(numerator, denominator, omega)
    late = (denominator[-2] / denominator[-1]).real
    return np.asarray(response * np.exp(1j * omega * late))


def delay(case: Measured) -> float:
    """The balance's time stamps behind the encoders' [s]: where the chordwise force is smallest."""
    found = minimize_scalar(
        lambda late: chordwise(case, late), bounds=(0.0, MOST_DELAY), method="bounded"
    )
    return float(found.x)


def chordwise(case: Measured, late: float) -> float:
    """Root mean square of the published chordwise force, over the reference force."""
    chord, _ = without_buoyancy(case, late)
    return float(np.sqrt(np.mean(np.square(chord))) / case.reference_force)


def towards_the_edge(case: Measured, late: float = DELAY) -> float:
    """Mean force towards the leading edge over the mean size of the normal force."""
    chord, normal = without_buoyancy(case, late)
    return float(-chord.mean() / np.abs(normal).mean())


def without_buoyancy(case: Measured, late: float) -> tuple[Array, Array]:
    """Published chordwise and normal force [N], less what buoyancy alone reads at a delay."""
    phase = np.arange(COUNT) / COUNT
    force = case.reference_force
    read = OneCycle(
        case.stroke, history(case.lift, phase) * force, history(case.drag, phase) * force
    )
    lifted = buoyancy(case)
    chord, normal = read.in_wing_axes(lifted)
    earlier = case.stroke.motion(phase / case.stroke.frequency - late).pitch
    return chord + np.cos(earlier) * lifted, normal - np.sin(earlier) * lifted
