# SPDX-License-Identifier: MIT
"""Tests the conversion of small sensors' ROS messages to data of the wire."""
import math

import numpy as np
import pytest
from sensor_msgs.msg import Imu, LaserScan

from ardee_bridge.nodes import convert
from ardee_bridge.wire import codec
from ardee_bridge.wire.c_struct import NO_VALUE
from ardee_msgs.msg import Battery, Encoder


def test_imu():
    message = Imu()
    message.linear_acceleration.z, message.angular_velocity.y = 9.81, -0.5
    message.orientation.w, message.orientation_covariance = 1.0, [-1.0] + [0.0] * 8
    message.angular_velocity_covariance = [1e-6, 0, 0, 0, 2e-6, 0, 0, 0, 3e-6]
    si = codec.IMUData.unpack(convert.imu(message).data).to_si()
    assert (si.accel.z, si.gyro.y, si.orientation.w) == (9.81, -0.5, 1.0)
    assert (si.gyro.covariance.x, si.gyro.covariance.z) == (1e-6, 3e-6)
    assert si.orientation.covariance.roll == -1.0


def test_lidar_as_the_codec_has_it():
    inf, nan = math.inf, math.nan
    ranges = [0.06, 0.0599, 10.0, 10.001, inf, -inf, nan, -1.0, 0.1235, 5.0005, 0.0]
    scan = LaserScan(range_min=0.06, range_max=10.0, angle_min=-2.356, angle_increment=0.0043633)
    scan.ranges, scan.intensities = ranges, [1.5, nan, 1e9, -inf] + [0.0] * 7
    reading = convert.lidar(scan)
    raw = codec.LidarData.unpack(reading.data)
    assert reading.count == 11
    assert list(raw.ranges[:11]) == codec.range_counts(ranges, 0.06, 10.0)
    assert raw.ranges[11:] == (0,) * (codec.LIDAR_SLOTS - 11)
    assert raw.intensities[:4] == (1500, NO_VALUE, 2**31 - 1, -(2**31 - 1))
    assert raw.to_si().dAngle == 0.0043633


def test_random_scans_as_the_codec_has_them():
    rng = np.random.default_rng(5)
    for _ in range(20):
        scan = LaserScan(range_min=0.1, range_max=float(rng.choice([5.0, 1e9, math.inf])))
        scan.ranges = rng.exponential(3.0, 1081).tolist()
        raw = codec.LidarData.unpack(convert.lidar(scan).data)
        assert list(raw.ranges) == codec.range_counts(scan.ranges, 0.1, scan.range_max)


def test_a_scan_of_too_many_beams_is_refused():
    with pytest.raises(convert.ConvertError, match="1082 beams, expected at most 1081"):
        convert.lidar(LaserScan(ranges=[1.0] * 1082))


def test_encoder_and_battery():
    raw = codec.EncoderData.unpack(
        convert.encoder(Encoder(id=3, position=1234.5, qpps=-6725.25)).data
    )
    assert raw.id == 3 and raw.to_si().position == 1234.5 and raw.to_si().qpps == -6725.25
    assert codec.BatteryData.unpack(convert.battery(Battery(vmax=12.6)).data).vmax == 12600
