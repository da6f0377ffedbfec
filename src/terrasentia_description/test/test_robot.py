# SPDX-License-Identifier: MIT
"""The expanded first-generation TerraSentia: names, masses, geometry, plugins."""
import pathlib
import shutil
import subprocess
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
from robot_urdf import Robot, numbers, pose
from xacro_runner import expand, mesh_path, read_stl, run_xacro

ROBOTS = pathlib.Path(__file__).resolve().parents[1] / "robots"
PLACES = ["front_left", "front_right", "rear_left", "rear_right"]
LEG_JOINTS = [f"{place}_leg_joint" for place in PLACES]
WHEEL_JOINTS = [f"{place}_wheel_rev" for place in PLACES]


def test_links_and_joints_have_the_names_of_the_thesis(robot: Robot):
    links = {"base_footprint", "lid_link", "hokuyo_link"}
    links |= {f"{place}_{part}_link" for place in PLACES for part in ("leg", "wheel")}
    assert set(robot.links) == links
    assert set(robot.joints) == set(LEG_JOINTS) | set(WHEEL_JOINTS) | {"lid_joint", "hokuyo_joint"}
    assert set(robot.links) - set(robot.joint_of) == {"base_footprint"}
    assert {j.get("type") for n, j in robot.joints.items() if n in LEG_JOINTS} == {"revolute"}
    assert {j.get("type") for n, j in robot.joints.items() if n in WHEEL_JOINTS} == {"continuous"}


def test_check_urdf_accepts_it(robot: Robot, tmp_path: pathlib.Path):
    if shutil.which("check_urdf") is None:
        pytest.skip("check_urdf is not installed (liburdfdom-tools)")
    file = tmp_path / "robot.urdf"
    file.write_text(robot.text)
    done = subprocess.run(["check_urdf", str(file)], capture_output=True, text=True)
    assert done.returncode == 0 and "root Link: base_footprint has 6 child(ren)" in done.stdout


@pytest.mark.parametrize("file", ["tsv1.urdf.xacro", "default_bot.urdf.xacro"])
def test_every_assembly_file_is_the_same_robot(robot: Robot, file: str):
    other = Robot(expand(ROBOTS / file))
    assert sorted(other.links) == sorted(robot.links)
    assert sorted(other.joints) == sorted(robot.joints)


def test_it_weighs_what_the_thesis_says(robot: Robot):
    assert sum(robot.mass(link) for link in robot.links) == pytest.approx(6.6, abs=1e-9)
    assert min(robot.mass(link) for link in robot.links) > 0.05


def test_inertias_are_physical(robot: Robot):
    for link in robot.links:
        moments = np.linalg.eigvalsh(robot.inertia(link))
        assert moments[0] > 0, link
        assert moments[2] <= moments[0] + moments[1], link
        # a body inside its own reach: no moment above mass * (half the robot's length)^2
        assert moments[2] < robot.mass(link) * 0.3**2, link


def test_a_wheel_is_a_solid_cylinder_about_its_axle(robot: Robot):
    for place in PLACES:
        link = f"{place}_wheel_link"
        turned = pose(robot.links[link].find("inertial"))[:3, :3]
        about_axle = np.array([0, 1, 0]) @ turned @ robot.inertia(link) @ turned.T @ [0, 1, 0]
        assert about_axle == pytest.approx(0.5 * robot.mass(link) * 0.097**2)


def test_collision_shapes_have_the_dimensions_of_the_thesis(robot: Robot):
    chassis = robot.links["base_footprint"].find("collision")
    assert numbers(chassis.find("geometry/box").get("size")) == pytest.approx(
        [0.508, 0.35322, 0.13136]
    )
    assert pose(chassis)[2, 3] == pytest.approx(0.04545)
    for place in PLACES:
        collision = robot.links[f"{place}_wheel_link"].find("collision")
        cylinder = collision.find("geometry/cylinder")
        assert float(cylinder.get("radius")) == 0.097
        assert float(cylinder.get("length")) == 0.03838
        assert abs(pose(collision)[:3, 2]) == pytest.approx([0, 1, 0])  # its axis is the axle


def test_wheel_surface(robot: Robot):
    for place in PLACES:
        blocks = robot.root.findall(f"gazebo[@reference='{place}_wheel_link']")
        values = {child.tag: child.text for block in blocks for child in block}
        assert (float(values["mu1"]), float(values["mu2"])) == (0.75, 0.75)
        assert (float(values["kp"]), float(values["kd"])) == (1e6, 100)
        assert values["fdir1"] == "0 0 1"


