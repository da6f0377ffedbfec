# SPDX-License-Identifier: MIT
"""Tests the expanded TerraSentia of every generation: names, masses, geometry, plugins."""
import pathlib
import shutil
import subprocess
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
from generations import GENERATIONS, Generation
from robot_urdf import Robot, numbers, pose
from xacro_runner import expand, mesh_path, read_stl, run_xacro

ROBOTS = pathlib.Path(__file__).resolve().parents[1] / "robots"
PLACES = ["front_left", "front_right", "rear_left", "rear_right"]
LEG_JOINTS = [f"{place}_leg_joint" for place in PLACES]
WHEEL_JOINTS = [f"{place}_wheel_rev" for place in PLACES]


def test_links_and_joints_have_the_names_of_the_thesis(robot: Robot, generation: Generation):
    sensors = generation.sensors | {f"encoder_{place}" for place in ("fr", "fl", "rr", "rl")}
    links = {"base_footprint", "base_footprint_mass_link", "lid_link"} | {
        f"{sensor}_link" for sensor in sensors
    }
    links |= {f"{place}_{part}_link" for place in PLACES for part in ("leg", "wheel")}
    assert {link for link in robot.links if not link.endswith("_optical_frame")} == links
    joints = set(LEG_JOINTS) | set(WHEEL_JOINTS) | {f"{sensor}_joint" for sensor in sensors}
    assert {j for j in robot.joints if "optical" not in j} == joints | {
        "lid_joint",
        "base_footprint_mass_joint",
    }
    assert set(robot.links) - set(robot.joint_of) == {"base_footprint"}
    assert robot.mass("base_footprint") == 0  # KDL warns of a root with an inertia
    assert {j.get("type") for n, j in robot.joints.items() if n in LEG_JOINTS} == {"revolute"}
    assert {j.get("type") for n, j in robot.joints.items() if n in WHEEL_JOINTS} == {"continuous"}


def test_check_urdf_accepts_it(robot: Robot, tmp_path: pathlib.Path):
    if shutil.which("check_urdf") is None:
        pytest.skip("check_urdf is not installed (liburdfdom-tools)")
    file = tmp_path / "robot.urdf"
    file.write_text(robot.text)
    done = subprocess.run(["check_urdf", str(file)], capture_output=True, text=True)
    assert done.returncode == 0 and "root Link: base_footprint has" in done.stdout


@pytest.mark.parametrize(
    "file, default",
    [("default_bot.urdf.xacro", "tsv1_default.urdf.xacro")]
    + [(f"ts{g.name}.urdf.xacro", g.file) for g in GENERATIONS],
)
def test_every_assembly_file_is_the_same_robot(file: str, default: str):
    robots = [expand(ROBOTS / name) for name in (file, default)]
    one, other = (ElementTree.canonicalize(text, strip_text=True) for text in robots)
    assert one == other


def test_it_weighs_what_the_sources_say(robot: Robot, generation: Generation):
    assert sum(robot.mass(link) for link in robot.links) == pytest.approx(generation.mass, abs=1e-9)
    assert min(robot.mass(link) for link in robot.bodies) > 0.002
    for place in PLACES:
        assert robot.mass(f"{place}_wheel_link") == generation.wheel_mass
        assert robot.mass(f"{place}_leg_link") == generation.leg_mass


@pytest.mark.parametrize("sensors", GENERATIONS, ids=lambda generation: generation.name)
def test_any_sensor_configuration_fits(generation: Generation, sensors: Generation):
    """Another robot's sensors stand in this robot's places."""
    file = f"ts{sensors.name}_sensors_config.urdf.xacro"
    mixed = Robot(expand(ROBOTS / generation.file, sensors=file))
    assert {f"{sensor}_link" for sensor in sensors.sensors} <= set(mixed.links)
    chassis = mixed.links["base_footprint"].find("collision/geometry/box").get("size")
    assert numbers(chassis) == pytest.approx(generation.chassis_box)
    length, width, height = generation.chassis_box
    for sensor in sensors.sensors - {"hokuyo", "gps"}:
        x, y, z = mixed.frame(f"{sensor}_link")[:3, 3]
        assert abs(x) < length / 2 + 0.08 and abs(y) < width / 2 + 0.08, sensor
        assert abs(z - generation.chassis_z) < height / 2 + 0.02, sensor


def test_a_sensor_configuration_can_be_given_by_its_path(robot: Robot, generation: Generation):
    file = ROBOTS.parent / f"config/ts{generation.name}_sensors_config.urdf.xacro"
    assert expand(ROBOTS / generation.file, sensors=str(file)) == robot.text


