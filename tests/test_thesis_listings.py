# SPDX-License-Identifier: MIT
"""Tests that robots of the thesis's Listings A.1 to A.13 and A.25, as they are printed, load and work."""
import math
import pathlib
import string
from typing import Any, List

import probes
import pytest
from gazebo_calls import call, pose, simulate, spawn, state

from ardee_common.ros_graph import Process, RosGraph, wait_until

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


def start(graph: RosGraph, xml: str, kind: str, z: float = 0.5) -> Process:
    """Starts the simulator and spawns the robot; fails at any complaint."""
    simulator = simulate(graph, GROUND)
    answer = call(graph, spawn("r", xml, pose(z=z), kind))[0]
    assert answer.success, answer.status_message
    complaints = [line for line in simulator.output().splitlines() if "ERROR" in line]
    assert complaints == []
    return simulator


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
    text = BODY.format(link="base_link", more=more + base + leg)
    simulator = start(graph, expanded(graph, text), "urdf", 2)
    graph.call(probes.clock_at_least, 3.0)
    joint = (
        "/gazebo/get_joint_properties",
        "gazebo_msgs/GetJointProperties",
        {"joint_name": "front_right_leg_joint"},
    )
    assert call(graph, joint)[0].position[0] == pytest.approx(-0.2, abs=0.005)
    assert "joint front_right_leg_joint: position -0.2 rad" in simulator.output()  # verbose


PLOT = {
    "plot_id": 3,
    "plot_range_index": 0,
    "plot_crossrange_index": 0,
    "x": 0,
    "y": 0,
    "z": 0,
    "rotation": 0,
}
PLOT.update(row_count=4, row_width=0.762, row_length=5, average_height=1.5)


def test_the_sensors_of_listing_a_12_in_a_plot_of_a_7_have_the_noise_of_a_6(
    graph: RosGraph,
) -> None:
    """Crops of 1.5 m lie in the band whose variance is four times the open sky's, of 1 mm."""
    field = graph.folder / "models/field"
    field.mkdir(parents=True)
    (field / "model.sdf").write_text(
        '<sdf version="1.5"><model name="field"><static>true</static><link name="l"/></model></sdf>'
    )
    plots = string.Template((LISTINGS / "a_7.xacro").read_text()).substitute(PLOT)
    (field / "plots.xacro").write_text(plots)
    (graph.folder / "custom_gps_behavior.geofence").write_text(
        (LISTINGS / "a_6.geofence").read_text()
    )
    for name, folder in (("MODEL", field.parent), ("RESOURCE", graph.folder)):
        graph.env[f"GAZEBO_{name}_PATH"] = f"{folder}:{graph.env[f'GAZEBO_{name}_PATH']}"
    world = "<include><uri>model://field</uri></include></world>"
    simulator = simulate(graph, GROUND.replace("</world>", world))
    robot = graph.run(
        "bash",
        "-c",
        f"xacro $(rospack find terrasentia_description)/robots/tsv1.urdf.xacro sensors:={LISTINGS}/a_12.urdf.xacro",
    )
    answer = call(graph, spawn("r", robot, pose(z=0.2), "urdf"))[0]
    assert answer.status_message == "SpawnModel: Successfully spawned entity"
    gps = collected(graph, "/ardee/gps/data", "ardee_msgs/GpsQuality", 3)[-1]
    assert (gps.region, gps.position_std) == ("plot 3", pytest.approx(2 * 0.001))
    battery = collected(graph, "/ardee/battery", "ardee_msgs/Battery")[0]
    assert battery.voltage == pytest.approx(12.694, abs=0.1)
    topics = [
        "/ardee/hokuyo",
        "/ardee/imu/custom",
        "/ardee/camera/image_raw",
        "/ardee/camera_left/image_raw",
    ]
    graph.call(probes.wait_for_topics, topics, [])
    assert "WARN" not in simulator.output() and "ERROR" not in simulator.output()


def test_the_chassis_of_listing_a_10_weighs_what_it_says(graph: RosGraph) -> None:
    urdf = "$(find terrasentia_description)/urdf/includes"
    more = "".join(
        f'<xacro:include filename="{urdf}/{name}.urdf.xacro"/>' for name in ("materials", "utils")
    )
    meshes = "package://terrasentia_description/meshes/v2"
    more += (LISTINGS / "a_10.txt").read_text() + (
        f'<xacro:chassis_v2 name="base" stl_chassis="{meshes}/base_link.STL" stl_lid="{meshes}/lid.STL" color="grey"/>'
    )
    start(
        graph,
        expanded(graph, f'<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">{more}</robot>'),
        "urdf",
    )
    kind = "gazebo_msgs/GetLinkProperties"
    links = [
        ("/gazebo/get_link_properties", kind, {"link_name": f"r::{each}"})
        for each in ("base", "lid_link")
    ]
    assert [answer.mass for answer in call(graph, *links)] == pytest.approx([7.227, 0.01])
