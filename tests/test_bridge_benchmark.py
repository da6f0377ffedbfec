# SPDX-License-Identifier: MIT
"""Tests the bridge's benchmark, on messages of its own and on a simulated robot."""
import json
import pathlib
from typing import Any, Dict

import pytest
from bench.capture import Capture

from ardee_common.ros_graph import RosGraph

PROGRAM = pathlib.Path(__file__).resolve().parent / "bench" / "latency_benchmark"
SENSORS = {"imu", "gps", "lidar", "battery", "encoder", "point_cloud", "jpeg image", "raw image"}
ROWS = {f"{name} message to datagram" for name in SENSORS | {"bare forwarder"}}


def measured(graph: RosGraph, *arguments: str) -> Dict[str, Any]:
    """Returns the benchmark's figures by row."""
    output = graph.run(str(PROGRAM), "--json", *arguments, timeout_s=240.0)
    found = json.loads(output.splitlines()[-1])
    for figures in found.values():
        # a message through a socket takes microseconds, and the whole measurement less than minutes
        assert 0.005 < figures["p50_ms"] <= figures["p99_ms"] <= figures["max_ms"] < 240e3
    return found


def test_everything_is_measured(graph: RosGraph) -> None:
    found = measured(graph, "--duration-s", "1", "--cameras")
    assert set(found) == ROWS | {"datagram to cmd_vel"}
    # streams a row, and their rate [Hz]; of each, the last message may be due after the end
    planned = {"imu": (1, 100), "gps": (1, 20), "lidar": (1, 40), "battery": (1, 100)}
    planned.update({"encoder": (4, 100), "jpeg image": (3, 30), "raw image": (1, 10)})
    planned["point_cloud"] = (1, 10)
    for kind, (streams, rate_hz) in planned.items():
        sent = found[f"{kind} message to datagram"]["sent"]
        assert streams * (rate_hz - 3) <= sent <= streams * (rate_hz + 1), kind


@pytest.mark.parametrize("only", ["sensors", "controls"])
def test_one_half_is_left_out(graph: RosGraph, only: str) -> None:
    kinds = measured(graph, "--duration-s", "0.5", "--only", only)
    assert kinds and {"cmd_vel" in name for name in kinds} == {only == "controls"}


def test_every_sensor_of_a_simulated_robot_is_timed_by_its_packets(graph: RosGraph) -> None:
    try:
        Capture("/anyone").close()
    except OSError as error:
        pytest.skip(f"packets cannot be captured here: {error}")
    arguments = ("--simulator", "--only", "sensors", "--duration-s", "10", "--cameras")
    assert set(measured(graph, *arguments)) == ROWS
