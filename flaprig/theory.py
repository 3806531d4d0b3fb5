"""Closed forms that stand beside the solvers: thin aerofoils, added mass, suction, finite wings.

Chord c, semichord b = c / 2, free stream U, density rho; angles in radians.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import quad
from scipy.special import hankel2

from flaprig import _checks as check

Array = NDArray[np.float64]


def wagner(distance: ArrayLike) -> Array:
    """Share of the steady lift, `distance` semichords (2 U t / c) after a sudden start.

    R. T. Jones, The unsteady lift of a wing of finite aspect ratio, NACA Report 681 (1940): two
    exponentials, within 1 % of Wagner's function.

    Raises:
        ValueError: a distance that is negative or not finite.
    """
    s = _not_negative("wagner", "distance", distance)
    return np.asarray(1.0 - 0.165 * np.exp(-0.0455 * s) - 0.335 * np.exp(-0.3 * s))


def wagner_exact(distance: float) -> float:
    """Wagner's function itself, `distance` semichords after a sudden start.

    I. E. Garrick, On some reciprocal relations in the theory of nonstationary flows, NACA Report
    629 (1938): the sine transform of the real part of Theodorsen's function over k, here less its
    limit of 1/2, so that the integrand falls with k^3.

    Raises:
        ValueError: a distance that is not a number from 0 to 1e4.
    """
    s = check.in_range("wagner_exact", "distance", distance, 0.0, 1e4)
    if s == 0.0:
        return 0.5

    def rest(k: float) -> float:
        return float((theodorsen(k).real - 0.5) / k)

    near = quad(lambda k: rest(k) * np.sin(k * s), 0.0, 1.0, limit=2000)[0]
    far = quad(rest, 1.0, np.inf, weight="sin", wvar=s, limit=2000)[0]
    return float(0.5 + 2.0 / np.pi * (near + far))


def theodorsen(reduced_frequency: ArrayLike) -> NDArray[np.complex128]:
    """Theodorsen's function C(k) of k = omega b / U, C(0) = 1.

    T. Theodorsen, General theory of aerodynamic instability and the mechanism of flutter, NACA
    Report 496 (1935).

    Raises:
        ValueError: a reduced frequency that is negative or not finite.
    """
    k = _not_negative("theodorsen", "reduced_frequency", reduced_frequency)
    # the Hankel functions have a pole at 0, where the ratio tends to 1, and lose their phase
    # far out, where it tends to 1/2 - i / (8 k): held from 1e7 on, within 2e-8
    inside = np.clip(k, 1e-20, 1e7)
    h0, h1 = hankel2(0, inside), hankel2(1, inside)
    return np.asarray(np.where(k > 1e-20, h1 / (h1 + 1j * h0), 1.0), dtype=np.complex128)


def added_mass_per_span(density: float, chord: ArrayLike) -> Array:
    """Added mass of a flat plate moving along its normal, pi rho c^2 / 4 in [kg/m].

    H. Lamb, Hydrodynamics, 6th ed. (1932), section 71. Density in [kg/m3], chord in [m].
    """
    return np.asarray(np.pi / 4.0 * density * np.square(chord))


def added_inertia_per_span(density: float, chord: ArrayLike) -> Array:
    """Added inertia of a flat plate turning about mid-chord, pi rho c^4 / 128 in [kg m].

    H. Lamb, Hydrodynamics, 6th ed. (1932), section 71. Density in [kg/m3], chord in [m].
    """
    return np.asarray(np.pi / 128.0 * density * np.power(chord, 4.0))


def flat_plate_suction_per_span(
    density: float, chord: ArrayLike, speed: ArrayLike, angle: ArrayLike
) -> Array:
    """Leading-edge suction of a flat plate in steady flow, pi rho c U^2 sin^2 alpha in [N/m].

    J. Katz & A. Plotkin, Low-Speed Aerodynamics, 2nd ed. (2001), section 5.4. Density in
    [kg/m3], chord in [m], speed in [m/s], angle of attack in [rad].
    """
    normal_speed = np.multiply(speed, np.sin(angle))
    return np.asarray(np.pi * density * np.multiply(chord, np.square(normal_speed)))


def side_suction_per_chord(density: float, width: ArrayLike, normal_speed: ArrayLike) -> Array:
    """Suction around one side of a plate that moves along its normal, per length of that side.

    pi/4 rho w^2 b in [N/m]: the edge's share of cross flow past a plate of width b, which is all
    there is on a slender wing; J. E. Lamar, NASA TR R-428 (1974), makes it the side edge's vortex
    lift. Density in [kg/m3], width in [m], speed in [m/s].
    """
    return np.asarray(np.pi / 4.0 * density * np.multiply(width, np.square(normal_speed)))


def helmbold_lift_slope(aspect_ratio: ArrayLike) -> Array:
    """Lift slope per radian of a wing of elliptic loading and 2 pi section slope.

    H. B. Helmbold, Der unverwundene Ellipsenfluegel als tragende Flaeche, Jahrbuch 1942 der
    Deutschen Luftfahrtforschung. An upper guide for other planforms.

    Raises:
        ValueError: an aspect ratio that is negative or not finite.
    """
    aspect = _not_negative("helmbold_lift_slope", "aspect_ratio", aspect_ratio)
    return np.asarray(2.0 * np.pi * aspect / (2.0 + np.sqrt(aspect**2 + 4.0)))


def oscillating_aerofoil(
    density: float,
    chord: float,
    speed: float,
    angular_frequency: float,
    heave: complex,
    pitch: complex,
    pitch_axis: float = 0.25,
) -> tuple[complex, complex]:
    """Lift and moment per span of a thin aerofoil in harmonic heave and pitch.

    Theodorsen (1935), equations XVIII and XX without the flap; each quantity is the real part of
    its amplitude times exp(i omega t).

    Args:
        density: rho in [kg/m3].
        chord: c in [m].
        speed: U in [m/s], positive.
        angular_frequency: omega in [rad/s], zero or positive.
        heave: amplitude of the pitch axis' motion in [m], positive DOWN as Theodorsen has it.
        pitch: amplitude of the nose-up pitch in [rad].
        pitch_axis: leading edge to axis, in chords.

    Returns:
        Amplitudes of the lift in [N/m], positive up, and of the nose-up moment about the pitch
        axis in [N].

    Raises:
        ValueError: a bad density, chord, speed or frequency.
    """
    owner = "oscillating_aerofoil"
    rho = check.positive(owner, "density", density, "kg/m3")
    b = 0.5 * check.positive(owner, "chord", chord, "m")
    u = check.positive(owner, "speed", speed, "m/s")
    w = check.in_range(owner, "angular_frequency", angular_frequency, 0.0, check.MOST, "rad/s")
    # axis behind mid-chord in semichords; derivatives are products with i omega
    a, d = 2.0 * pitch_axis - 1.0, 1j * w
    heave_2, pitch_1, pitch_2 = d * d * heave, d * pitch, d * d * pitch
    # downwash at three quarters of the chord drives the circulation
    downwash = u * pitch + d * heave + b * (0.5 - a) * pitch_1
    circulatory = 2.0 * np.pi * rho * u * b * complex(theodorsen(w * b / u)) * downwash
    apparent = np.pi * rho * b**2
    lift = apparent * (heave_2 + u * pitch_1 - b * a * pitch_2) + circulatory
    turning = a * heave_2 - u * (0.5 - a) * pitch_1 - b * (0.125 + a**2) * pitch_2
    return lift, b * (apparent * turning + (a + 0.5) * circulatory)


def _not_negative(owner: str, name: str, values: ArrayLike) -> Array:
    array = np.asarray(values, dtype=np.float64)
    if not np.all((array >= 0.0) & np.isfinite(array)):
        raise check.fail(owner, name, "finite and not negative", values)
    return array