def test_a_sensor_configuration_that_does_not_exist_is_named():
    done = run_xacro(ROBOTS / "tsv2_default.urdf.xacro", sensors="no_sensors_config.urdf.xacro")
    assert done.returncode != 0 and not done.stdout
    assert "no_sensors_config.urdf.xacro" in done.stderr


def test_lidar_and_antenna_stand_on_the_lid(robot: Robot, generation: Generation):
    plate = robot.frame("lid_link") @ pose(robot.links["lid_link"].find("collision"))
    lid_top = plate[2, 3] + generation.lid_box[2] / 2
    assert plate[:2, 3] == pytest.approx([0, 0], abs=1e-9)
    assert plate[2, 3] - generation.lid_box[2] / 2 == pytest.approx(
        generation.chassis_z + generation.chassis_box[2] / 2
    )
    assert robot.frame("hokuyo_link")[2, 3] - 0.0474 == pytest.approx(lid_top, abs=1e-3)
    assert lid_top - 0.0065 < robot.frame("gps_link")[2, 3] < lid_top + 1e-3


def test_lenses_look_out_of_the_body(robot: Robot, generation: Generation):
    """A lens is outside the chassis, or so near to its wall that the camera's near plane lies beyond."""
    near_m = 0.03
    half = np.array(generation.chassis_box) / 2
    lenses = [link for link in robot.links if link.startswith("camera") and "optical" in link]
    assert len(lenses) == sum("camera" in s and s.count("_") < 2 for s in generation.sensors)
    for link in lenses:
        pose_of_lens = robot.frame(link)
        beyond = pose_of_lens[:3, 3] + near_m * pose_of_lens[:3, 2]  # z looks forward
        assert (np.abs(beyond - (0, 0, generation.chassis_z)) > half).any(), link


@pytest.mark.parametrize(
    "mode, size, rate_hz",
    [
        ("", ("640", "480"), 30),
        ("320x240@20", ("320", "240"), 20),
        ("640x480@120", ("640", "480"), 120),
        ("1920x1080@30", ("1920", "1080"), 30),
    ],
)
def test_the_cameras_have_the_modes_of_the_thesis(
    generation: Generation, mode: str, size: tuple, rate_hz: float
):
    arguments = {"camera_mode": mode} if mode else {}
    root = ElementTree.fromstring(expand(ROBOTS / generation.file, **arguments))
    cameras = root.findall(".//sensor[@type='camera']")
    assert len(cameras) == (2 if generation.name == "v1" else 3)
    for camera in cameras:
        assert (
            tuple(camera.findtext(f"camera/image/{side}") for side in ("width", "height")) == size
        )
        assert float(camera.findtext("update_rate")) == rate_hz
        assert float(camera.findtext("plugin/updateRate")) == rate_hz


def test_another_mode_of_the_cameras_is_refused(generation: Generation):
    done = run_xacro(ROBOTS / generation.file, camera_mode="800x600@60")
    assert done.returncode != 0 and not done.stdout
    assert 'found camera_mode "800x600@60", expected one of: 320x240@20, 640x480@30' in done.stderr


OWN_SENSORS = """<robot xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:include filename="$(find ardee_sensors)/urdf/all_sensors.urdf.xacro" />{more}
  <xacro:sensor_ueye_cp_gige name="camera" parent="base_footprint"{mode}>
    <origin xyz="${{MOUNT_CAMERA_FRONT}}" rpy="0 0 0" />
  </xacro:sensor_ueye_cp_gige>
</robot>"""


def test_sensors_of_ones_own_that_do_not_read_the_mode_are_told_what_to_include(
    generation: Generation, tmp_path: pathlib.Path
):
    file = tmp_path / "my_sensors.urdf.xacro"
    file.write_text(OWN_SENSORS.format(more="", mode=""))
    robot_file = ROBOTS / generation.file
    assert run_xacro(robot_file, sensors=str(file)).stderr == ""
    done = run_xacro(robot_file, sensors=str(file), camera_mode="1920x1080@30")
    include = "$(find terrasentia_description)/urdf/includes/camera_mode.urdf.xacro"
    assert done.returncode == 0 and done.stderr.splitlines()[0] == (
        f'warning: found camera_mode "1920x1080@30", which has no effect on the cameras of {file}; expected there: '
        f'include {include}, and cameras with width_px="${{CAMERA_WIDTH}}" height_px="${{CAMERA_HEIGHT}}" '
        'rate_hz="${CAMERA_RATE}"'
    )
    mode = ' width_px="${CAMERA_WIDTH}" height_px="${CAMERA_HEIGHT}" rate_hz="${CAMERA_RATE}"'
    more = f'\n  <xacro:include filename="{include}" />'
    file.write_text(OWN_SENSORS.format(more=more, mode=mode))
    text = expand(robot_file, sensors=str(file), camera_mode="1920x1080@30")
    assert ElementTree.fromstring(text).findtext(".//camera/image/width") == "1920"


