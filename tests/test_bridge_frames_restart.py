# SPDX-License-Identifier: MIT
"""The sensor server's process for images is started again when it dies, though nobody asks anew."""
import os
import signal
from pathlib import Path

from bridge_bench import frame_processes
from ros_graph import RosGraph, wait_until

PEER = "{address: 127.0.0.1, port: 9, data_types: [image]}"
SOURCE = "{name: depth, kind: image, topic: /kept/depth, component_id: 6, format: raw}"


def test_a_process_for_images_that_died_is_started_again(shared_graph: RosGraph) -> None:
    parameters = ("_port:=0", f"_peers:=[{PEER}]", f"_sources:=[{SOURCE}]", "__name:=kept_server")
    node = shared_graph.spawn("rosrun", "ardee_bridge", "sensor_server_node", *parameters)
    (first,) = wait_until(lambda: frame_processes(node.pid), "a process for images", 60.0)
    os.kill(first, signal.SIGKILL)
    (second,) = wait_until(lambda: frame_processes(node.pid) - {first}, "another one", 60.0)
    assert "kept_server_frames has ended: exit code -9" in node.output()
    node.interrupt()
    assert node.wait(20.0) == 0, node.output()
    assert not Path(f"/proc/{second}").exists()
