# SPDX-License-Identifier: MIT
"""States of a simulation and its models, and velocities that are commanded."""

import math
from dataclasses import dataclass
from typing import Optional, Tuple

import numpy as np


@dataclass(frozen=True)
class Twist:
    """A velocity: m/s and rad/s, forwards, left, up and about these axes (REP 103)."""

    linear_x_m_s: float = 0.0
    linear_y_m_s: float = 0.0
    linear_z_m_s: float = 0.0
    angular_x_rad_s: float = 0.0
    angular_y_rad_s: float = 0.0
    angular_z_rad_s: float = 0.0


@dataclass(frozen=True)
class Entity:
    """A model of the world: names of its joints and links, topics of its devices."""

    name: str
    joints: Tuple[str, ...]
    links: Tuple[str, ...]
    topics: Tuple[str, ...]
    is_static: bool


@dataclass(frozen=True)
class TopicInfo:
    """A topic or service of the devices.

    kind : a class of readings, or a kind of command
    role : reading, command or service
    rate_hz : readings per simulated second, of all the topic's devices; None: no readings, or not periodic (a trigger)
    frame_id : of all readings; empty if they have none or several

    Those of a robot's ros_control controllers are there once these are started.
    """

    kind: str
    role: str
    rate_hz: Optional[float]
    frame_id: str


@dataclass(frozen=True, eq=False)
class State:
    """Pose and velocity, float64: position [3], quaternion [4], velocity [3], angular velocity [3]."""

    xyz_m: np.ndarray
    quat_xyzw: np.ndarray
    v_m_s: np.ndarray
    w_rad_s: np.ndarray

    @property
    def yaw_rad(self) -> float:
        """Angle about z of the x axis."""
        x, y, z, w = self.quat_xyzw
        return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


@dataclass(frozen=True, eq=False)
class Contact:
    """A point at which two collisions touched in the last step; vectors in the world's axes.

    Names are model::link::collision; the normal points from the second into the first, on which the force acts.
    """

    collision1: str
    collision2: str
    xyz_m: np.ndarray
    normal: np.ndarray
    depth_m: float
    force_n: np.ndarray


@dataclass(frozen=True)
class LogLine:
    """A message of the engine; level is debug, info, warning or error."""

    level: str
    text: str


@dataclass(frozen=True)
class Snapshot:
    """A moment of a simulation, as bytes: Simulation.restore() goes on from it, in another process too."""

    data: bytes
