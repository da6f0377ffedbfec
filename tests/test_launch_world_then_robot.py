# SPDX-License-Identifier: MIT
"""Tests the two launch commands of the README: first a world, then a robot in it."""
import math
from typing import Iterator

import numpy as np
import probes
import pytest

from ardee_common.ros_graph import RosGraph

SCAN = "/ardee/hokuyo"


@pytest.fixture(scope="module")
def robot(shared_graph: RosGraph) -> Iterator[RosGraph]:
    """Yields farm.world, and a TerraSentia in it."""
    shared_graph.launch("ardee_world", "custom_world.launch", "world:=farm.world")
    shared_graph.call(probes.clock_at_least, 0.5)
    shared_graph.launch("terrasentia_description", "launch_default_tsv1.launch", "use_rviz:=false")
    shared_graph.call(probes.wait_for_topics, ["/odom", "/joint_states", SCAN, "/tf"], [])
    yield shared_graph


def test_the_clock_goes_on(robot: RosGraph) -> None:
    clocks = robot.call(probes.collect, "/clock", "rosgraph_msgs/Clock", 50)
    times = [message.clock.to_nsec() for message in clocks]
    assert all(later > earlier for earlier, later in zip(times, times[1:]))


def test_the_lidar_scans_at_40_hz_of_simulated_time(robot: RosGraph) -> None:
    scans = robot.call(probes.collect, SCAN, "sensor_msgs/LaserScan", 41)
    stamps = [scan.header.stamp.to_nsec() for scan in scans]
    assert stamps[-1] - stamps[0] == pytest.approx(1_000_000_000, abs=5_000_000)
    assert len(scans[0].ranges) == len(scans[-1].ranges) > 100


def test_the_lidar_sees_plants(robot: RosGraph) -> None:
    scan = robot.call(probes.collect, SCAN, "sensor_msgs/LaserScan", 1)[0]
    near = [r for r in scan.ranges if scan.range_min < r < 5.0]
    assert len(near) > 50


def test_the_front_camera_sees_plants_between_soil_and_sky(robot: RosGraph) -> None:
    picture = robot.call(probes.collect, "/ardee/camera/front/image_raw", "sensor_msgs/Image", 1)[0]
    pixels = np.frombuffer(picture.data, np.uint8).reshape(picture.height, picture.width, 3)
    red, green, blue = np.moveaxis(pixels.astype(int), 2, 0)
    plants, soil, sky = green > np.maximum(red, blue), red > green + 10, blue > green
    top, _, bottom = (slice(start, start + 160) for start in (0, 160, 320))
    assert plants[top].mean() > 0.4 and sky[top].mean() > 0.1 and soil[top].mean() < 0.01
    assert soil[bottom].mean() > 0.8 and sky[bottom].mean() < 0.01


def test_joint_states_name_legs_and_wheels(robot: RosGraph) -> None:
    message = robot.call(probes.collect, "/joint_states", "sensor_msgs/JointState", 1)[0]
    assert sum(name.endswith("_wheel_rev") for name in message.name) == 4
    assert sum(name.endswith("_leg_joint") for name in message.name) == 4
    assert len(message.position) == len(message.name)
    assert all(math.isfinite(angle) for angle in message.position)


def test_tf_leads_from_odom_to_every_wheel_and_the_lidar(robot: RosGraph) -> None:
    for frame in (
        "base_footprint",
        "front_left_wheel_link",
        "rear_right_wheel_link",
        "hokuyo_link",
    ):
        found = robot.call(probes.transform, "odom", frame)
        assert found.header.frame_id == "odom"


def test_at_rest_it_stays_where_it_is(robot: RosGraph) -> None:
    """Checks that, after settling, it moves less than a millimetre in two seconds."""
    robot.call(probes.clock_at_least, 4.0)
    odometry = robot.call(probes.collect, "/odom", "nav_msgs/Odometry", 100)
    first, last = (message.pose.pose.position for message in (odometry[0], odometry[-1]))
    assert math.hypot(last.x - first.x, last.y - first.y) < 1e-3
    assert abs(odometry[-1].twist.twist.linear.x) < 1e-3


def test_cmd_vel_drives_it_forward(robot: RosGraph) -> None:
    """Drives at 0.5 m/s for 2 s of simulated time: about 1 m along its own heading, less the way lost at the start."""
    first, last = robot.call(probes.drive, "/cmd_vel", "/odom", 0.5, 0.0, 2.0)
    start, end = first.pose.pose, last.pose.pose
    heading = 2 * math.atan2(start.orientation.z, start.orientation.w)
    dx, dy = end.position.x - start.position.x, end.position.y - start.position.y
    forward = dx * math.cos(heading) + dy * math.sin(heading)
    sideways = dy * math.cos(heading) - dx * math.sin(heading)
    assert 0.7 < forward < 1.1
    assert abs(sideways) < 0.15


def test_the_world_knows_the_robot(robot: RosGraph) -> None:
    states = robot.call(probes.collect, "/gazebo/model_states", "gazebo_msgs/ModelStates", 1)[0]
    assert any("terrasentia" in name.lower() for name in states.name)
    links = robot.call(probes.collect, "/gazebo/link_states", "gazebo_msgs/LinkStates", 1)[0]
    assert any(name.endswith("::base_footprint") for name in links.name)
    assert len(links.name) == len(links.pose) == len(links.twist)
