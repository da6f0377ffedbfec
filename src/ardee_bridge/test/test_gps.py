# SPDX-License-Identifier: MIT
"""Tests a GPS receiver's messages on the wire, with a fix and without."""
import math

from geometry_msgs.msg import Vector3, Vector3Stamped
from sensor_msgs.msg import NavSatFix

from ardee_bridge.nodes import convert
from ardee_bridge.nodes.fix_velocity import FixWithVelocity
from ardee_bridge.wire import codec
from ardee_bridge.wire.c_struct import NO_VALUE


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


class Receiver:
    """Publishes fixes and velocities [m/s] at times [s]; `sent` has the results: time and velocity."""

    def __init__(self):
        self.sent = []
        self._both = FixWithVelocity(self._keep)

    def _keep(self, message, velocity):
        self.sent.append((message.header.stamp.secs, velocity and velocity.x))

    def fix(self, time, status=0):
        message = NavSatFix()
        message.header.stamp.secs, message.status.status = time, status
        self._both.on_fix(message)

    def velocity(self, time, x):
        message = Vector3Stamped(vector=Vector3(x, 0.0, 0.0))
        message.header.stamp.secs = time
        self._both.on_velocity(message)


def test_a_fix_goes_with_the_velocity_of_its_time_that_comes_after_it_or_before():
    receiver = Receiver()
    receiver.fix(1)
    receiver.velocity(1, 0.1)
    assert receiver.sent == [(1, None)]  # no velocity was expected
    receiver.fix(2)
    receiver.velocity(2, 0.2)
    receiver.velocity(3, 0.3)
    receiver.fix(3)
    assert receiver.sent[1:] == [(2, 0.2), (3, 0.3)]


def test_a_velocity_of_other_times_is_not_waited_for():
    receiver = Receiver()
    for time in (10, 20, 30):
        receiver.fix(time)
        receiver.velocity(time + 1, time / 100)
    assert receiver.sent == [(10, None), (20, 0.1), (30, 0.2)]


def test_a_velocity_that_ceases_holds_up_one_fix_alone():
    receiver = Receiver()
    for time in (1, 2):
        receiver.fix(time)
        receiver.velocity(time, time / 10)
    receiver.fix(3)
    assert len(receiver.sent) == 2
    receiver.fix(4)
    receiver.fix(5)
    assert receiver.sent[2:] == [(3, 0.2), (4, 0.2), (5, 0.2)]


def test_without_a_fix_nothing_is_waited_for():
    receiver = Receiver()
    receiver.fix(1)
    receiver.velocity(1, 0.1)
    receiver.fix(2, status=-1)
    assert [time for time, _ in receiver.sent] == [1, 2]
