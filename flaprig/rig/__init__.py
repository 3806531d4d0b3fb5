"""The rig as a MuJoCo model: its file, its numbers in Python, its names and its plate."""

from flaprig._paths import RIG_XML
from flaprig.rig.names import (
    AIR,
    START,
    Axis,
    Body,
    Camera,
    Controls,
    Geom,
    Sensor,
    Site,
    controls,
    coordinates,
    readings,
)
from flaprig.rig.numbers import RIG_FREQUENCY
from flaprig.rig.rig import Rig, weigh_stops

__all__ = [
    "AIR",
    "RIG_FREQUENCY",
    "RIG_XML",
    "START",
    "Axis",
    "Body",
    "Camera",
    "Controls",
    "Geom",
    "Rig",
    "Sensor",
    "Site",
    "controls",
    "coordinates",
    "readings",
    "weigh_stops",
]
