#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""The same on a target computer: scans and commands are UDP datagrams, and nothing here knows ROS."""
import socket
import time

from keep_middle import command

from ardee_bridge.wire import codec
from ardee_bridge.wire.pairing import Pairer

CONTROLS = ("127.0.0.1", 35555)
pairer, is_driving = Pairer(), False

with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as opened:
    opened.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4 << 20)
    opened.bind(("127.0.0.1", 30000))  # where the sensor server sends to
    print("listening", flush=True)
    while True:
        datagram, sender = opened.recvfrom(65535)
        message = pairer.feed(sender, datagram, time.monotonic())
        if message is None or codec.data_struct(message.header) is not codec.LidarData:
            continue
        scan = codec.LidarData.unpack(message.data)
        ranges_m, numbers = codec.ranges_m(message.header, scan), scan.to_si()
        speed_m_s, turn_rad_s = command(ranges_m, numbers.angle_min, numbers.dAngle)
        for part in codec.encode_motion_si(speed_m_s, turn_rad_s):
            opened.sendto(part, CONTROLS)
        if is_driving and speed_m_s == 0.0:
            break
        is_driving = is_driving or speed_m_s > 0.0
print("no row in sight: stopped", flush=True)
