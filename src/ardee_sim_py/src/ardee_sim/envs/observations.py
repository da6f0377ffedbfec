# SPDX-License-Identifier: MIT
"""Readings as finite arrays: what an observation holds of each sensor, and its space."""

import math
from typing import Any, Dict

import numpy as np
from ardee_sim.errors import ArdeeError
from ardee_sim.readings import ImageReading, ImuReading, LidarReading, Reading
from gymnasium import spaces

RATE_RAD_S = 10.0  # angular velocities are cut off here
DEPTH_M = 10.0  # depths are cut off here


def as_array(reading: Reading) -> np.ndarray:
    """Returns the part of an observation that a reading is.

    A scan: ranges / greatest range, 1 where nothing was met, 0 where something was too near. An image: its pixels,
    depths as scaled_depths(). An IMU: sine and cosine of the yaw, angular velocities / RATE_RAD_S.
    """
    if isinstance(reading, LidarReading):
        ranges = reading.ranges_m / np.float32(reading.range_max_m)
        return np.clip(np.nan_to_num(ranges, nan=1.0, posinf=1.0, neginf=0.0), 0.0, 1.0)
    if isinstance(reading, ImageReading):
        is_depth = reading.pixels.dtype == np.float32
        return scaled_depths(reading.pixels) if is_depth else reading.pixels
    if isinstance(reading, ImuReading):
        x, y, z, w = reading.quat_xyzw
        yaw = math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
        rates = np.clip(reading.w_rad_s / RATE_RAD_S, -1.0, 1.0)
        return np.array([math.sin(yaw), math.cos(yaw), *rates], dtype=np.float32)
    raise ArdeeError(f"topics: found a {type(reading).__name__}, expected scan, image or IMU")


def scaled_depths(depths_m: np.ndarray) -> np.ndarray:
    """Returns depths / DEPTH_M, 1 where nothing is nearer or was measured."""
    return np.clip(np.nan_to_num(depths_m / np.float32(DEPTH_M), nan=1.0), 0.0, 1.0)


def space_of(array: np.ndarray, reading_has_sign: bool = False) -> spaces.Box:
    """Returns the space of a part: whole numbers have their type's range, others 0 or -1 to 1."""
    if array.dtype.kind in "iu":
        limits = np.iinfo(array.dtype)
        return spaces.Box(limits.min, limits.max, array.shape, array.dtype.type)
    return spaces.Box(-1.0 if reading_has_sign else 0.0, 1.0, array.shape, np.float32)


def observation(readings: Dict[str, Reading]) -> Any:
    """Returns the array of a single topic, or a dict by the topics' base names."""
    parts = {topic.rsplit("/", 1)[-1]: as_array(reading) for topic, reading in readings.items()}
    if len(parts) != len(readings):
        raise ArdeeError(f"topics: found {', '.join(readings)}, expected different last parts")
    only, *others = parts.values()
    return parts if others else only


def observation_space(readings: Dict[str, Reading]) -> spaces.Space:
    """Returns the space of observation()."""
    if not readings:
        raise ArdeeError("topics: found none, expected one or more names")
    made: Dict[str, spaces.Space] = {
        topic.rsplit("/", 1)[-1]: space_of(as_array(reading), isinstance(reading, ImuReading))
        for topic, reading in readings.items()
    }
    return spaces.Dict(made) if len(made) > 1 else next(iter(made.values()))
