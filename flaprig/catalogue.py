"""Six real servos from 18 g to 165 g, for the question which one is big enough.

Numbers: ROBOTIS e-Manual, https://emanual.robotis.com/docs/en/dxl/, the page of each servo, at its
recommended voltage. What a datasheet does not print is taken as on the rig's XM430-W350 (motors.py
says why): continuous torque and heat capacity in proportion to stall torque and mass, the position
P gain of 1600 and twice the motor's own damping, the mechanical time constant of the family.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType

from flaprig.motors import XM430_W350, Motor

# revolutions per minute in [rad/s]
_RPM = 2.0 * math.pi / 60.0


def _servo(
    voltage: float,
    stall_torque: float,
    no_load_speed: float,
    mass: float,
    temperature_limit: float,
    rotor_inertia: float | None = None,
) -> Motor:
    """A servo of the rig's kind with another datasheet.

    Without a rotor inertia, J R/K^2 is that of the rig's servo, with K^2/R = stall torque over
    no-load speed. The P gain in volts per pulse is per full supply, whatever the voltage.
    """
    own = XM430_W350
    larger = stall_torque / own.stall_torque
    slope = stall_torque / no_load_speed
    time = own.rotor_inertia * own.no_load_speed / own.stall_torque
    return Motor(
        voltage=voltage,
        stall_torque=stall_torque,
        no_load_speed=no_load_speed,
        continuous_torque=larger * own.continuous_torque,
        temperature_limit=temperature_limit,
        ambient_temperature=own.ambient_temperature,
        heat_capacity=mass / own.mass * own.heat_capacity,
        rotor_inertia=time * slope if rotor_inertia is None else rotor_inertia,
        stiffness=larger * own.stiffness,
        damping=2.0 * slope,
        mass=mass,
    )


# x/xl330-m288: 5.0 V, 0.52 N m, 103 rev/min, 18 g, temperature limit 70 degC (control table 31).
# rotor inertia 1.990e-3 kg m2: identified by Duclusaud et al., arXiv 2410.08650, model m1 of
# Rhoban/bam
XL330_M288 = _servo(5.0, 0.52, 103.0 * _RPM, 0.018, 70.0, 1.990e-3)

# x/xl430-w250: 11.1 V, 1.4 N m, 57 rev/min, 57.2 g, temperature limit 72 degC (control table 31)
XL430_W250 = _servo(11.1, 1.4, 57.0 * _RPM, 0.0572, 72.0)

# x/xm430-w210: 12.0 V, 3.0 N m, 77 rev/min, 82 g, operating temperature up to 80 degC
XM430_W210 = _servo(12.0, 3.0, 77.0 * _RPM, 0.082, 80.0)

# mx/mx-106-2: 12 V, 8.4 N m, 45 rev/min, 153 g, operating temperature up to 80 degC.
# rotor inertia 26.61e-3 kg m2 identified as for the XL330
MX_106 = _servo(12.0, 8.4, 45.0 * _RPM, 0.153, 80.0, 26.61e-3)

# x/xm540-w270: 12.0 V, 10.6 N m, 30 rev/min, 165 g, operating temperature up to 80 degC
XM540_W270 = _servo(12.0, 10.6, 30.0 * _RPM, 0.165, 80.0)

# by name as ROBOTIS sells them, the smallest first: by mass, then by stall torque
CATALOGUE: Mapping[str, Motor] = MappingProxyType(
    {
        "XL330-M288": XL330_M288,
        "XL430-W250": XL430_W250,
        "XM430-W210": XM430_W210,
        "XM430-W350": XM430_W350,
        "MX-106": MX_106,
        "XM540-W270": XM540_W270,
    }
)
