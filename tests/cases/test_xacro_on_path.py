# SPDX-License-Identifier: MIT
"""A robot's launch file has command="xacro ...": the workspace's set-up file puts xacro on PATH, and robot_description
has the mass 1 + a = 2."""
import shutil
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import probes

from ardee_common.ros_graph import RosGraph

FOLDER = Path(__file__).with_name("xacro-on-path")


def test_a_launch_file_that_calls_xacro_by_its_name(graph: RosGraph) -> None:
    for name in ("xacro", "xacro.py"):
        assert shutil.which(name, path=graph.env["PATH"])
    graph.env["ROS_PACKAGE_PATH"] = f"{FOLDER}:{graph.env['ROS_PACKAGE_PATH']}"
    graph.run("roslaunch", "hut_description", "load.launch")
    text = graph.call(probes.parameter, "/robot_description")
    robot = ElementTree.fromstring(text)
    assert float(robot.find("link/inertial/mass").get("value")) == 2.0
    assert "xacro:" not in text
