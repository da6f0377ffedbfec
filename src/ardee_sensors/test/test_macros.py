# SPDX-License-Identifier: MIT
"""Tests every macro on a bare link: called with name, parent and origin alone, and all at once, each twice."""
import math
import pathlib
import re
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
from device_numbers import CONFIG, devices, expected_topics, load, read_numbers
from macro_calls import call, complaint, of, robot, topics, write_robot
from xacro_runner import SOURCES, expand, mesh_path, run_xacro

URDF = SOURCES / "ardee_sensors/urdf"
LIDARS = [device for device in devices() if load(device)["kind"].startswith("lidar")]
CAMERAS = [device for device in devices() if load(device)["kind"] in ("camera", "rgbd", "stereo")]
TABLE_3_1 = """gps gps_with_dropout gps_with_mast imu_hector imu_terra hokuyo_urg04lx hokuyo_ust10lx hokuyo_utm30lx
    sick_s300 sick_s3000 sick_tim571 rplidar hokuyo3d axis_m5013 axis ueye_cp_gige asus_xtion_pro kinect kinectv2
    fotonic orbbec_astra sonar approx_battery encoder""".split()
BEYOND = "imu imu_ardee imu_bno055 magnetometer vlp16 hdl32e realsense_d435 zed2".split()
# Numbers that shape the body, the mesh and the frames: with others it would be another device.
OF_THE_BODY = re.compile(
    r"(\w+_)?size_[xyz]_m|scan_height_m|window_height_m|turret_\w+|lens_\w+|frame_z_m|tilt_axis_z_m|"
    r"(foot|head)_height_m|(head|yoke)_mass_kg"
)


@pytest.fixture(scope="module")
def everything(tmp_path_factory: pytest.TempPathFactory) -> ElementTree.Element:
    """Returns a robot with every sensor twice, `<device>.1` and `<device>.2`."""
    calls = [call(device, f"{device}.{i}") for device in devices() for i in (1, 2)]
    return robot(tmp_path_factory.mktemp("everything"), "\n".join(calls))


def test_the_devices_are_those_of_the_table_and_eight_more():
    assert sorted(TABLE_3_1 + BEYOND) == devices()


def test_all_of_table_3_1_fits_on_one_robot(tmp_path: pathlib.Path):
    root = robot(tmp_path, "\n".join(call(device, device) for device in TABLE_3_1))
    names = [e.get("name") for tag in ("link", "joint") for e in root.findall(tag)]
    assert len(names) == len(set(names))
    assert len(list(root.iter("plugin"))) >= len(TABLE_3_1)


def test_names_of_two_of_a_kind_do_not_collide(everything: ElementTree.Element):
    for tag in ("link", "joint", "sensor", "plugin"):
        names = [e.get("name") for e in everything.iter(tag) if e.get("name")]
        assert len(names) == len(set(names)) and names
    assert topics(everything)  # fails if one occurs twice


def test_the_robot_s_namespace_reaches_every_plugin(tmp_path: pathlib.Path):
    calls = "\n".join(call(device, device) for device in devices())
    named = '<xacro:property name="robot_namespace" value="/robot2" />'
    root = robot(tmp_path, named + calls)
    assert {plugin.findtext("robotNamespace") for plugin in root.iter("plugin")} == {"/robot2"}


@pytest.mark.parametrize("device", devices())
def test_topics_are_those_of_its_file(everything: ElementTree.Element, device: str):
    name = f"{device}.1"
    published = {t for t, plugin in topics(everything).items() if plugin.startswith(name)}
    expected = set(expected_topics(device, name))
    if load(device)["kind"] in ("rgbd", "stereo"):
        assert expected <= published  # infrared and similar topics come in addition
    else:
        assert expected == published


@pytest.mark.parametrize("device", devices())
def test_frames_exist(everything: ElementTree.Element, device: str):
    name = f"{device}.1"
    links = {link.get("name") for link in everything.iter("link")}
    assert f"{name}_link" in links
    for _, frame in expected_topics(device, name).values():
        assert frame in ("", "world") or frame in links
    plugins = [p for p in everything.iter("plugin") if p.get("name").startswith(name)]
    assert plugins
    for plugin in plugins:
        for key in ("frameName", "frameId", "bodyName", "batteryLink"):
            assert plugin.find(key) is None or plugin.findtext(key) in links
    for block in everything.findall("gazebo"):
        assert block.get("reference") is None or block.get("reference") in links


