# SPDX-License-Identifier: MIT
"""The sensor server's process for images is started again when it dies, though nobody asks anew."""
import os
import signal
from pathlib import Path
from typing import Set

from ros_graph import Process, RosGraph, wait_until

PEER = "{address: 127.0.0.1, port: 9, data_types: [image]}"
SOURCE = "{name: depth, kind: image, topic: /kept/depth, component_id: 6, format: raw}"


def _command_of(pid: int) -> bytes:
    try:
        return Path(f"/proc/{pid}/cmdline").read_bytes()
    except FileNotFoundError:
        return b""


def frame_processes(node: Process) -> Set[int]:
    """Those that the node has started and that run."""
    children = Path(f"/proc/{node.pid}/task").glob("*/children")
    pids = [int(pid) for path in children for pid in path.read_text().split()]
    return {pid for pid in pids if b"ardee_bridge.frames" in _command_of(pid)}


def test_a_process_for_images_that_died_is_started_again(shared_graph: RosGraph) -> None:
    parameters = ("_port:=0", f"_peers:=[{PEER}]", f"_sources:=[{SOURCE}]", "__name:=kept_server")
    node = shared_graph.spawn("rosrun", "ardee_bridge", "sensor_server_node", *parameters)
    (first,) = wait_until(lambda: frame_processes(node), "a process for images", 60.0)
    os.kill(first, signal.SIGKILL)
    (second,) = wait_until(lambda: frame_processes(node) - {first}, "another one", 60.0)
    assert "kept_server_frames has ended: exit code -9" in node.output()
    node.interrupt()
    assert node.wait(20.0) == 0, node.output()
    assert not _command_of(second)
