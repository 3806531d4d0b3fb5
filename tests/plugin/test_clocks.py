"""The plugin's clocks: its own, and the whole of its calls holds its parts."""

import math

from flaprig import UVLM, Rig, SunTangStroke, Twin
from flaprig.native import _native, plugin_clocks


def test_clocks_of_the_plugin_are_its_own():
    twin = Twin(Rig.load().with_(model=UVLM(3, 4, 40)))
    _native.reset_clocks()
    plugin_clocks.reset_clocks()
    assert not any(plugin_clocks.clocks().values())
    twin.run(SunTangStroke(0.2, math.pi / 3, math.pi / 4), cycles=1)
    found = plugin_clocks.clocks()
    whole = found.pop("plugin")
    assert all(seconds > 0.0 for seconds in found.values())
    assert sum(found.values()) < whole < 60.0
    # the module's air did nothing
    assert not any(_native.clocks().values())