@pytest.mark.parametrize("device", devices())
def test_bodies_are_possible(everything: ElementTree.Element, device: str):
    """Masses above zero add up to the device's, and principal moments obey the triangle inequality."""
    total = 0.0
    for link in of(everything, "link", f"{device}.1"):
        inertial = link.find("inertial")
        if inertial is None:
            assert link.find("visual") is None and link.find("collision") is None
            continue
        total += float(inertial.find("mass").get("value"))
        values = inertial.find("inertia")
        xx, yy, zz, xy, xz, yz = (
            float(values.get(k)) for k in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
        )
        moments = np.linalg.eigvalsh([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        assert moments[0] > 0
        assert moments[0] + moments[1] >= moments[2] * (1 - 1e-9)
    numbers = dict(load(device))
    for other in numbers.get("also", "").split():
        numbers = {**load(other), **numbers}
    assert total == pytest.approx(numbers["mass_kg"] + numbers.get("mast_mass_kg", 0))


@pytest.mark.parametrize("device", devices())
def test_its_mesh_is_there_and_its_visuals_have_colours(
    everything: ElementTree.Element, device: str
):
    links = of(everything, "link", f"{device}.1")
    visuals = [visual for link in links for visual in link.findall("visual")]
    assert visuals
    for visual in visuals:
        assert visual.find("material/color") is not None
        mesh = visual.find("geometry/mesh")
        assert mesh is None or mesh_path(mesh.get("filename")).is_file()


@pytest.mark.parametrize("device", CAMERAS)
def test_optical_frames_look_along_the_link(everything: ElementTree.Element, device: str):
    """REP 103 asks that z of the optical frame be x of the link, x right, y down."""
    joints = [j for j in of(everything, "joint", f"{device}.1") if "optical_frame" in j.get("name")]
    assert joints
    for joint in joints:
        roll, pitch, yaw = map(float, joint.find("origin").get("rpy").split())
        assert (roll, pitch, yaw) == pytest.approx((-math.pi / 2, 0, -math.pi / 2))
        assert joint.find("parent").get("link") == f"{device}.1_link"


@pytest.fixture(scope="module")
def lidars(tmp_path_factory: pytest.TempPathFactory) -> ElementTree.Element:
    """Returns a robot with every lidar: with its defaults, plain, and with more rays per beam."""
    calls = [
        call(device, f"{device}.{name}", arguments)
        for device in LIDARS
        for name, arguments in (
            ("a", ""),
            ("b", 'plain="true"'),
            ("c", 'sub_rays="5" sub_rays_at="everywhere"'),
        )
    ]
    return robot(tmp_path_factory.mktemp("lidars"), "\n".join(calls))


@pytest.mark.parametrize("device", LIDARS)
def test_plain_switches_the_realism_off(lidars: ElementTree.Element, device: str):
    keys = ("intensityModel", "reflectivityRange", "detectionNoise", "noiseGrowth")
    keys += ("beamDivergence", "subRays", "subRaysAt")
    numbers = load(device)
    plugins = [p for p in lidars.iter("plugin") if p.get("name").startswith(f"{device}.")]
    real, plain, many = ([p.findtext(k) for k in keys] for p in plugins)
    of_the_device = [
        numbers[k]
        for k in (
            "reflectivity_range_m",
            "detection_noise",
            "noise_growth_m_per_m",
            "beam_divergence_rad",
        )
    ]
    assert real[0] == many[0] == "lambert"
    assert [float(v) for v in real[1:5]] == of_the_device
    assert plain[:6] == ["plain", "0", "0", "0", "0", "1"]
    assert real[5:] == [str(numbers["sub_rays"]), "mixing"] and numbers["sub_rays"] > 2
    assert many[5:] == ["5", "everywhere"]


@pytest.mark.parametrize("device", devices())
def test_every_number_is_an_argument(device: str):
    text = (URDF / f"{device}.urdf.xacro").read_text()
    arguments = re.search(rf'<xacro:macro name="sensor_{device}"\s+params="([^"]*)"', text).group(1)
    for number in read_numbers(CONFIG / f"{device}.yaml"):
        if not OF_THE_BODY.fullmatch(number.key) and not number.key.startswith(
            ("rate_noise", "accel_noise")
        ):
            assert re.search(rf":=\$\{{\w+_numbers\.{number.key}\}}", arguments), number.key


def test_a_block_laser_is_one_argument_away(tmp_path: pathlib.Path):
    root = robot(tmp_path, call("hokuyo3d", "a", 'pointcloud2="false"'))
    assert root.find(".//sensor").get("type") == "ray"
    assert root.find(".//plugin").get("filename") == "libgazebo_ros_block_laser.so"


def test_a_lens_bends_image_and_camera_info_alike(tmp_path: pathlib.Path):
    calls = call("ueye_cp_gige", "a", 'k1="-0.404" k2="0.1"') + call("ueye_cp_gige", "b")
    bent, straight = robot(tmp_path, calls).iter("sensor")
    assert bent.findtext("camera/distortion/k1") == bent.findtext("plugin/distortionK1") == "-0.404"
    assert straight.find("camera/distortion") is None
    assert float(straight.findtext("plugin/distortionK1")) == 0


@pytest.mark.parametrize("device", ["axis", "axis_m5013"])
def test_servos_lead_pan_and_tilt_unless_told_not_to(tmp_path: pathlib.Path, device: str):
    root = robot(tmp_path, call(device, "a") + call(device, "b", 'position_control="false"'))
    servos = [p for p in root.iter("plugin") if "joint_position" in p.get("filename")]
    found = {servo.findtext("joint"): servo.findtext("commandTopic") for servo in servos}
    assert found == {
        f"a_{way}_joint": f"ardee/a/{way}_position_controller/command" for way in ("pan", "tilt")
    }
    numbers = load(device)
    for servo in servos:
        limit = root.find(f"joint[@name='{servo.findtext('joint')}']/limit")
        assert float(limit.get("velocity")) == numbers["velocity_limit_rad_s"]
        assert float(servo.findtext("maxAcceleration")) == numbers["acceleration_limit_rad_s2"]
    camera = root.find(".//sensor[@name='a_sensor']/plugin")
    zoom = [float(camera.findtext(f"horizontalFov{end}")) for end in ("Min", "Max")]
    keys = ("horizontal_fov_min_deg", "horizontal_fov_deg")
    assert zoom == pytest.approx([math.radians(numbers[key]) for key in keys])


@pytest.mark.parametrize("device, encoding", [("realsense_d435", "mono8"), ("kinectv2", "16UC1")])
def test_infrared_images_beside_coloured_clouds(tmp_path: pathlib.Path, device: str, encoding: str):
    """The cloud has the colours of the colour stream, as with the devices' drivers."""
    depth = robot(tmp_path, call(device, "a")).find(".//sensor[@type='depth']")
    assert depth.findtext("camera/image/format") == "R8G8B8"
    assert depth.findtext("plugin/imageEncoding") == encoding


def test_the_stereo_baseline_is_in_poses_and_camera_info(tmp_path: pathlib.Path):
    root = robot(tmp_path, call("zed2", "a", 'baseline_m="0.2"'))
    sensor = root.find(".//sensor[@type='multicamera']")
    poses = {c.get("name"): float(c.findtext("pose").split()[1]) for c in sensor.findall("camera")}
    assert poses == {"left": 0.1, "right": -0.1}
    assert sensor.findtext("plugin/hackBaseline") == "0.2"


def test_the_battery_s_two_modes(tmp_path: pathlib.Path):
    calls = call("approx_battery", "a") + call("approx_battery", "b", 'mode="current"')
    quick, current = robot(tmp_path, calls).iter("plugin")
    assert quick.find("deltaVoltage") is not None and quick.find("constantCoef") is None
    assert current.find("deltaVoltage") is None and current.findtext("commandTopic") == "cmd_vel"


@pytest.mark.parametrize(
    "device, arguments, message",
    [
        ("approx_battery", 'mode="slow"', 'unknown mode "slow"'),
        ("kinect", 'color="mauve"', 'unknown color "mauve"'),
        ("vlp16", 'ranges="3"', "ranges"),
    ],
)
def test_a_wrong_call_is_refused(tmp_path: pathlib.Path, device: str, arguments: str, message: str):
    assert message in complaint(tmp_path, call(device, "a", arguments))


@pytest.mark.parametrize("device", sorted(set(devices()) - {"approx_battery", "encoder"}))
def test_a_sensor_of_zero_rate_is_left_out_with_a_message(tmp_path: pathlib.Path, device: str):
    """The simulator gives the message for encoder and battery; for other plugins 0 means each step, as in Gazebo."""
    rate = "update_rate" if load(device)["kind"] in ("gps", "imu", "magnetometer") else "rate_hz"
    calls = call(device, "bad", f'{rate}="0"') + call("sonar", "good")
    done = run_xacro(write_robot(tmp_path, calls))
    root = ElementTree.fromstring(done.stdout)
    assert not of(root, "sensor", "bad")
    assert all(topic.startswith("ardee/good") for topic in topics(root))
    assert root.find("link[@name='bad_link']") is not None
    (said,) = [line for line in done.stderr.splitlines() if "left out" in line]
    assert 'sensor "bad' in said and re.search(r"found (a rate of 0 Hz|rate_hz 0)", said)
    assert "deprecated" not in done.stderr


def test_a_mass_of_zero_is_no_inertia(tmp_path: pathlib.Path):
    domes = [device for device in devices() if "yoke_mass_kg" in load(device)]
    calls = [call(device, device, 'mass_kg="0"') for device in devices() if device not in domes]
    root = robot(tmp_path, "".join(calls))
    masses = [(link.get("name"), link.find("inertial")) for link in root.iter("link")]
    assert [name for name, inertial in masses if inertial is not None] == [
        "gps_with_mast_mast_link"
    ]
    said = complaint(tmp_path, call(domes[0], "a", 'mass_kg="0.1"'))
    assert 'found mass_kg 0.1 of sensor "a"; expected at least 0.55' in said


def test_what_a_camera_in_motion_sees_is_a_key_of_its_plugins(tmp_path: pathlib.Path):
    given = 'exposure_time_s="0.01" readout_time_s="0.02" white_balance="5600"'
    keys = {"exposureTime": "0.01", "readoutTime": "0.02", "whiteBalance": "5600"}
    for device in ("ueye_cp_gige", "zed2", "realsense_d435"):
        root = robot(tmp_path, call(device, "a", given) + call(device, "b"))
        for sensor in root.iter("sensor"):
            found = {key: sensor.findtext(f"plugin/{key}") for key in keys}
            assert found == (keys if sensor.get("name").startswith("a") else dict.fromkeys(keys))


TWO_CAMERAS = ("zed2", "realsense_d435", "kinectv2")
IMPOSSIBLE = {  # argument and value: the `expected` part of the message
    ("rate_hz", "-30"): "more than 0",
    ("rate_hz", "often"): "more than 0",
    ("rate_hz", "inf"): "more than 0",
    ("width_px", "640.5"): "a whole number from 1 to 8192",
    ("height_px", "0"): "a whole number from 1 to 8192",
    ("horizontal_fov_deg", "180"): "more than 0 and less than 180",
    ("noise_std", "-0.1"): "0 or more",
    ("exposure", "0"): "auto, or more than 0",
    ("exposure_time_s", "2"): "a number from 0 to 1",
    ("readout_time_s", "-0.1"): "a number from 0 to 1",
    ("clip_far_m", "0.01"): "more than clip_near_m",
    ("depth_max_m", "0.1"): "more than depth_min_m",
}
OF_ONE = {
    ("zed2", "baseline_m", "-1"): "more than 0",
    ("zed2", "baseline_m", "wide"): "more than 0",
    ("realsense_d435", "rgb_width_px", "-1280"): "a whole number from 1 to 8192",
    ("kinectv2", "rgb_horizontal_fov_deg", "0"): "more than 0 and less than 180",
    ("kinectv2", "rgb_offset_y_m", "left"): "a number",
}


def test_two_cameras_of_one_device_say_once_what_cannot_be(tmp_path: pathlib.Path):
    """Both cameras are left out; the body and the rest of the robot remain."""
    wrong = {(device, *key): said for device in TWO_CAMERAS for key, said in IMPOSSIBLE.items()}
    wrong.update(OF_ONE)
    calls = [call(key[0], f"bad{i}", f'{key[1]}="{key[2]}"') for i, key in enumerate(wrong)]
    done = run_xacro(write_robot(tmp_path, "".join(calls) + call("sonar", "good")))
    assert done.returncode == 0, done.stderr
    said = [line for line in done.stderr.splitlines() if "left out" in line]
    assert said == [
        f'warning: sensor "bad{i}" (sensor_{device}) is left out: found {argument} {value}, expected {expected}'
        for i, ((device, argument, value), expected) in enumerate(wrong.items())
    ]
    root = ElementTree.fromstring(done.stdout)
    assert [sensor.get("name") for sensor in root.iter("sensor")] == ["good_sensor"]
    links = {link.get("name") for link in root.iter("link")}
    assert {f"bad{i}_link" for i in range(len(wrong))} < links


def test_a_call_that_is_right_goes_without_a_word(tmp_path: pathlib.Path):
    calls = "".join(call(device, device) for device in devices())
    assert run_xacro(write_robot(tmp_path, calls)).stderr == ""


@pytest.mark.parametrize("device", devices())
def test_the_file_of_a_device_is_enough_for_it(tmp_path: pathlib.Path, device: str):
    file = write_robot(tmp_path, call(device, "a"))
    with_all = expand(file)
    file.write_text(file.read_text().replace("all_sensors.urdf", f"{device}.urdf"))
    assert expand(file) == with_all
