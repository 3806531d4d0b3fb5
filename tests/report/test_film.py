"""The rig on its flight, and pictures of it with its wake."""

from __future__ import annotations

import numpy as np
import pytest

from flaprig import UVLM, SunTangStroke
from flaprig.render import gl
from flaprig.report.film import close_view
from flaprig.report.flight import Flight
from flaprig.report.painter import Painter
from flaprig.rig import Rig, coordinates
from flaprig.twin import Twin

STROKE = SunTangStroke(0.2, np.pi / 3, np.pi / 4)


def test_flight_follows_the_stroke_as_the_twin() -> None:
    """The same commands as Twin.run: the same angles after the same time, to rounding."""
    twin = Twin(Rig.load().with_(model=UVLM(2, 3, 16)), time_step=0.01)
    run = twin.run(STROKE, cycles=1)
    flight = Flight(twin, STROKE)
    assert run.time_step == flight.model.opt.timestep
    sweep, pitch = coordinates(flight.model)[0]
    for k in (100, 300):
        data = next(flight.at(np.array([run.motors.time[k]])))
        assert data.qpos[sweep] == pytest.approx(run.motors.sweep[k], abs=1e-9)
        assert data.qpos[pitch] == pytest.approx(run.motors.pitch[k], abs=1e-9)


def test_rig_is_painted_with_its_wake() -> None:
    backend = gl.backend()
    if backend is None:
        pytest.skip("no OpenGL library works here: " + gl.ADVICE)
    flight = Flight(Twin(Rig.load().with_(model=UVLM(2, 6, 30)), time_step=0.01), STROKE)
    with Painter(flight.model, backend, 320, 192) as painter:
        first = painter.paint(flight.data, close_view())
        bare = painter.scene.ngeom
        later = painter.paint(next(flight.at(np.array([3.0]))), close_view())
        assert painter.scene.ngeom > bare + 100
    assert first.shape == (192, 320, 3) and first.std() > 10
    assert np.abs(later.astype(int) - first).mean() > 1
