# SPDX-License-Identifier: MIT
"""Answers scans by a constant command, for a number of scans: udp_program.py BIND CONTROLS SPEED_M_S SCANS."""
import socket
import sys
import time

from ardee_bridge.wire import codec
from ardee_bridge.wire.pairing import Pairer

bind, controls, speed, count = sys.argv[1:]


def address(text: str) -> tuple:
    host, port = text.split(":")
    return host, int(port)


pairer, left = Pairer(), int(count)
with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as opened:
    opened.bind(address(bind))
    while left:
        datagram, sender = opened.recvfrom(65535)
        message = pairer.feed(sender, datagram, time.monotonic())
        if message and codec.data_struct(message.header) is codec.LidarData:
            assert len(codec.ranges_m(message.header, codec.LidarData.unpack(message.data))) == 1081
            for part in codec.encode_motion_si(float(speed), 0.0):
                opened.sendto(part, address(controls))
            print('{"left_m": 0.4, "right_m": 0.3, "state": "following"}', flush=True)
            left -= 1