def test_a_base_configuration_may_leave_out_the_places_of_meshes(
    generation: Generation, tmp_path: pathlib.Path
):
    """The first robot's lid has a frame of its own, so its place is needed."""
    config = ROBOTS.parent / f"config/ts{generation.name}_config.urdf.xacro"
    words = ["WHEEL_SCALE", "WHEEL_MESH_OFFSET"] + ["LID_PLACE"] * (generation.name != "v1")
    kept = [
        line
        for line in config.read_text().splitlines()
        if not any(f'name="{word}"' in line for word in words)
    ]
    (tmp_path / "config.urdf.xacro").write_text("\n".join(kept))
    text = (ROBOTS / f"ts{generation.name}.urdf.xacro").read_text()
    find = f"$(find terrasentia_description)/config/{config.name}"
    assert find in text and len(kept) == len(config.read_text().splitlines()) - len(words)
    old = tmp_path / "robot.urdf.xacro"
    old.write_text(text.replace(find, str(tmp_path / "config.urdf.xacro")))
    robots = [expand(file) for file in (old, ROBOTS / f"ts{generation.name}.urdf.xacro")]
    one, other = (ElementTree.canonicalize(each, strip_text=True) for each in robots)
    assert one == other


def test_encoders_measure_their_wheels(robot: Robot, generation: Generation):
    encoders = robot.plugins("libardee_ros_encoder.so")
    found = {e.findtext("encoderTopic"): e.findtext("joint") for e in encoders}
    assert found == {
        "ardee/encoder/fr": "front_right_wheel_rev",
        "ardee/encoder/fl": "front_left_wheel_rev",
        "ardee/encoder/rr": "rear_right_wheel_rev",
        "ardee/encoder/rl": "rear_left_wheel_rev",
    }
    for encoder in encoders:
        assert float(encoder.findtext("pulsesPR")) == 3416
        assert float(encoder.findtext("wheelDiameter")) == pytest.approx(0.194)
        wheel = encoder.findtext("joint").replace("rev", "link")
        short = encoder.findtext("encoderTopic")[-2:]
        offset = robot.frame(wheel)[:3, 3] - robot.frame(f"encoder_{short}_link")[:3, 3]
        assert offset[[0, 2]] == pytest.approx([0, 0], abs=1e-9)  # on the axle


def test_inertias_are_physical(robot: Robot):
    for link in robot.bodies:
        moments = np.linalg.eigvalsh(robot.inertia(link))
        assert moments[0] > 0, link
        assert moments[2] <= moments[0] + moments[1], link
        # A body inside its own reach has no moment above mass * (half the robot's length)^2.
        assert moments[2] < robot.mass(link) * 0.3**2, link


def test_a_wheel_turns_about_its_axle_as_the_sources_say(robot: Robot, generation: Generation):
    for place in PLACES:
        link = f"{place}_wheel_link"
        turned = pose(robot.links[link].find("inertial"))[:3, :3]
        about_axle = np.array([0, 1, 0]) @ turned @ robot.inertia(link) @ turned.T @ [0, 1, 0]
        assert about_axle == pytest.approx(generation.wheel_about_axle)


def test_collision_shapes_have_the_dimensions_of_the_sources(robot: Robot, generation: Generation):
    chassis = robot.links["base_footprint"].find("collision")
    assert numbers(chassis.find("geometry/box").get("size")) == pytest.approx(
        generation.chassis_box
    )
    assert pose(chassis)[2, 3] == pytest.approx(generation.chassis_z)
    for place in PLACES:
        collision = robot.links[f"{place}_wheel_link"].find("collision")
        cylinder = collision.find("geometry/cylinder")
        assert float(cylinder.get("radius")) == 0.097
        assert float(cylinder.get("length")) == generation.wheel_depth
        assert abs(pose(collision)[:3, 2]) == pytest.approx([0, 1, 0])  # its axis is the axle


def test_wheel_surface(robot: Robot):
    for place in PLACES:
        blocks = robot.root.findall(f"gazebo[@reference='{place}_wheel_link']")
        values = {child.tag: child.text for block in blocks for child in block}
        assert (float(values["mu1"]), float(values["mu2"])) == (0.75, 0.75)
        assert (float(values["kp"]), float(values["kd"])) == (1e6, 100)
        assert (values["fdir1"], values["frictionCone"]) == ("0 0 1", "true")


