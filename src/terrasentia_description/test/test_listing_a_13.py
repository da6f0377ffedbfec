# SPDX-License-Identifier: MIT
"""Tests a robot that is assembled as in Listing A.13 of the thesis, with the listing's macro calls and arguments."""
import pathlib

from robot_urdf import Robot
from xacro_runner import expand

LEG_AXIS = '<axis xyz="0 0 -1" />'


def leg(kind: int, place: str, reflect: int, limits: str, axis: str = LEG_AXIS) -> str:
    prefix, suffix = place.split("_")
    return f"""
  <xacro:leg_type_{kind} prefix="{prefix}" suffix="{suffix}" stl="${{leg{kind}_stl}}" color="orange" />
  <xacro:attach_leg_type_{kind} parent="base_footprint" link="{place}_leg" reflect="{reflect}" {limits}
    stiffness="${{susp_stiffness}}" damping="${{susp_damping}}" reference="${{susp_reference}}">
    {axis}
  </xacro:attach_leg_type_{kind}>"""


def wheel(place: str, reflect: int, roll: float, x: float, yaw: float) -> str:
    prefix, suffix = place.split("_")
    short = (place[0] + suffix[0]).upper()
    return f"""
  <xacro:wheel prefix="{prefix}" suffix="{suffix}" stl="${{wheel_stl}}" color="grey" radius="${{WHEEL_RADIUS}}"
    depth="${{WHEEL_DEPTH}}" reflect="{reflect}" friction="${{{short}_WHEEL_FRICTION}}" scale="0.0254">
    <origin xyz="0 ${{{-reflect} * WHEEL_DEPTH}} 0" rpy="0 0 0" />
  </xacro:wheel>
  <xacro:attach_wheel_leg prefix="{prefix}" suffix="{suffix}">
    <origin xyz="{x} 0.023246 0.0254775" rpy="{roll} 0 {yaw}" />
    <axis xyz="0 1 0" />
  </xacro:attach_wheel_leg>"""


LISTING = f"""<robot name="TSv1" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:include filename="$(find terrasentia_description)/urdf/links_v1.urdf.xacro" />
  <xacro:include filename="$(find terrasentia_description)/urdf/joints_v1.urdf.xacro" />
  <xacro:include filename="$(find terrasentia_description)/config/tsv1_config.urdf.xacro" />
  <xacro:include filename="$(find terrasentia_description)/config/tsv1_sensors_config.urdf.xacro" />
  <xacro:chassis_v0 name="base_footprint" stl="${{chassis_stl}}" size="${{CHASSIS_SIZE}}" z_offset="${{CHASSIS_OFFSET}}"
    color="grey" />
  <xacro:lid stl="${{lid_stl}}" size="${{LID_SIZE}}" z_offset="${{LID_OFFSET}}" color="grey" />
  <xacro:attach_lid parent="base_footprint">
    <origin xyz="0.23525 0.0214 -0.2085" rpy="0 0 0" />
  </xacro:attach_lid>
  {leg(1, "front_right", -1, 'min="-0.682" max="0"')}
  {leg(1, "rear_left", 1, 'min="-0.682" max="0"')}
  {leg(2, "front_left", 1, 'min="0" max="0.682"')}
  {leg(2, "rear_right", -1, 'min="-0.682" max="0"', '<axis xyz="0 0 1" />')}
  {wheel("front_right", 1, -1.5708, 0.1601, 0.95382)}
  {wheel("front_left", -1, 1.5708, -0.1601, 2.18777)}
  {wheel("rear_right", 1, -1.5708, -0.1601, -0.95382)}
  {wheel("rear_left", -1, 1.5708, 0.1601, 4.09542)}
</robot>"""


def test_the_calls_of_the_listing_make_a_robot(tmp_path: pathlib.Path):
    file = tmp_path / "old.urdf.xacro"
    file.write_text(LISTING)
    robot = Robot(expand(file))
    ends = [f"{a}_{b}" for a in ("front", "rear") for b in ("left", "right")]
    wanted = {f"{end}_{what}" for end in ends for what in ("leg_joint", "wheel_rev")}
    assert wanted | {"lid_joint", "hokuyo_joint", "battery_joint"} <= set(robot.joints)
    assert len(robot.plugins("libTorsionalSpringPlugin.so")) == 4
    mass = robot.links["base_footprint_mass_link"].find("inertial/mass").get("value")
    assert 2 < float(mass) < 3  # rest of the configuration's mass, for the chassis


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
        assert "body_mass_link" in Robot(expand(file)).bodies
