# SPDX-License-Identifier: MIT
"""Tests a PTZ camera over ROS: position commands turn it, set_hfov zooms it, bad ones are refused with one message."""
import math
from typing import Any, Dict, List, Tuple

import pytest

from ardee_common.ros_graph import RosGraph, wait_until

PAN_RAD, TILT_RAD, FOV_RAD = 0.6, 0.35, 0.3
CLOSE_RAD = 1e-3
WIDTH_PX = 704
BASE = "/ardee/sensor"
COMMANDS = {
    f"{BASE}/pan_position_controller/command": PAN_RAD,
    f"{BASE}/tilt_position_controller/command": TILT_RAD,
    f"{BASE}/set_hfov": FOV_RAD,
}


def lead(refused_fov_rad: float) -> Tuple[Dict[str, float], Any]:
    """Returns, as a probe, joint angles and calibration that have followed the commands, after a refused one."""
    import probes
    import rospy
    from std_msgs.msg import Float64

    probes._start()
    angles, infos = {}, []  # type: Dict[str, float], List[Any]

    def on_joints(message: Any) -> None:
        angles.update(zip(message.name, message.position))

    publishers = {topic: rospy.Publisher(topic, Float64, queue_size=10) for topic in COMMANDS}
    rospy.Subscriber("/joint_states", probes._type("sensor_msgs/JointState"), on_joints)
    rospy.Subscriber(f"{BASE}/camera_info", probes._type("sensor_msgs/CameraInfo"), infos.append)
    wait_until(
        lambda: infos and all(each.get_num_connections() for each in publishers.values()),
        "the camera and its subscribers",
        60.0,
    )
    unzoomed_px = infos[-1].K[0]
    publishers[f"{BASE}/set_hfov"].publish(refused_fov_rad)
    for topic, value in COMMANDS.items():
        publishers[topic].publish(value)
    wait_until(
        lambda: abs(angles.get("sensor_pan_joint", 0) - PAN_RAD) < CLOSE_RAD
        and abs(angles.get("sensor_tilt_joint", 0) - TILT_RAD) < CLOSE_RAD
        and infos[-1].K[0] != unzoomed_px,
        "the camera to follow",
        60.0,
    )
    return angles, infos[-1]


def test_commands_turn_and_zoom_the_camera(graph: RosGraph) -> None:
    graph.launch("ardee_sensors", "show_sensor.launch", "sensor:=axis", "rviz:=false")
    angles, info = graph.call(lead, 3.0, timeout_s=150.0)
    assert angles["sensor_pan_joint"] == pytest.approx(PAN_RAD, abs=CLOSE_RAD)
    assert angles["sensor_tilt_joint"] == pytest.approx(TILT_RAD, abs=CLOSE_RAD)
    focal_px = WIDTH_PX / 2 / math.tan(FOV_RAD / 2)
    assert (info.K[0], info.K[4]) == pytest.approx((focal_px, focal_px), rel=1e-6)
    assert info.P[0] == info.K[0]
    refusals = [line for line in graph.logs().splitlines() if "set_hfov: found 3" in line]
    assert refusals and "expected a number in [" in refusals[0]
