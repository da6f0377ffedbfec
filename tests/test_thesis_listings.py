# SPDX-License-Identifier: MIT
"""Tests that robots of the thesis's Listings A.1, A.2, A.5, A.13 and A.25, as they are printed, load and work."""
import math
import pathlib
from typing import Any, List

import probes
import pytest
from gazebo_calls import call, pose, simulate, spawn, state
from ros_graph import RosGraph, wait_until

LISTINGS = pathlib.Path(__file__).resolve().parent / "data/listings"
GROUND = """<sdf version="1.6"><world name="w">
  <include><uri>model://ground_plane</uri></include></world></sdf>"""
INERTIAL = """<inertial><mass value="{mass}"/><inertia ixx="{moment}" ixy="0" ixz="0" iyy="{moment}" iyz="0"
  izz="{moment}"/></inertial>"""
BODY = f"""<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro"><link name="{{link}}">
  {INERTIAL.format(mass=5, moment=1)}</link>{{more}}</robot>"""
A_2_CALL = """<xacro:sensor_gps name="gps" parent="base_footprint" color="white" ref_lat="0" ref_long="0" ref_head="0"
  drift="0" vel_drift="0" noise="0" vel_noise="0" update_rate="5"><origin xyz="0 0 1"/></xacro:sensor_gps>"""
WHEEL = f"""<link name="wheel">{INERTIAL.format(mass=1, moment=0.01)}</link>
  <joint name="front_left_wheel_rev" type="continuous"><parent link="base_footprint"/><child link="wheel"/>
    <axis xyz="0 1 0"/></joint>"""
A_25_CALL = """<xacro:leg_type_1 prefix="front" suffix="right" color="orange" min="-0.682" max="0.2" damping="2"
    stiffness="200" spring_reference="-0.2" reflect="-1"
    stl="package://terrasentia_description/meshes/v1/leg_type_1.STL" verbose="true">
    <origin xyz="0 0 0"/></xacro:leg_type_1>"""


def expanded(graph: RosGraph, text: str) -> str:
    """Returns the URDF of a xacro text."""
    file = graph.folder / "listing.urdf.xacro"
    file.write_text(text)
    return graph.run("rosrun", "xacro", "xacro", str(file))


def include(name: str) -> str:
    return f'<xacro:include filename="{LISTINGS / name}"/>'


def start(graph: RosGraph, xml: str, kind: str, z: float = 0.5) -> None:
    """Starts the simulator and spawns the robot; fails at any complaint."""
    simulator = simulate(graph, GROUND)
    answer = call(graph, spawn("r", xml, pose(z=z), kind))[0]
    assert answer.success, answer.status_message
    complaints = [line for line in simulator.output().splitlines() if "ERROR" in line]
    assert complaints == []


def collected(graph: RosGraph, topic: str, kind: str, count: int = 1) -> List[Any]:
    return graph.call(probes.collect, topic, kind, count)


@pytest.mark.parametrize("listing", ["a_1.sdf", "a_2.urdf.xacro"])
def test_the_receivers_of_listings_a_1_and_a_2_are_at_urbana(graph: RosGraph, listing: str) -> None:
    if listing == "a_1.sdf":
        start(graph, (LISTINGS / listing).read_text(), "sdf")
    else:
        more = include(listing) + A_2_CALL
        start(graph, expanded(graph, BODY.format(link="base_footprint", more=more)), "urdf")
    fix = collected(graph, "/gps", "sensor_msgs/NavSatFix")[0]
    metre_deg = 1 / 111_000
    assert (fix.latitude, fix.longitude) == pytest.approx((40.1105875, -88.2072697), abs=metre_deg)
    assert fix.header.frame_id == "gps_link"


def test_the_model_of_listing_a_1_is_found_by_its_name(graph: RosGraph) -> None:
    include_model = "<include><uri>model://simple_gps_model</uri></include>"
    simulate(graph, GROUND.replace("</world>", include_model + "</world>"))
    fix = collected(graph, "/gps", "sensor_msgs/NavSatFix")[0]
    assert fix.latitude == pytest.approx(40.1105875, abs=1e-5)


def test_the_encoder_of_listing_a_5_publishes_on_its_topic(graph: RosGraph) -> None:
    text = (LISTINGS / "a_5.txt").read_text() + '<xacro:sensor_encoder parent="base_footprint"/>'
    start(graph, expanded(graph, BODY.format(link="base_footprint", more=WHEEL + text)), "urdf")
    count = collected(graph, "/encoder", "ardee_msgs/Encoder")[0]
    assert count.position == pytest.approx(0, abs=2 * math.pi / 150)  # a pulse


def drive_forward(seconds: float) -> None:
    """Commands, as a probe, 0.5 m/s for a simulated time."""
    import rospy
    from geometry_msgs.msg import Twist

    probes._start()
    publisher = rospy.Publisher("/cmd_vel", Twist, queue_size=1)
    wait_until(publisher.get_num_connections, "the drive's subscription")
    command = Twist()
    command.linear.x = 0.5
    end = rospy.Time.now() + rospy.Duration.from_sec(seconds)
    while rospy.Time.now() < end:
        publisher.publish(command)
        rospy.sleep(0.05)
    publisher.publish(Twist())


def test_the_robot_of_listing_a_13_drives(graph: RosGraph) -> None:
    """It stands as high as its configuration says, its lid not on the ground, and drives 2 m in 4 s, less the start."""
    start(graph, expanded(graph, (LISTINGS / "a_13.urdf.xacro").read_text()), "urdf", z=0.2)
    graph.call(probes.clock_at_least, 1.0)
    (before,) = call(graph, state("r"))
    graph.call(drive_forward, 4.0)
    (after,) = call(graph, state("r"))
    assert before.pose.position.z == pytest.approx(0.175, abs=0.01)
    assert after.pose.position.x - before.pose.position.x == pytest.approx(2.0, abs=0.2)
    assert abs(after.pose.position.y) < 0.05


def test_the_leg_of_listing_a_25_settles_at_its_spring_s_rest(graph: RosGraph) -> None:
    more = include("a_25.urdf.xacro") + A_25_CALL
    base = '<gazebo reference="base_link"><gravity>0</gravity></gazebo>'
    leg = '<gazebo reference="front_right_leg_link"><gravity>0</gravity></gazebo>'
    start(graph, expanded(graph, BODY.format(link="base_link", more=more + base + leg)), "urdf", 2)
    graph.call(probes.clock_at_least, 3.0)
    joint = (
        "/gazebo/get_joint_properties",
        "gazebo_msgs/GetJointProperties",
        {"joint_name": "front_right_leg_joint"},
    )
    assert call(graph, joint)[0].position[0] == pytest.approx(-0.2, abs=0.005)
