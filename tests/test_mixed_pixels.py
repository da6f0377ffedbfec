# SPDX-License-Identifier: MIT
"""Tests that a lidar's macro with several rays a beam has returns between slats and the wall, unlike thin rays."""
from typing import List

import probes
import pytest
from gazebo_calls import call, empty, pose, spawn

from ardee_common.ros_graph import RosGraph

# Slats and wall are less than a pulse length apart: one return.
SLATS_M, WALL_M, HEIGHT_M = 2.0, 2.2, 0.5
HALF_WIDTH_M = 1.0  # half width of the fence
MARGIN_M = 0.02  # distance from the slats and the wall, on each side; lidars here have no noise
RAYS = {"thin": 1, "wide": 25}
BOX = "<geometry><box><size>0.01 {width} 2</size></box></geometry>"
WORLD = """<sdf version="1.5"><world name="default">
  <physics type="ode"><max_step_size>0.005</max_step_size></physics>
  <model name="fence"><static>true</static><link name="link">{visuals}</link></model>
</world></sdf>"""
ROBOT = """<robot name="post" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:property name="robot_namespace" value="/" />
  <xacro:include filename="$(find ardee_sensors)/urdf/all_sensors.urdf.xacro" />
  <link name="base_footprint" /><gazebo><static>true</static></gazebo>
  {lidars}
</robot>"""


def board(name: str, face_m: float, y_m: float, width_m: float) -> str:
    """Returns a visual 1 cm thick whose near face is at x = face_m."""
    place = f"<pose>{face_m + 0.005} {y_m} 0 0 0 0</pose>"
    return f'<visual name="{name}">{place}{BOX.format(width=width_m)}</visual>'


def world() -> str:
    """Yields slats of 5 cm every 11 cm, before a wall."""
    slats = [board(f"slat_{k}", SLATS_M, 0.11 * k, 0.05) for k in range(-10, 11)]
    return WORLD.format(visuals=board("wall", WALL_M, 0, 8) + "".join(slats))


def between(scan: object) -> List[float]:
    """Returns the x in m of returns of the fence that are neither on a slat nor on the wall."""
    import math

    found = []
    for k, range_m in enumerate(scan.ranges):
        angle = scan.angle_min + k * scan.angle_increment
        x, y = range_m * math.cos(angle), range_m * math.sin(angle)
        if abs(angle) < 1 and abs(y) < HALF_WIDTH_M and SLATS_M + MARGIN_M < x < WALL_M - MARGIN_M:
            found.append(x)
    return found


@pytest.fixture
def scans(graph: RosGraph) -> dict:
    """Returns one scan of each lidar."""
    (graph.folder / "fence.world").write_text(world())
    graph.spawn(
        "rosrun", "ardee_sim_cpp", "simulator", str(graph.folder / "fence.world"), "--paused"
    )
    lidars = "".join(
        f'<xacro:sensor_hokuyo_ust10lx name="{name}" parent="base_footprint" noise_std_m="0" '
        f'noise_growth_m_per_m="0" sub_rays="{rays}"><origin xyz="0 0 0" /></xacro:sensor_hokuyo_ust10lx>'
        for name, rays in RAYS.items()
    )
    robot = graph.folder / "post.urdf.xacro"
    robot.write_text(ROBOT.format(lidars=lidars))
    xml = graph.run("rosrun", "xacro", "xacro", str(robot))
    post = spawn("post", xml, pose(z=HEIGHT_M), "urdf", robot_namespace="/")
    spawned, _ = call(graph, post, empty("unpause_physics"))
    assert spawned.success, spawned.status_message
    return {
        name: graph.call(probes.collect, f"/ardee/{name}", "sensor_msgs/LaserScan", 1)[0]
        for name in RAYS
    }


def test_mixed_pixels_come_with_the_width_of_the_beam(scans: dict) -> None:
    assert between(scans["thin"]) == []
    # Of 38 edges in sight, 11 in 12 lie in a beam (4 mrad of every 4.36); the margins drop those with less than a tenth
    # of the power on one side: about two in three remain, and by chance not less than one.
    assert len(between(scans["wide"])) > 12
