"""A rig's records: read, cleaned, understood, and written as the servos count."""

from flaprig.logs.counts import XM430_RIG, JointCounts, PositionCounts
from flaprig.logs.loading import load
from flaprig.logs.rig_log import RigLog, read_log

__all__ = ["JointCounts", "PositionCounts", "RigLog", "XM430_RIG", "load", "read_log"]
