# SPDX-License-Identifier: MIT
"""The ARDEE simulator in Python: worlds, robots, sensors, steps; no ROS.

SI units, in the names; x forward, y left, z up (REP 103); quaternions x, y, z, w.
"""

from ardee_sim import _devel_space  # noqa: F401  before all others
from ardee_sim.daylight import Daylight
from ardee_sim.errors import ArdeeError, PhysicsError
from ardee_sim.readings import (
    BatteryReading,
    BatteryStateReading,
    CameraInfoReading,
    ContactsReading,
    EncoderReading,
    FixReading,
    FourWheelSteeringReading,
    GpsQualityReading,
    ImageReading,
    ImuReading,
    JointControllerReading,
    JointStateReading,
    LegacyCloudReading,
    LidarReading,
    MagneticFieldReading,
    OdometryReading,
    PointCloudReading,
    RangeReading,
    Reading,
    RegionsReading,
    TrajectoryControllerReading,
    TransformReading,
    TwistReading,
    VectorReading,
    WrenchReading,
)
from ardee_sim.robots import robot
from ardee_sim.simulation import Simulation
from ardee_sim.state import Contact, Entity, LogLine, Snapshot, State, TopicInfo, Twist
from ardee_sim.world import Placement, Plant, World

__all__ = [
    "ArdeeError",
    "BatteryReading",
    "BatteryStateReading",
    "CameraInfoReading",
    "Contact",
    "ContactsReading",
    "Daylight",
    "EncoderReading",
    "Entity",
    "FixReading",
    "FourWheelSteeringReading",
    "GpsQualityReading",
    "ImageReading",
    "ImuReading",
    "JointControllerReading",
    "JointStateReading",
    "LegacyCloudReading",
    "LidarReading",
    "LogLine",
    "MagneticFieldReading",
    "OdometryReading",
    "PhysicsError",
    "Placement",
    "Plant",
    "PointCloudReading",
    "RangeReading",
    "Reading",
    "RegionsReading",
    "Simulation",
    "Snapshot",
    "State",
    "TopicInfo",
    "TrajectoryControllerReading",
    "TransformReading",
    "Twist",
    "TwistReading",
    "VectorReading",
    "World",
    "WrenchReading",
    "robot",
]
