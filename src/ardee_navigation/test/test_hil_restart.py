# SPDX-License-Identifier: MIT
"""Tests the row follower without ROS while the simulation ends and comes back, or the network goes away."""
import errno
import socket
from typing import Any, Iterator, Tuple

import numpy as np
import pytest
from scans import ANGLE_MIN_RAD, INCREMENT_RAD, lane_walls, scan_of

from ardee_bridge.wire import codec
from ardee_navigation.lbirnt import Parameters
from ardee_navigation.nodes.hil_row_follower import Target

IN_THE_ROW = scan_of(*lane_walls(0.0, 0.0))
ROWS_ARE_GONE = np.full(len(IN_THE_ROW), np.inf)


class Simulator:
    """Socket of a sensor server and of a controls client, and the target between them."""

    def __init__(self) -> None:
        self.sensors, self.controls = self._bound(), self._bound()
        ends = (self.sensors.getsockname(), self.controls.getsockname())
        self.target = Target(Parameters(), *ends, ("127.0.0.1", 0))
        self.target.ask()
        self._address = self.sensors.recvfrom(65535)[1]

    @staticmethod
    def _bound() -> socket.socket:
        made = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        made.bind(("127.0.0.1", 0))
        made.settimeout(5.0)
        return made

    def scan(self, ranges_m: np.ndarray, time_ms: int) -> Any:
        """Returns the target's answer to a scan of this time."""
        sec, nsec = time_ms // 1000, time_ms % 1000 * 1_000_000
        stamp = codec.TimeStamp(sec=sec, nsec=nsec, data_type=codec.DataType.LIDAR)
        scan = codec.LidarData(
            angle_min=ANGLE_MIN_RAD, angle_max=-ANGLE_MIN_RAD, dAngle=INCREMENT_RAD, scan_time=0.025
        ).to_raw()
        scan.ranges = codec.range_counts(ranges_m, 0.06, 10.0)
        messages: Tuple[codec.Datagrams, ...] = (
            codec.encode(codec.DataType.TIME, 0, stamp.pack()),
            codec.encode(codec.DataType.LIDAR, 0, scan.pack(), count=len(ranges_m)),
        )
        for datagram in messages[0] + messages[1]:
            self.sensors.sendto(datagram, self._address)
        return [self.target.receive() for _ in range(4)][-1]

    def close(self) -> None:
        self.target.stop()
        self.sensors.close()
        self.controls.close()


@pytest.fixture()
def simulator() -> Iterator[Simulator]:
    made = Simulator()
    yield made
    made.close()


def finish(simulator: Simulator) -> int:
    """Drives to the end of a row; returns the time of it [ms]."""
    assert simulator.scan(IN_THE_ROW, 20_000)["state"] == "following"
    for time_ms in range(20_025, 21_100, 25):
        state = simulator.scan(ROWS_ARE_GONE, time_ms)["state"]
    assert state == "finished"
    return time_ms


def test_a_simulation_that_was_started_again_is_driven_again(simulator: Simulator) -> None:
    end_ms = finish(simulator)
    assert simulator.scan(IN_THE_ROW, end_ms + 25)["state"] == "finished"
    again = simulator.scan(IN_THE_ROW, 300)
    assert again["state"] == "following" and again["speed_m_s"] > 0.0


def test_scans_that_changed_places_are_no_new_simulation(simulator: Simulator) -> None:
    end_ms = finish(simulator)
    assert simulator.scan(IN_THE_ROW, end_ms - 25)["state"] == "finished"


class Unplugged:
    """Socket that receives and cannot send."""

    def __init__(self, opened: socket.socket) -> None:
        self._opened = opened

    def sendto(self, *_: Any) -> int:
        raise OSError(errno.ENETUNREACH, "Network is unreachable")

    def __getattr__(self, name: str) -> Any:
        return getattr(self._opened, name)


def test_a_network_that_is_away_is_told_once_each_time(
    simulator: Simulator, capsys: pytest.CaptureFixture
) -> None:
    plugged, (host, port) = simulator.target._socket, simulator.controls.getsockname()
    line = f"hil_row_follower: cannot send to {host}:{port}: Network is unreachable\n"
    for start_ms in (1000, 2000):
        simulator.target._socket = Unplugged(plugged)
        for time_ms in (0, 25, 50):
            simulator.scan(IN_THE_ROW, start_ms + time_ms)
        assert capsys.readouterr().err == line
        simulator.target._socket = plugged
        simulator.scan(IN_THE_ROW, start_ms + 75)
        assert capsys.readouterr().err == ""


def test_a_network_that_is_away_does_not_end_it(simulator: Simulator) -> None:
    plugged = simulator.target._socket
    simulator.target._socket = Unplugged(plugged)
    assert simulator.scan(IN_THE_ROW, 1000)["state"] == "following"
    simulator.target._socket = plugged
    assert simulator.scan(IN_THE_ROW, 1025)["state"] == "following"
    assert simulator.controls.recvfrom(65535)[0]  # the command of the second scan
