"""Drives Ptera Software, another unsteady vortex lattice code, with our wings and motions.

C. Urban, Ptera Software (doi:10.5281/zenodo.19229119), and Validating an open-source UVLM solver
for analyzing flapping wing flight, Washington University in St. Louis (2020). It is imported only
when asked for. Its geometry axes (G) are x aft, y along the span, z up in level flight; in hover we
let x_G point down, so that the sweep about our vertical is the first of its three rotations.
"""

from __future__ import annotations

import logging
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from importlib.metadata import version
from typing import Any

import numpy as np
from numpy.typing import NDArray

from flaprig.aero.air import WingLoads
from flaprig.aero.rigid_motion import RigidMotion
from flaprig.fluid import Fluid
from flaprig.strokes import SunTangStroke
from flaprig.validation.flight import FLUID
from flaprig.wing import Wing

Array = NDArray[np.float64]

PACKAGE = "pterasoftware"
# it refuses still air [m/s]
STILL = 1e-6
# panels along chord and span
Mesh = tuple[int, int]


def installed() -> bool:
    """Whether the peer can be imported."""
    try:
        with _quiet():
            _peer()
    except ImportError:
        return False
    return True


def _peer() -> Any:
    """The package, late: only the extra «bench» installs it."""
    return import_module(PACKAGE)


def source() -> str:
    """The peer's name with its version."""
    return f"Ptera Software {version(PACKAGE)}"


def fly(
    wing: Wing,
    mesh: Mesh,
    step: float,
    count: int,
    angle_deg: float = 0.0,
    heave: tuple[float, float] = (0.0, 0.0),
    coreless: bool = False,
) -> Array:
    """Lift [N] of a rectangle in flight at 1 m/s through FLUID, after a sudden start.

    Its wake lies straight behind the wing, as is its default.

    Args:
        wing: a rectangle.
        mesh: panels along chord and span.
        step: of time in [s].
        count: number of steps.
        angle_deg: angle of attack.
        heave: amplitude [m] and period [s] of a sine, upwards first.
        coreless: whether the wing is spared the vortices' core.
    """
    amplitude, period = heave
    motion = {"ampLer_Gs_Cgs": (0, 0, amplitude), "periodLer_Gs_Cgs": (0, 0, period)}
    with _quiet():
        problem = _problem(wing, mesh, FLUID, (1.0, angle_deg), (step, count), motion)
        _solve(problem, coreless, free_wake=False)
    return np.array([-s.airplanes[0].forces_W[2] for s in problem.steady_problems])


def hover(
    wing: Wing,
    mesh: Mesh,
    fluid: Fluid,
    stroke: SunTangStroke,
    steps_per_cycle: int,
    rigid: RigidMotion,
    coreless: bool = False,
) -> tuple[WingLoads, float]:
    """A rectangle along a sinusoidal stroke in still fluid, with a free wake.

    Args:
        wing: a rectangle.
        mesh: panels along chord and span.
        fluid: the fluid.
        stroke: sinusoidal: both reversals half a cycle long.
        steps_per_cycle: steps in a cycle.
        rigid: the same motion as we have it, for the wing's axes.
        coreless: whether the wing is spared the vortices' core.

    Returns:
        Its force as loads in wing axes, without torques; and the largest distance between a corner
        of its panels and where the motion has it, in mean chords.
    """
    step = stroke.period / steps_per_cycle
    with _quiet():
        times = (step, len(rigid))
        problem = _problem(wing, mesh, fluid, (STILL, 0.0), times, _flapping(wing, stroke))
        _solve(problem, coreless, free_wake=True)
    planes = [s.airplanes[0] for s in problem.steady_problems]
    # its wind axes are then -x_G, y_G and -z_G: up, our x, our y
    force_w = np.array([plane.forces_W for plane in planes])[:, [1, 2, 0]]
    base = np.zeros((len(rigid), 6))
    base[:, :3] = np.einsum("nij,ni->nj", rigid.rotation, force_w)
    loads = WingLoads(base, np.zeros_like(base), np.zeros_like(base))
    theirs_G = np.array([_corners(plane.wings[0].panels) for plane in planes])
    theirs_w = np.stack([theirs_G[..., 1], -theirs_G[..., 2], -theirs_G[..., 0]], axis=-1)
    apart = np.linalg.norm(theirs_w - _places(wing, mesh, rigid), axis=-1)
    return loads, float(apart.max()) / wing.mean_chord


