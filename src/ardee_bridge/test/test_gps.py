# SPDX-License-Identifier: MIT
"""What a receiver's messages become on the wire, with a fix and without."""
import math

from geometry_msgs.msg import Vector3
from sensor_msgs.msg import NavSatFix

from ardee_bridge import codec, convert
from ardee_bridge.layout import NO_VALUE


def test_gps():
    message = NavSatFix(latitude=40.1234567, longitude=-88.7654321, altitude=222.333)
    message.header.stamp.secs, message.header.stamp.nsecs = 12, 345_678_901
    message.status.status, message.status.service = 2, 0xFFFF
    message.position_covariance, message.position_covariance_type = [0.01] * 9, 2
    raw = codec.GPSData.unpack(convert.gps(message, Vector3(0.5, -0.25, 0.0)).data)
    si = raw.to_si()
    assert (si.latitude, si.longitude, si.altitude) == (40.1234567, -88.7654321, 222.333)
    assert (si.time, si.velocity.y, si.covariance.x) == (12.345, -0.25, 0.01)
    assert (raw.status, raw.service, raw.covariance_type) == (2, 0xFFFF, 2)


def test_a_gps_without_fix_has_no_position_and_no_velocity():
    message = NavSatFix(latitude=math.nan, longitude=math.nan, altitude=math.nan)
    message.status.status = -1
    raw = codec.GPSData.unpack(convert.gps(message, Vector3(0.5, 0.0, 0.0)).data)
    assert raw.status == -1
    assert {raw.latitude, raw.longitude, raw.altitude} == {NO_VALUE}
    assert {raw.velocity.x, raw.velocity.y, raw.velocity.z} == {NO_VALUE}


def test_a_gps_whose_velocity_is_not_known_has_a_position():
    message = NavSatFix(latitude=40.1)
    raw = codec.GPSData.unpack(convert.gps(message).data)
    assert raw.latitude == 401_000_000 and raw.velocity.x == NO_VALUE


def test_gps_time_wraps():
    message = NavSatFix()
    message.header.stamp.secs = 2**31 // 1000 + 1
    raw = codec.GPSData.unpack(convert.gps(message).data)
    assert raw.time == (2**31 // 1000 + 1) * 1000 - 2**31
