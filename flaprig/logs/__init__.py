"""A rig's records: read, cleaned, understood, and written as the servos count."""

from flaprig.logs.counts import XM430_RIG, JointCounts, PositionCounts
from flaprig.logs.log_file import RigLog, read_log

__all__ = ["JointCounts", "PositionCounts", "RigLog", "XM430_RIG", "read_log"]
