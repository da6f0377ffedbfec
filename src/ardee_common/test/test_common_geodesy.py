# SPDX-License-Identifier: MIT
"""Tests degrees against the published lengths of a degree on WGS-84."""
import numpy as np
import pytest

from ardee_common.geodesy import to_degrees, to_metres


def test_degrees_against_the_length_of_a_degree():
    # WGS-84: one degree of latitude is 111,132.95 - 559.85 cos(2 phi) m, of longitude 111,412.88 cos(phi) - ...
    lat = to_degrees(np.array([0.0]), np.array([111.0]), (40.0, -88.0))[0, 0] - 40.0
    lon = to_degrees(np.array([85.0]), np.array([0.0]), (40.0, -88.0))[0, 1] + 88.0
    phi = np.radians(40.0)
    per_latitude = 111132.92 - 559.82 * np.cos(2 * phi) + 1.175 * np.cos(4 * phi)
    per_longitude = 111412.84 * np.cos(phi) - 93.5 * np.cos(3 * phi)
    assert lat == pytest.approx(111.0 / per_latitude, rel=1e-5)
    assert lon == pytest.approx(85.0 / per_longitude, rel=1e-5)


def test_metres_are_where_the_degrees_came_from() -> None:
    origin = (40.0, -88.0)
    ((latitude, longitude),) = to_degrees(np.array([300.0]), np.array([-400.0]), origin)
    assert to_metres(latitude, longitude, origin) == pytest.approx((300.0, -400.0), abs=1e-6)