def _flapping(wing: Wing, stroke: SunTangStroke) -> dict[str, Any]:
    """The stroke as its sines: about x_G, our down, and then about the span, both against our
    angles. Our sweep is -cos, so its is cos; our pitch is sin, so its is -sin."""
    amplitude = np.degrees([stroke.sweep_amplitude, stroke.pitch_amplitude, 0.0])
    return {
        "ampAngles_Gs_to_Wn_ixyz": amplitude,
        "periodAngles_Gs_to_Wn_ixyz": np.where(amplitude > 0.0, stroke.period, 0.0),
        "phaseAngles_Gs_to_Wn_ixyz": np.where(amplitude > 0.0, (90.0, 180.0, 0.0), 0.0),
        # turns about the point where the pitch axis meets the sweep axis
        "rotationPointOffset_Gs_Ler": (-wing.leading_edge[0], -wing.root_offset, 0.0),
    }


def _corners(panels: Any) -> Any:
    """First and third corner of each panel in its axes."""
    return [[(p.Flpp_GP1_CgP1, p.Brpp_GP1_CgP1) for p in row] for row in panels]


def _places(wing: Wing, mesh: Mesh, rigid: RigidMotion) -> Array:
    """The same corners in world axes [m], from our motion."""
    along, out = (np.linspace(0.0, 1.0, n + 1) for n in mesh)
    x = wing.leading_edge[0] + wing.mean_chord * along
    y = wing.root_offset + wing.span * out
    grid = np.stack([*np.meshgrid(x, y, indexing="ij"), np.zeros((x.size, y.size))], axis=-1)
    corners = np.stack([grid[:-1, :-1], grid[1:, 1:]], axis=2)
    return np.einsum("nij,abcj->nabci", rigid.rotation, corners)


def _wing(wing: Wing, mesh: Mesh) -> Any:
    ps = _peer()
    section = ps.geometry.wing_cross_section.WingCrossSection
    # any symmetric section: the panels lie on its mean line
    plate = {"airfoil": ps.geometry.airfoil.Airfoil("naca0012"), "chord": wing.mean_chord}
    root = section(**plate, num_spanwise_panels=mesh[1], spanwise_spacing="uniform")
    tip = section(**plate, num_spanwise_panels=None, Lp_Wcsp_Lpp=(0.0, wing.span, 0.0))
    return ps.geometry.wing.Wing(
        [root, tip],
        Ler_Gs_Cgs=(wing.leading_edge[0], wing.root_offset, 0.0),
        num_chordwise_panels=mesh[0],
        chordwise_spacing="uniform",
    )


def _problem(
    wing: Wing,
    mesh: Mesh,
    fluid: Fluid,
    stream: tuple[float, float],
    times: tuple[float, int],
    motion: dict[str, Any],
) -> Any:
    """Everything there is at all instants; stream is speed [m/s] and angle of attack [degrees],
    times are step [s] and count."""
    ps = _peer()
    base, moves = _wing(wing, mesh), ps.movements
    plane = ps.geometry.airplane.Airplane(wings=[base])
    still = moves.wing_cross_section_movement.WingCrossSectionMovement
    sections = [still(base_wing_cross_section=s) for s in base.wing_cross_sections]
    moved = moves.wing_movement.WingMovement(base, sections, **motion)
    point = ps.operating_point.OperatingPoint(
        rho=fluid.density, nu=fluid.kinematic_viscosity, vCg__E=stream[0], alpha=stream[1]
    )
    movement = moves.movement.Movement(
        [moves.airplane_movement.AirplaneMovement(plane, [moved])],
        moves.operating_point_movement.OperatingPointMovement(point),
        delta_time=times[0],
        num_steps=times[1],
    )
    return ps.problems.UnsteadyProblem(movement)


def _solve(problem: Any, coreless: bool, free_wake: bool) -> None:
    plain = _peer().unsteady_ring_vortex_lattice_method.UnsteadyRingVortexLatticeMethodSolver
    solver = (_coreless(plain) if coreless else plain)(problem)
    solver.run(prescribed_wake=not free_wake, calculate_streamlines=False, show_progress=False)


def _coreless(plain: Any) -> Any:
    """Its solver with the initial core, 3 % of the chord, left out where bound and wake rings act
    on the wing's own collocation points; both, since they cancel at the trailing edge. The wake's
    growth with age, the roll-up and the loads keep theirs."""

    def without(name: str, method: str) -> Any:
        def spared(solver: Any) -> None:
            kept = getattr(solver, name)
            setattr(solver, name, np.zeros_like(kept))
            getattr(plain, method)(solver)
            setattr(solver, name, kept)

        return spared

    changes = {
        method: without(name, method)
        for name, method in (
            ("_currentStackBoundRc0s", "_calculate_wing_wing_influences"),
            ("_currentStackWakeRc0s", "_calculate_wake_wing_influences"),
        )
    }
    return type("Coreless", (plain,), {"__slots__": ()} | changes)


@contextmanager
def _quiet() -> Iterator[None]:
    """Keeps the peer's log and its warnings to itself."""
    log = logging.getLogger(PACKAGE)
    level = log.level
    log.setLevel(logging.CRITICAL + 1)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            yield
    finally:
        log.setLevel(level)
