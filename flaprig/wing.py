"""A rigid flat wing: a planform of straight pieces, a thickness and a density.

Wing frame: x chordwise from leading to trailing edge, y spanwise from root to tip, z normal; the
origin lies on the pitch axis at the sweep axis. The planform is a table of stations along y,
joined by straight lines, so its integrals are exact. Beta planform and radii of area: C. P.
Ellington, The aerodynamics of hovering insect flight II, Phil. Trans. R. Soc. B 305 (1984).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from flaprig import _checks as check
from flaprig import planform

Array = NDArray[np.float64]

# distance of the pitch axis from the leading edge, in chords: quarter chord, not printed in the
# paper; the leading-edge and mid-chord axes move the mean lift by about 2 %
PITCH_AXIS = 0.25
# thickness of the acrylic plate [m]: not printed in the paper, 3 mm assumed
PLATE_THICKNESS = 0.003
# density of acrylic glass (PMMA) [kg/m3]: usual datasheet value
ACRYLIC_DENSITY = 1180.0
# smallest step between two stations, over the span
LEAST_STEP = 1e-9
# smallest chord between the ends, over the largest: only to keep the chord away from zero
LEAST_CHORD = 1e-24
# largest length accepted [m]
MOST_LENGTH = 1e4


@dataclass(frozen=True, repr=False)
class Wing:
    """A flat rigid wing whose planform is piecewise linear between stations.

    Stations are kept as tuples, so wings compare and hash by value; `stations` gives the array.

    Attributes:
        radius: distance of each station from the sweep axis in [m], increasing. Length k >= 2.
        chord: chord at each station in [m]; zero only at the first or last. Length k.
        leading_edge: x of the leading edge in the wing frame in [m]: minus the distance from
            leading edge to pitch axis, since the pitch axis is x = 0. Length k.
        thickness: thickness of the plate in [m].
        density: density of the plate in [kg/m3].

    Raises:
        ValueError: a field that is not finite, not positive, unsorted or of the wrong length.
    """

    radius: tuple[float, ...]
    chord: tuple[float, ...]
    leading_edge: tuple[float, ...]
    thickness: float = PLATE_THICKNESS
    density: float = ACRYLIC_DENSITY

    def __post_init__(self) -> None:
        radius = _checked_radius(self.radius)
        size, most = radius.size, MOST_LENGTH
        chord = check.array("Wing", "chord", self.chord, "m", length=size, most=most)
        edge = check.array("Wing", "leading_edge", self.leading_edge, "m", length=size, most=most)
        _refuse_bad_chord(chord)
        thickness = check.positive("Wing", "thickness", self.thickness, "m", most=most)
        density = check.positive("Wing", "density", self.density, "kg/m3")
        for name, values in (("radius", radius), ("chord", chord), ("leading_edge", edge)):
            object.__setattr__(self, name, tuple(values.tolist()))
        object.__setattr__(self, "thickness", thickness)
        object.__setattr__(self, "density", density)

    @classmethod
    def rectangular(
        cls,
        span: float,
        chord: float,
        root_offset: float = 0.0,
        pitch_axis: float = PITCH_AXIS,
        thickness: float = PLATE_THICKNESS,
        density: float = ACRYLIC_DENSITY,
    ) -> Wing:
        """A rectangle; lengths in [m], root_offset from sweep axis to root, pitch_axis in chords.

        Raises:
            ValueError: a length that is not positive, or a pitch axis outside 0 to 1.
        """
        owner = "Wing.rectangular"
        span = check.positive(owner, "span", span, "m", most=MOST_LENGTH)
        chord = check.positive(owner, "chord", chord, "m", most=MOST_LENGTH)
        root = check.in_range(owner, "root_offset", root_offset, 0.0, MOST_LENGTH, "m")
        axis = check.in_range(owner, "pitch_axis", pitch_axis, 0.0, 1.0, "chords")
        edges, chords = (-axis * chord,) * 2, (chord,) * 2
        return cls((root, root + span), chords, edges, thickness, density)

    @classmethod
    def beta(
        cls,
        span: float,
        mean_chord: float,
        r1: float,
        r2: float | None = None,
        root_offset: float = 0.0,
        pitch_axis: float = PITCH_AXIS,
        thickness: float = PLATE_THICKNESS,
        density: float = ACRYLIC_DENSITY,
    ) -> Wing:
        """Ellington's (1984) beta planform, its area, r1 and r2 reproduced to rounding.

        c / mean_chord = x^(p-1) (1-x)^(q-1) / B(p, q) with x from 0 at the root to 1 at the tip.

        Args:
            span: root to tip in [m].
            mean_chord: area over span in [m].
            r1: radius of the first moment of area from the root, over span.
            r2: radius of the second moment of area from the root, over span; when None,
                Ellington's correlation r2 = 0.929 r1^0.732.
            root_offset: sweep axis to root in [m].
            pitch_axis: leading edge to pitch axis, in local chords.
            thickness: of the plate in [m].
            density: of the plate in [kg/m3].

        Raises:
            ValueError: a bad length, or r1 and r2 that no beta planform of finite chord has.
        """
        owner = "Wing.beta"
        span = check.positive(owner, "span", span, "m", most=MOST_LENGTH)
        mean_chord = check.positive(owner, "mean_chord", mean_chord, "m", most=MOST_LENGTH)
        root = check.in_range(owner, "root_offset", root_offset, 0.0, MOST_LENGTH, "m")
        axis = check.in_range(owner, "pitch_axis", pitch_axis, 0.0, 1.0, "chords")
        x, chord = planform.beta(*planform.checked_radii(owner, r1, r2))
        return cls.from_table(root + span * x, mean_chord * chord, None, axis, thickness, density)

    @classmethod
    def from_table(
        cls,
        radius: ArrayLike,
        chord: ArrayLike,
        leading_edge: ArrayLike | None = None,
        pitch_axis: float | None = None,
        thickness: float = PLATE_THICKNESS,
        density: float = ACRYLIC_DENSITY,
    ) -> Wing:
        """Any planform from a table; straight lines join the stations.

        Args:
            radius: distances from the sweep axis in [m], increasing. Shape (k,).
            chord: chords in [m], zero only at an end. Shape (k,).
            leading_edge: x of the leading edge in the wing frame in [m], negative ahead of the
                pitch axis. Shape (k,). It fixes the pitch axis, so give one or the other.
            pitch_axis: leading edge to pitch axis in local chords, 0 to 1; 0.25 when neither
                is given.
            thickness: of the plate in [m].
            density: of the plate in [kg/m3].

        Raises:
            ValueError: a bad table, or both leading_edge and pitch_axis.
        """
        owner = "Wing.from_table"
        if leading_edge is not None and pitch_axis is not None:
            raise check.fail(owner, "pitch_axis", "left out when leading_edge is given", pitch_axis)
        chords = check.array(owner, "chord", chord, "m", most=MOST_LENGTH)
        if leading_edge is None:
            fraction = PITCH_AXIS if pitch_axis is None else pitch_axis
            leading_edge = -check.in_range(owner, "pitch_axis", fraction, 0.0, 1.0) * chords
        # the constructor checks and turns each of these into a tuple
        table = {"radius": radius, "chord": chords, "leading_edge": leading_edge}
        return cls(**table, thickness=thickness, density=density)  # type: ignore[arg-type]

    def __repr__(self) -> str:
        return (
            f"Wing(span={self.span:.6g} m, mean_chord={self.mean_chord:.6g} m, "
            f"root_offset={self.root_offset:.6g} m, {len(self.radius)} stations)"
        )

    @property
    def stations(self) -> Array:
        """Columns radius, chord, leading edge in [m]. Shape (k, 3), float64, C-contiguous."""
        return np.ascontiguousarray(np.transpose([self.radius, self.chord, self.leading_edge]))

    @property
    def is_rectangle(self) -> bool:
        """Whether chord and leading edge are the same at every station."""
        return len(set(self.chord)) == 1 and len(set(self.leading_edge)) == 1

    @property
    def span(self) -> float:
        """Root to tip in [m]."""
        return self.radius[-1] - self.radius[0]

    @property
    def root_offset(self) -> float:
        """Sweep axis to root in [m]."""
        return self.radius[0]

    @property
    def tip_radius(self) -> float:
        """R, sweep axis to tip in [m]."""
        return self.radius[-1]

    @property
    def area(self) -> float:
        """S, one side of the plate in [m2]."""
        return self._moment(0, 0)

    @property
    def mean_chord(self) -> float:
        """Area over span in [m]."""
        return self.area / self.span

    @property
    def aspect_ratio(self) -> float:
        """Span over mean chord."""
        return self.span / self.mean_chord

    @property
    def pitch_axis(self) -> float:
        """Leading edge to pitch axis over chord, both averaged over the span."""
        return -planform.integral(self.radius, self.leading_edge) / self.area

    @property
    def radius_of_second_moment(self) -> float:
        """R2, from the sweep axis and weighted by area, in [m] (0.6053 R on the rig)."""
        return float(np.sqrt(self._moment(0, 2) / self.area))

    @property
    def r1hat(self) -> float:
        """Radius of the first moment of area from the root, over span (Ellington 1984)."""
        return (self._moment(0, 1) / self.area - self.root_offset) / self.span

    @property
    def r2hat(self) -> float:
        """Radius of the second moment of area from the root, over span (Ellington 1984)."""
        from_root = np.asarray(self.radius) - self.root_offset
        return float(np.sqrt(planform.integral(from_root, self.chord, 2) / self.area)) / self.span

    @property
    def volume(self) -> float:
        """Area times thickness in [m3]."""
        return self.area * self.thickness

    @property
    def mass(self) -> float:
        """Mass of the plate in [kg]."""
        return self.volume * self.density

    @property
    def centroid(self) -> Array:
        """Centre of the plate in the wing frame in [m]. Shape (3,)."""
        return np.array([self._moment(1, 0), self._moment(0, 1), 0.0]) / self.area

    @property
    def inertia(self) -> Array:
        """Inertia of the plate about the origin of the wing frame in [kg m2]. Shape (3, 3)."""
        xx, yy, xy = self._moment(2, 0), self._moment(0, 2), self._moment(1, 1)
        zz = self.area * self.thickness**2 / 12.0
        tensor = np.array([[yy + zz, -xy, 0.0], [-xy, xx + zz, 0.0], [0.0, 0.0, xx + yy]])
        return self.density * self.thickness * tensor

    def _moment(self, x_power: int, y_power: int) -> float:
        """Integral of x^x_power y^y_power over the area, exact up to a total power of two."""
        return planform.moment(self.radius, self.chord, self.leading_edge, x_power, y_power)


def _checked_radius(values: ArrayLike) -> Array:
    radius = check.array("Wing", "radius", values, "m", 2, 10_000, most=MOST_LENGTH)
    if radius[0] < 0.0:
        raise check.fail("Wing", "radius[0]", "zero or positive, in m", float(radius[0]))
    least = LEAST_STEP * max(radius[-1] - radius[0], check.LEAST)
    if np.any(np.diff(radius) < least):
        raise check.fail("Wing", "radius", "in increasing order, in m", radius.tolist())
    return radius


def _refuse_bad_chord(chord: Array) -> None:
    largest = float(np.max(chord))
    if largest < check.LEAST:
        allowed = f"at least {check.LEAST:g} m at one station or more"
        raise check.fail("Wing", "chord", allowed, chord.tolist())
    thin = chord < LEAST_CHORD * largest
    # zero is for pointed ends only
    thin[[0, -1]] &= chord[[0, -1]] != 0.0
    if np.any(thin):
        index = int(np.argmax(thin))
        allowed = "positive in m (zero only at the root or tip)"
        raise check.fail("Wing", f"chord[{index}]", allowed, float(chord[index]))


# the rig's wing, paper section 2.2: acrylic rectangle of span 250 mm and aspect ratio 4, tip
# radius 275 mm; pitch axis, thickness and density as above
RIG_WING = Wing.rectangular(span=0.25, chord=0.0625, root_offset=0.025)
