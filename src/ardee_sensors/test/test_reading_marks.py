# SPDX-License-Identifier: MIT
"""Tests markers of show_sensor.launch for readings without a display in rviz."""
import math

import pytest
from device_numbers import devices, expected_topics, load
from geometry_msgs.msg import Vector3
from reading_marks import (
    FORCE_SCALE_M,
    MOST_DOTS,
    FixMarks,
    imu_marks,
    local_m,
    magnetic_marks,
    marks_for,
)
from sensor_msgs.msg import Imu, MagneticField, NavSatFix
from visualization_msgs.msg import Marker


def fix_at(east_m: float, north_m: float, up_m: float = 0.0) -> NavSatFix:
    """Returns a fix at a distance from the reference; degrees by hector's flat projection."""
    numbers = load("gps")
    latitude_rad = math.radians(numbers["reference_latitude_deg"])
    e2 = 0.00669437999014  # WGS-84
    root = math.sqrt(1 - e2 * math.sin(latitude_rad) ** 2)
    return NavSatFix(
        latitude=numbers["reference_latitude_deg"]
        + math.degrees(north_m / (6378137 * (1 - e2) / root**3)),
        longitude=numbers["reference_longitude_deg"]
        + math.degrees(east_m / (6378137 / root * math.cos(latitude_rad))),
        altitude=numbers["reference_altitude_m"] + up_m,
    )


def test_a_fix_is_drawn_where_it_says():
    place = local_m(fix_at(3, -4, 0.5), load("gps"))
    assert (place.x, place.y, place.z) == pytest.approx((3, -4, 0.5), abs=1e-6)


def test_fixes_leave_a_trail_and_a_lost_one_none():
    draw = FixMarks(load("gps"))
    for count in range(1, MOST_DOTS + 20):
        _, dots = draw(fix_at(count, 0))
        assert len(dots.points) == min(count, MOST_DOTS)
    lost = fix_at(0, 0)
    lost.status.status = -1
    (text,) = draw(lost)
    assert text.text == "no fix"


def test_an_imu_at_rest_has_an_arrow_upwards():
    imu = Imu(linear_acceleration=Vector3(0, 0, 9.8))
    imu.header.frame_id = "sensor_link"
    text, force, rate = imu_marks(imu)
    assert text.type == Marker.TEXT_VIEW_FACING and "9.800 m/s2" in text.text
    assert force.header.frame_id == "sensor_link"
    assert force.points[1].z == pytest.approx(9.8 * FORCE_SCALE_M)
    assert rate.points[1].z == 0


def test_a_field_has_an_arrow_along_it():
    field = MagneticField(magnetic_field=Vector3(2e-5, 0, -4e-5))
    field.header.frame_id = "sensor_link"
    text, arrow = magnetic_marks(field)
    assert "20.00  0.00  -40.00 microtesla" in text.text
    end = arrow.points[1]
    assert (end.x, end.y, end.z) == pytest.approx((0.08, 0, -0.16))


@pytest.mark.parametrize("device", devices())
def test_what_rviz_does_not_show_itself_is_drawn(device: str):
    """Devices without an rviz configuration of their own or of their kind are drawn."""
    kind = next(iter(expected_topics(device, "sensor").values()))[0]
    if load(device)["kind"] in ("gps", "imu", "magnetometer", "other"):
        assert marks_for(kind, load("gps"))
    else:
        with pytest.raises(KeyError):
            marks_for(kind, load("gps"))
