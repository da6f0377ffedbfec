# SPDX-License-Identifier: MIT
"""Readings of sensors. Each is frozen; its arrays are read-only and outlive the simulation.

`stamp_ns` is the simulated time, `frame_id` the frame of the measurement. Positions are in m, quaternions x, y, z, w,
velocities in m/s and rad/s, covariances the diagonals. Messages of the same meaning are named in brackets.
"""

from dataclasses import dataclass
from typing import Any, Dict, Tuple

import numpy as np


@dataclass(frozen=True, eq=False)
class Reading:
    """A measurement with time and frame."""

    stamp_ns: int
    frame_id: str


@dataclass(frozen=True, eq=False)
class LidarReading(Reading):
    """One sweep of a planar lidar [LaserScan]. +inf: nothing met; -inf: nearer than the minimum (REP 117)."""

    angle_min_rad: float
    angle_max_rad: float
    angle_increment_rad: float
    time_increment_s: float
    scan_time_s: float
    range_min_m: float
    range_max_m: float
    ranges_m: np.ndarray  # float32[beams]
    intensities: np.ndarray  # float32[beams]


@dataclass(frozen=True, eq=False)
class OdometryReading(Reading):
    """Pose of the child frame in frame_id, velocity in the child frame [Odometry]."""

    child_frame_id: str
    xyz_m: np.ndarray
    quat_xyzw: np.ndarray
    v_m_s: np.ndarray
    w_rad_s: np.ndarray
    pose_covariance: np.ndarray  # x, y, z, roll, pitch, yaw
    twist_covariance: np.ndarray


@dataclass(frozen=True, eq=False)
class TransformReading(Reading):
    """Pose of the child frame in frame_id [TransformStamped]."""

    child_frame_id: str
    xyz_m: np.ndarray
    quat_xyzw: np.ndarray


@dataclass(frozen=True, eq=False)
class JointStateReading(Reading):
    """Positions in rad or m, velocities, efforts in N m or N, joint by joint [JointState]."""

    names: Tuple[str, ...]
    positions: np.ndarray
    velocities: np.ndarray
    efforts: np.ndarray


@dataclass(frozen=True, eq=False)
class ImuReading(Reading):
    """Orientation in east-north-up axes, angular velocity, specific force: +9.81 upwards at rest (REP 145) [Imu]."""

    quat_xyzw: np.ndarray
    w_rad_s: np.ndarray
    a_m_s2: np.ndarray
    orientation_covariance: np.ndarray
    w_covariance: np.ndarray
    a_covariance: np.ndarray


@dataclass(frozen=True, eq=False)
class FixReading(Reading):
    """Position from satellites, WGS-84; status and service as the message numbers them [NavSatFix]."""

    status: int
    service: int
    latitude_deg: float
    longitude_deg: float
    altitude_m: float
    covariance_m2: np.ndarray  # east, north, up


@dataclass(frozen=True, eq=False)
class VectorReading(Reading):
    """A vector, in the unit of its topic [Vector3Stamped]."""

    vector: np.ndarray


@dataclass(frozen=True, eq=False)
class MagneticFieldReading(Reading):
    """Magnetic field in tesla, in the sensor's axes [MagneticField]."""

    field_t: np.ndarray


@dataclass(frozen=True, eq=False)
class EncoderReading(Reading):
    """Angle of a wheel, speed of its rim, quadrature pulses a second."""

    id: int
    position_rad: float
    speed_m_s: float
    pulses_per_s: float


@dataclass(frozen=True, eq=False)
class BatteryReading(Reading):
    """Terminal voltage and its bounds."""

    voltage_v: float
    voltage_max_v: float
    voltage_min_v: float


@dataclass(frozen=True, eq=False)
class BatteryStateReading(Reading):
    """State of a battery [BatteryState]: a current below 0 discharges it; NaN where not modelled; percentage 0 to 1."""

    voltage_v: float
    current_a: float
    charge_a_h: float
    capacity_a_h: float
    design_capacity_a_h: float
    percentage: float
    location: str


