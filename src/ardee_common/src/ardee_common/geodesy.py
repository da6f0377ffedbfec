# SPDX-License-Identifier: MIT
"""Local metres to latitude and longitude and back, by the radii of curvature of WGS-84.

This is the flat projection of the simulator's GPS, with which truth agrees; 1 km off it is within about 0.3 m.
"""

from typing import Tuple

import numpy as np

# NIMA TR8350.2, third edition
_WGS84_A_M = 6378137.0
_WGS84_F = 1.0 / 298.257223563


def _metres_per_degree(latitude_deg: float) -> Tuple[float, float]:
    """Returns the lengths of a degree to the north and to the east."""
    e2 = 2.0 * _WGS84_F - _WGS84_F**2
    latitude = np.radians(latitude_deg)
    squared = 1.0 - e2 * np.sin(latitude) ** 2
    normal = _WGS84_A_M / np.sqrt(squared)
    return np.radians(normal * (1.0 - e2) / squared), np.radians(normal * np.cos(latitude))


def to_degrees(
    east_m: np.ndarray, north_m: np.ndarray, origin_deg: Tuple[float, float]
) -> np.ndarray:
    """Returns (n, 2) latitudes and longitudes."""
    north, east = _metres_per_degree(origin_deg[0])
    latitude = origin_deg[0] + np.asarray(north_m) / north
    longitude = origin_deg[1] + np.asarray(east_m) / east
    return np.column_stack((latitude, longitude))


def to_metres(
    latitude_deg: float, longitude_deg: float, origin_deg: Tuple[float, float]
) -> Tuple[float, float]:
    """Returns the metres east and north of the origin."""
    north, east = _metres_per_degree(origin_deg[0])
    return (longitude_deg - origin_deg[1]) * east, (latitude_deg - origin_deg[0]) * north