def test_meshes_exist_and_fill_their_collision_shapes(robot: Robot, generation: Generation):
    boxes = {"base_footprint": generation.chassis_mesh, "lid_link": generation.lid_box}
    for name, link in robot.links.items():
        mesh = link.find("visual/geometry/mesh")
        if mesh is None:
            continue
        corners = read_stl(mesh_path(mesh.get("filename"))).reshape(-1, 3)
        corners *= numbers(mesh.get("scale", "1 1 1"))
        assert np.abs(corners).max() < 0.3, name
        if name in boxes:
            assert np.ptp(corners, axis=0) == pytest.approx(boxes[name], abs=1e-6)
            assert corners.max(axis=0) == pytest.approx(-corners.min(axis=0), abs=1e-6)
        if name.endswith("wheel_link"):
            assert np.hypot(corners[:, 0], corners[:, 2]).max() == pytest.approx(0.097, abs=1e-4)
            place = pose(link.find("visual"))
            across = (corners @ place[:3, :3].T + place[:3, 3])[:, 1]
            middle = pose(link.find("collision"))[1, 3]
            ends = (middle - generation.wheel_depth / 2, middle + generation.wheel_depth / 2)
            assert (across.min(), across.max()) == pytest.approx(ends, abs=1e-4)


def leg_springs(robot: Robot) -> list:
    """Returns the springs of the legs, without those of gimbals."""
    springs = robot.plugins("libTorsionalSpringPlugin.so")
    return [s for s in springs if "gimbal" not in s.findtext("joint_handle")]


def test_spring_plugins_name_their_joints_and_limits(robot: Robot, generation: Generation):
    springs = leg_springs(robot)
    assert sorted(spring.findtext("joint_handle") for spring in springs) == LEG_JOINTS
    for spring in springs:
        limit = robot.joints[spring.findtext("joint_handle")].find("limit")
        assert spring.findtext("lower_limit") == limit.get("lower")
        assert spring.findtext("upper_limit") == limit.get("upper")
        assert float(limit.get("upper")) - float(limit.get("lower")) == pytest.approx(
            generation.leg_travel
        )
        values = [float(spring.findtext(f"spring_{k}")) for k in ("stiffness", "damping")]
        assert values == [generation.stiffness, 1]
        if not generation.appears_at_rest:
            assert float(spring.findtext("spring_reference")) == 0
        assert spring.findtext("verbose") == "false"


def test_drive_plugin_fits_the_robot(robot: Robot, generation: Generation):
    (drive,) = robot.plugins("libgazebo_ros_skid_steer_drive.so")
    for side in ("left", "right"):
        for end, word in (("front", "Front"), ("rear", "Rear")):
            assert drive.findtext(f"{side}{word}Joint") == f"{end}_{side}_wheel_rev"
    assert float(drive.findtext("wheelSeparation")) == 0.4318
    assert float(drive.findtext("wheelDiameter")) == 0.194
    assert float(drive.findtext("torque")) == generation.torque
    assert float(drive.findtext("updateRate")) == 50
    assert drive.findtext("robotBaseFrame") == "base_footprint"
    assert (drive.findtext("odometryFrame"), drive.findtext("broadcastTF")) == ("odom", "true")


def test_all_moving_joints_are_published(robot: Robot):
    states = robot.plugins("libgazebo_ros_joint_state_publisher.so")
    names = [name.strip() for s in states for name in s.findtext("jointName").split(",")]
    moving = [name for name, joint in robot.joints.items() if joint.get("type") != "fixed"]
    assert sorted(names) == sorted(moving)
    assert set(LEG_JOINTS + WHEEL_JOINTS) <= set(names)


@pytest.mark.parametrize(
    "ns, expected", [("", "/"), ("robot2", "/robot2"), ("/robot2/", "/robot2")]
)
def test_the_namespace_reaches_every_plugin_that_publishes(
    generation: Generation, ns: str, expected: str
):
    root = ElementTree.fromstring(expand(ROBOTS / generation.file, ns=ns))
    publishers = [p for p in root.iter("plugin") if "Spring" not in p.get("filename")]
    # These are drive, joint states, lidar, IMU, GPS, battery, four encoders, and at least a camera.
    assert len(publishers) > 10
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
    stiffness = [spring.findtext("spring_stiffness") for spring in leg_springs(soft)]
    assert stiffness == ["40"] * 4


def test_an_unknown_color_is_refused_with_the_known_ones(tmp_path: pathlib.Path):
    text = (ROBOTS / "tsv1.urdf.xacro").read_text()
    (tmp_path / "odd.urdf.xacro").write_text(text.replace('color="orange"', 'color="mauve"'))
    done = run_xacro(tmp_path / "odd.urdf.xacro")
    assert done.returncode != 0 and not done.stdout
    assert 'unknown color "mauve"; expected one of: black, blue' in done.stderr
