# SPDX-License-Identifier: MIT
"""The bridge's benchmark on a simulated robot, with the rights to capture packets and without them."""
import json
import os
from typing import Tuple

import pytest
from ros_graph import RosGraph

from ardee_bridge.capture import Capture

WITHOUT_RIGHT = ("setpriv", "--bounding-set", "-net_raw", "--inh-caps", "-net_raw")


def measured(graph: RosGraph, before: Tuple[str, ...], by: str) -> None:
    """With so a command before it and such rows."""
    command = (*before, "rosrun", "ardee_bridge", "latency_benchmark", "--json", "--simulator")
    arguments = ("--only", "sensors", "--seconds", "10", "--cameras")
    kinds = json.loads(graph.run(*command, *arguments, timeout_s=240.0).splitlines()[-1])
    names = {"imu", "gps", "lidar", "battery", "encoder", "point_cloud"}
    names |= {"jpeg image", "raw image"}
    rows = {f"{by}{name}" for name in names} | {"bare forwarder"}
    assert set(kinds) == {f"{row} message to datagram" for row in rows}
    for figures in kinds.values():
        assert figures["sent"] > 0 and 0 < figures["p50_ms"] <= figures["max_ms"]


def test_every_sensor_of_a_simulated_robot_is_timed_by_its_packets(graph: RosGraph) -> None:
    try:
        Capture("/anyone").close()
    except OSError as error:
        pytest.skip(f"packets cannot be captured here: {error}")
    measured(graph, (), "")


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can give the right away")
def test_every_sensor_of_a_simulated_robot_is_timed_by_a_witness(graph: RosGraph) -> None:
    measured(graph, WITHOUT_RIGHT, "witnessed ")