@dataclass(frozen=True, eq=False)
class RangeReading(Reading):
    """One distance in a cone [Range]; radiation is ultrasound or infrared."""

    radiation: str
    field_of_view_rad: float
    range_min_m: float
    range_max_m: float
    range_m: float


@dataclass(frozen=True, eq=False)
class PointCloudReading(Reading):
    """Points with named fields such as x, y, z (float32, m), intensity, ring [PointCloud2], row after row."""

    height: int
    width: int
    points: np.ndarray  # structured [height * width]
    is_dense: bool


@dataclass(frozen=True, eq=False)
class LegacyCloudReading(Reading):
    """Points with one channel [PointCloud]."""

    points_m: np.ndarray  # float32[n, 3]
    channel_name: str
    channel: np.ndarray  # float32[n]


@dataclass(frozen=True, eq=False)
class ImageReading(Reading):
    """A picture [Image]; by its encoding uint8[h, w, 3], uint8, float32 (m), uint16 or int32[h, w]."""

    encoding: str
    pixels: np.ndarray


@dataclass(frozen=True, eq=False)
class CameraInfoReading(Reading):
    """Calibration of a camera [CameraInfo]; distortion is plumb_bob: k1, k2, t1, t2, k3."""

    height_px: int
    width_px: int
    distortion: np.ndarray
    camera_matrix: np.ndarray  # [3, 3]
    rectification: np.ndarray  # [3, 3]
    projection: np.ndarray  # [3, 4]


@dataclass(frozen=True, eq=False)
class GpsQualityReading(Reading):
    """Degradation of a satellite receiver: its region (empty: open sky) and its error, which no real one knows."""

    region: str
    position_std_m: float
    has_fix: bool
    error_m: np.ndarray  # east, north, up


@dataclass(frozen=True, eq=False)
class RegionsReading(Reading):
    """Boxes in which a satellite receiver is degraded: dicts with name, xyz_m, quat_xyzw, size_m, rgba."""

    regions: Tuple[Dict[str, Any], ...]


@dataclass(frozen=True, eq=False)
class TwistReading(Reading):
    """A velocity [TwistStamped]."""

    v_m_s: np.ndarray
    w_rad_s: np.ndarray


@dataclass(frozen=True, eq=False)
class JointControllerReading(Reading):
    """State of a controller of one joint [JointControllerState]."""

    set_point: float
    process_value: float
    process_value_dot: float
    error: float
    time_step_s: float
    command: float
    p: float
    i: float
    d: float
    i_clamp: float
    antiwindup: bool


@dataclass(frozen=True, eq=False)
class TrajectoryControllerReading(Reading):
    """Desired and actual state of joints, and the difference [JointTrajectoryControllerState].

    Each is a dict with positions, velocities, accelerations, efforts, time_from_start_s.
    """

    names: Tuple[str, ...]
    desired: Dict[str, Any]
    actual: Dict[str, Any]
    error: Dict[str, Any]


@dataclass(frozen=True, eq=False)
class FourWheelSteeringReading(Reading):
    """Motion of a four-wheel steered vehicle [FourWheelSteeringStamped]."""

    front_angle_rad: float
    rear_angle_rad: float
    front_rate_rad_s: float
    rear_rate_rad_s: float
    speed_m_s: float
    acceleration_m_s2: float
    jerk_m_s3: float


@dataclass(frozen=True, eq=False)
class ContactsReading(Reading):
    """Contacts of a sensor's collisions since its last reading [ContactsState].

    Each touch is a dict with time_ns, collision1, collision2 and points (dicts with the fields of Contact).
    """

    touches: Tuple[Dict[str, Any], ...]


@dataclass(frozen=True, eq=False)
class WrenchReading(Reading):
    """Force in N and torque in N m about the origin of frame_id [WrenchStamped]."""

    force_n: np.ndarray
    torque_n_m: np.ndarray


def make_reading(made: Tuple[str, Dict[str, Any]]) -> Reading:
    """Returns the reading that the engine gave as the name of its class and its fields."""
    name, fields = made
    return globals()[name](**fields)