def test_meshes_exist_and_fill_their_collision_shapes(robot: Robot):
    for name, link in robot.links.items():
        mesh = link.find("visual/geometry/mesh")
        corners = read_stl(mesh_path(mesh.get("filename"))).reshape(-1, 3)
        assert np.abs(corners).max() < 0.3, name
        box = link.find("collision/geometry/box")
        if name in ("base_footprint", "lid_link"):
            assert np.ptp(corners, axis=0) == pytest.approx(numbers(box.get("size")), abs=1e-6)
            assert corners.max(axis=0) == pytest.approx(-corners.min(axis=0), abs=1e-6)
        if name.endswith("wheel_link"):
            assert np.hypot(corners[:, 0], corners[:, 2]).max() == pytest.approx(0.097, abs=1e-4)
            assert np.abs(corners[:, 1]).max() == pytest.approx(0.01919, abs=1e-4)


def test_spring_plugins_name_their_joints_and_limits(robot: Robot):
    springs = robot.plugins("libTorsionalSpringPlugin.so")
    assert sorted(spring.findtext("joint_handle") for spring in springs) == LEG_JOINTS
    for spring in springs:
        limit = robot.joints[spring.findtext("joint_handle")].find("limit")
        assert spring.findtext("lower_limit") == limit.get("lower")
        assert spring.findtext("upper_limit") == limit.get("upper")
        assert float(limit.get("upper")) - float(limit.get("lower")) == pytest.approx(0.682)
        values = [
            float(spring.findtext(f"spring_{k}")) for k in ("stiffness", "damping", "reference")
        ]
        assert values == [100, 1, 0]
        assert spring.findtext("verbose") == "false"


def test_drive_plugin_fits_the_robot(robot: Robot):
    (drive,) = robot.plugins("libgazebo_ros_skid_steer_drive.so")
    for side in ("left", "right"):
        for end, word in (("front", "Front"), ("rear", "Rear")):
            assert drive.findtext(f"{side}{word}Joint") == f"{end}_{side}_wheel_rev"
    assert float(drive.findtext("wheelSeparation")) == 0.4318
    assert float(drive.findtext("wheelDiameter")) == 0.194
    assert (float(drive.findtext("torque")), float(drive.findtext("updateRate"))) == (10, 50)
    assert drive.findtext("robotBaseFrame") == "base_footprint"
    assert (drive.findtext("odometryFrame"), drive.findtext("broadcastTF")) == ("odom", "true")


def test_all_moving_joints_are_published(robot: Robot):
    (states,) = robot.plugins("libgazebo_ros_joint_state_publisher.so")
    names = [name.strip() for name in states.findtext("jointName").split(",")]
    assert sorted(names) == sorted(LEG_JOINTS + WHEEL_JOINTS)


@pytest.mark.parametrize(
    "ns, expected", [("", "/"), ("robot2", "/robot2"), ("/robot2/", "/robot2")]
)
def test_the_namespace_reaches_every_plugin_that_publishes(ns: str, expected: str):
    root = ElementTree.fromstring(expand(ROBOTS / "tsv1_default.urdf.xacro", ns=ns))
    publishers = [p for p in root.iter("plugin") if "Spring" not in p.get("filename")]
    assert len(publishers) == 3
    assert {p.findtext("robotNamespace") for p in publishers} == {expected}


def test_a_changed_configuration_changes_the_robot(tmp_path: pathlib.Path):
    text = (ROBOTS / "tsv1.urdf.xacro").read_text()
    include = (
        '<xacro:include filename="$(find terrasentia_description)/config/tsv1_config.urdf.xacro" />'
    )
    assert include in text
    softer = '<xacro:property name="susp_stiffness" value="40" />'
    (tmp_path / "soft.urdf.xacro").write_text(text.replace(include, include + softer))
    soft = Robot(expand(tmp_path / "soft.urdf.xacro"))
    stiffness = [
        p.findtext("spring_stiffness") for p in soft.plugins("libTorsionalSpringPlugin.so")
    ]
    assert stiffness == ["40"] * 4


def test_an_unknown_color_is_refused_with_the_known_ones(tmp_path: pathlib.Path):
    text = (ROBOTS / "tsv1.urdf.xacro").read_text()
    (tmp_path / "odd.urdf.xacro").write_text(text.replace('color="orange"', 'color="mauve"'))
    done = run_xacro(tmp_path / "odd.urdf.xacro")
    assert done.returncode != 0 and not done.stdout
    assert 'unknown color "mauve"; expected one of: black, blue' in done.stderr
