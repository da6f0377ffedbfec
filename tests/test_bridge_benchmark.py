# SPDX-License-Identifier: MIT
"""Tests the bridge's benchmark, on messages of its own and on a simulated robot."""
import json
import pathlib
from typing import Any, Dict

import pytest
from bench.capture import Capture
from ros_graph import RosGraph

PROGRAM = pathlib.Path(__file__).resolve().parent / "bench" / "latency_benchmark"
SENSORS = {"imu", "gps", "lidar", "battery", "encoder", "point_cloud", "jpeg image", "raw image"}
ROWS = {f"{name} message to datagram" for name in SENSORS | {"bare forwarder"}}


def measured(graph: RosGraph, *arguments: str) -> Dict[str, Any]:
    """Returns the benchmark's figures by row."""
    output = graph.run(str(PROGRAM), "--json", *arguments, timeout_s=240.0)
    found = json.loads(output.splitlines()[-1])
    for figures in found.values():
        assert figures["sent"] > 0 and 0 < figures["p50_ms"] <= figures["max_ms"]
    return found


def test_everything_is_measured(graph: RosGraph) -> None:
    assert set(measured(graph, "--seconds", "1", "--cameras")) == ROWS | {"datagram to cmd_vel"}


@pytest.mark.parametrize("only", ["sensors", "controls"])
def test_one_half_is_left_out(graph: RosGraph, only: str) -> None:
    kinds = measured(graph, "--seconds", "0.5", "--only", only)
    assert kinds and {"cmd_vel" in name for name in kinds} == {only == "controls"}


def test_every_sensor_of_a_simulated_robot_is_timed_by_its_packets(graph: RosGraph) -> None:
    try:
        Capture("/anyone").close()
    except OSError as error:
        pytest.skip(f"packets cannot be captured here: {error}")
    arguments = ("--simulator", "--only", "sensors", "--seconds", "10", "--cameras")
    assert set(measured(graph, *arguments)) == ROWS
