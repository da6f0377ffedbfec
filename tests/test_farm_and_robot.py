# SPDX-License-Identifier: MIT
"""launch/farm_and_robot.launch: a world and a robot at once."""
import pathlib

import probes
from ros_graph import RosGraph

FILE = pathlib.Path(__file__).resolve().parents[1] / "launch" / "farm_and_robot.launch"


def test_its_robot_is_where_it_was_wanted_scans_and_drives(graph: RosGraph) -> None:
    arguments = ["world:=empty.world", "seed:=3", "rtf:=0", "x:=2.0", "yaw:=0", "use_rviz:=false"]
    graph.spawn("roslaunch", str(FILE), *arguments)
    graph.call(probes.wait_for_topics, ["/odom", "/tf", "/joint_states", "/ardee/hokuyo"], [])
    scan = graph.call(probes.collect, "/ardee/hokuyo", "sensor_msgs/LaserScan", 1)[0]
    assert len(scan.ranges) > 100
    assert graph.run("rosparam", "get", "/gazebo/seed").strip() == "3"
    graph.call(probes.drive, "/cmd_vel", "/odom", 0.5, 0.0, 2.0)
    states = graph.call(probes.collect, "/gazebo/model_states", "gazebo_msgs/ModelStates", 1)[0]
    at = states.pose[states.name.index("TerraSentia_0")].position
    assert 2.7 < at.x < 3.2 and abs(at.y) < 0.1  # 0.5 m/s for 2 s, less what starting takes
