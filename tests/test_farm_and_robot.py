# SPDX-License-Identifier: MIT
"""Tests launch/farm_and_robot.launch: a world and a robot at once."""
import pathlib

import probes

from ardee_common.ros_graph import RosGraph

FILE = pathlib.Path(__file__).resolve().parents[1] / "launch" / "farm_and_robot.launch"


def test_its_robot_is_where_it_was_wanted_scans_and_drives(graph: RosGraph) -> None:
    arguments = ["world:=empty.world", "seed:=3", "rtf:=2", "x:=2.0", "yaw:=0", "use_rviz:=false"]
    graph.spawn("roslaunch", str(FILE), *arguments)
    graph.call(probes.wait_for_topics, ["/odom", "/tf", "/joint_states", "/ardee/hokuyo"], [])
    scan = graph.call(probes.collect, "/ardee/hokuyo", "sensor_msgs/LaserScan", 1)[0]
    assert len(scan.ranges) > 100
    assert graph.run("rosparam", "get", "/gazebo/seed").strip() == "3"
    assert float(graph.run("rosparam", "get", "/gazebo/real_time_factor")) == 2.0
    states = graph.call(probes.collect, "/gazebo/model_states", "gazebo_msgs/ModelStates", 1)[0]
    at = states.pose[states.name.index("TerraSentia_0")].position
    assert abs(at.x - 2.0) < 0.05 and abs(at.y) < 0.05
    first, last = graph.call(probes.drive, "/cmd_vel", "/odom", 0.5, 0.0, 2.0)
    driven_s = (last.header.stamp - first.header.stamp).to_sec()
    driven_m = last.pose.pose.position.x - first.pose.pose.position.x
    assert 0.5 * driven_s - 0.4 < driven_m < 0.5 * driven_s + 0.02  # less the way lost at the start
