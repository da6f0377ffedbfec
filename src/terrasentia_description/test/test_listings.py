# SPDX-License-Identifier: MIT
"""Tests that the thesis's Listings A.11, A.13 and A.25, as they are printed, describe the robots that are here."""
import pathlib
import re
import xml.etree.ElementTree as ElementTree

import pytest
from robot_urdf import Robot, numbers, pose
from xacro_runner import SOURCES, expand, mesh_path, read_stl

LISTINGS = SOURCES.parent / "tests/data/listings"
LEG_CALL = """<robot name="legs" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:include filename="{file}" />
  <link name="base_link" />
  <xacro:leg_type_1 prefix="rear" suffix="left" color="orange" min="-0.5" max="0.1" damping="2" stiffness="50"
    spring_reference="-0.2" reflect="1" stl="package://terrasentia_description/meshes/v1/leg_type_1.STL">
    <origin xyz="0.08 0.01 0.015" rpy="0 0 0" />
  </xacro:leg_type_1>
</robot>"""


@pytest.fixture(scope="module")
def printed() -> Robot:
    """Returns the robot of Listing A.13."""
    return Robot(expand(LISTINGS / "a_13.urdf.xacro"))


def place_of_body(robot: Robot, link: str, tag: str) -> tuple:
    """Returns the pose of a link's visual or collision in the chassis, as a list."""
    return tuple((robot.frame(link) @ pose(robot.links[link].find(tag))).ravel())


def test_the_robot_of_listing_a_13_has_our_first_robot_s_bodies_in_their_places(printed: Robot):
    """The printed angles have five digits, and -3.154 is half a turn."""
    ours = Robot(expand(SOURCES / "terrasentia_description/robots/tsv1.urdf.xacro"))
    assert set(printed.links) == set(ours.links)
    assert set(printed.joints) == set(ours.joints)
    for link in printed.bodies:
        assert place_of_body(printed, link, "collision") == pytest.approx(
            place_of_body(ours, link, "collision"), abs=1e-4
        )
        assert place_of_body(printed, link, "visual") == pytest.approx(
            place_of_body(ours, link, "visual"), abs=0.013
        )
        assert printed.mass(link) == pytest.approx(ours.mass(link))


def test_the_lid_of_listing_a_13_lies_on_the_chassis(printed: Robot):
    assert printed.frame("lid_link")[:3, 3] == pytest.approx([0.23525, 0.0214, -0.2085])
    lid = printed.links["lid_link"].find("visual")
    corners = read_stl(mesh_path(lid.find("geometry/mesh").get("filename"))).reshape(-1, 3)
    middle = (printed.frame("lid_link") @ pose(lid))[:3, 3]
    top_of_chassis_m = 0.04545 + 0.13136 / 2  # Listing A.11
    assert corners.min(axis=0) + middle == pytest.approx(
        [-0.508 / 2, -0.35322 / 2, top_of_chassis_m], abs=1e-6
    )


def test_the_wheels_of_listing_a_13_are_in_inches(printed: Robot):
    mesh = printed.links["rear_left_wheel_link"].find("visual/geometry/mesh")
    assert numbers(mesh.get("scale")) == pytest.approx([0.0254] * 3)
    corners_in = read_stl(mesh_path(mesh.get("filename"))).reshape(-1, 3)
    assert abs(corners_in[:, 0]).max() == pytest.approx(0.097 / 0.0254, abs=0.01)


def leg(folder: pathlib.Path, file: str) -> ElementTree.Element:
    """Returns a robot with one leg of the macro in the file."""
    call = folder / "legs.urdf.xacro"
    call.write_text(LEG_CALL.format(file=file))
    return ElementTree.fromstring(expand(call))


def test_the_leg_of_listing_a_25_takes_its_arguments(tmp_path: pathlib.Path):
    root = leg(tmp_path, "$(find terrasentia_description)/urdf/leg_type_1.urdf.xacro")
    joint = root.find("joint[@name='rear_left_leg_joint']")
    assert joint.find("parent").get("link") == "base_link"
    assert (joint.find("limit").get("lower"), joint.find("limit").get("upper")) == ("-0.5", "0.1")
    assert joint.find("axis").get("xyz") == "0 1 0"
    place = numbers(joint.find("origin").get("xyz"))
    assert place == pytest.approx([9.5 * 0.13031, 0.04356, 0.03553])
    spring = {child.tag: child.text for child in root.find(".//plugin")}
    assert spring == {
        "joint_handle": "rear_left_leg_joint",
        "spring_stiffness": "50",
        "spring_damping": "2",
        "spring_reference": "-0.2",
        "verbose": "False",
    }


def test_the_leg_of_listing_a_25_is_the_one_here(tmp_path: pathlib.Path):
    ours = leg(tmp_path, "$(find terrasentia_description)/urdf/leg_type_1.urdf.xacro")
    printed = leg(tmp_path, str(LISTINGS / "a_25.urdf.xacro"))
    one, other = (ElementTree.tostring(root, encoding="unicode") for root in (ours, printed))
    assert ElementTree.canonicalize(one, strip_text=True) == ElementTree.canonicalize(
        other, strip_text=True
    )


def test_the_numbers_of_listing_a_11_are_ours(tmp_path: pathlib.Path):
    """Sizes are in another order: the listing's meshes had y forward."""
    listing = LISTINGS / "a_11.urdf.xacro"
    names = re.findall(r'property name="(\w+)"', listing.read_text())
    assert len(names) == 20
    ours = SOURCES / "terrasentia_description/config/tsv1_config.urdf.xacro"
    links = '<xacro:include filename="$(find terrasentia_description)/urdf/links_v1.urdf.xacro" />'
    values = []
    for number, include in enumerate((listing, ours)):
        file = tmp_path / f"{number}.urdf.xacro"
        told = " ".join(f'{name}="${{{name}}}"' for name in names)
        file.write_text(
            f'<robot xmlns:xacro="http://ros.org/wiki/xacro">{links}<xacro:include filename="{include}" />'
            f"<numbers {told} /></robot>"
        )
        values.append(ElementTree.fromstring(expand(file)).find("numbers").attrib)
    for name in ("CHASSIS_SIZE", "LID_SIZE"):
        y, x, z = values[0][name].split()
        values[0][name] = " ".join((x, y, z))
    assert values[0] == values[1]


def test_the_chassis_of_listing_a_10_and_of_the_third_generation(tmp_path: pathlib.Path):
    include = '<xacro:include filename="$(find terrasentia_description)/'
    calls = {
        2: '<xacro:chassis_v2 name="body" stl_chassis="${chassis_stl}" stl_lid="${lid_stl}" color="grey" />',
        3: '<xacro:chassis_v3 name="body" stl="${chassis_stl}" size="${CHASSIS_SIZE}" z_offset="0" color="grey" />',
    }
    for number, call in calls.items():
        file = tmp_path / f"{number}.urdf.xacro"
        file.write_text(
            '<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">'
            f'{include}urdf/links_v{number}.urdf.xacro" />'
            f'{include}config/tsv{number}_config.urdf.xacro" />{call}</robot>'
        )
        robot = Robot(expand(file))
        assert robot.joint_of["body_mass_link"].find("parent").get("link") == "body"
        assert robot.mass("body_mass_link") > 1
