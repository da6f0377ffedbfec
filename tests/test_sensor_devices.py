# SPDX-License-Identifier: MIT
"""Tests every sensor of ardee_sensors in the running simulator: topics, types, frames, rates, fields of view, ranges.

They all sit on one beam across a white wall that stands WALL_M ahead of each, and are read one after the other; the
simulator is stepped, so that the results are independent of the machine's speed.
"""
import math
import pathlib
import sys
from typing import Any, Dict, Iterator

import device_summary
import gazebo_calls
import probes
import pytest

from ardee_common.ros_graph import RosGraph

PACKAGE = pathlib.Path(__file__).resolve().parents[1] / "src/ardee_sensors"
sys.path.insert(0, str(PACKAGE / "scripts"))

from device_numbers import devices, expected_topics, load  # noqa: E402

STEP_S = 0.005
WALL_M = 2.0
SPACING_M = 0.6
HEIGHT_M = 0.8
NAMESPACE = "/all"
SPEED_WINDOW_S = 0.1  # time over which an encoder counts pulses
SETTLE_S = 2.0  # time until the beam lies still on the ground
LAMP, LAMP_WAY = 0.9, (0.6, 0.2, -0.8)
# The frames are those of gazebo_ros, which has no tf_prefix here.
FRAMES_BELOW_NAMESPACE = (
    "sensor_msgs/LaserScan",
    "sensor_msgs/PointCloud2",
    "sensor_msgs/Image",
    "sensor_msgs/CameraInfo",
)
INFRARED = {  # topic, encoding and bytes a pixel of the drivers: realsense2_camera, kinect2_bridge
    "realsense_d435": ("infra1/image_rect_raw", "mono8", 1),
    "kinectv2": ("ir/image_raw", "16UC1", 2),
}
WORLD = f"""<sdf version="1.5"><world name="wall">
  <physics type="ode"><max_step_size>{STEP_S}</max_step_size><real_time_update_rate>0</real_time_update_rate></physics>
  <light name="sun" type="directional"><direction>{LAMP_WAY[0]} {LAMP_WAY[1]} {LAMP_WAY[2]}</direction>
    <diffuse>{LAMP} {LAMP} {LAMP} 1</diffuse></light>
  <include><uri>model://ground_plane</uri></include>
  <model name="wall"><static>true</static><pose>{WALL_M + 0.05} 0 2 0 0 0</pose><link name="link">
    <collision name="c"><geometry><box><size>0.1 60 4</size></box></geometry></collision>
    <visual name="v"><geometry><box><size>0.1 60 4</size></box></geometry>
      <material><script><name>Gazebo/White</name></script></material></visual>
  </link></model>
</world></sdf>"""
ROBOT = """<robot name="all" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:property name="robot_namespace" value="{namespace}" />
  <xacro:include filename="$(find ardee_sensors)/urdf/all_sensors.urdf.xacro" />
  <link name="base_footprint">
    <xacro:inertial_box mass="5000" x="0.4" y="{length}" z="0.1"><origin xyz="0 0 0.05" /></xacro:inertial_box>
    <collision><origin xyz="0 0 0.05" /><geometry><box size="0.4 {length} 0.1" /></geometry></collision>
  </link>
  <link name="wheel">
    <xacro:inertial_cylinder mass="1" radius="0.1" length="0.05"><origin xyz="0 0 0" /></xacro:inertial_cylinder>
  </link>
  <joint name="axle" type="continuous">
    <parent link="base_footprint" /><child link="wheel" />
    <origin xyz="-1 0 0.5" rpy="1.5708 0 0" /><axis xyz="0 0 1" />
  </joint>
  {calls}
</robot>"""


def place(index: int) -> str:
    """Returns the origin of the device of that number in the row, at x = 0."""
    y = (index - (len(devices()) - 1) / 2) * SPACING_M
    return f'<origin xyz="0 {y:.2f} {HEIGHT_M}" rpy="0 0 0" />'


def call(device: str, index: int) -> str:
    if device == "encoder":
        return (
            '<xacro:sensor_encoder parent="base_footprint" name="encoder" joint="axle"'
            ' topic="ardee/encoder" xyz="0 0 0.05" />'
        )
    macro = f"xacro:sensor_{device}"
    return f'<{macro} name="{device}" parent="base_footprint">{place(index)}</{macro}>'


@pytest.fixture(scope="module")
def everything(
    shared_graph: RosGraph, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[RosGraph]:
    """Yields a paused simulator with a robot that has every sensor."""
    folder = tmp_path_factory.mktemp("sensors")
    (folder / "wall.world").write_text(WORLD)
    calls = "\n".join(call(device, index) for index, device in enumerate(devices()))
    length = SPACING_M * len(devices())
    robot = folder / "all.urdf.xacro"
    robot.write_text(ROBOT.format(namespace=NAMESPACE, length=length, calls=calls))
    urdf = shared_graph.run("rosrun", "xacro", "xacro", str(robot))
    simulator = shared_graph.spawn(
        "rosrun",
        "ardee_sim_cpp",
        "simulator",
        str(folder / "wall.world"),
        "--paused",
        "_real_time_factor:=0",
    )
    at = gazebo_calls.pose()
    spawn = gazebo_calls.spawn("all", urdf, at, "urdf", robot_namespace=NAMESPACE)
    settle = gazebo_calls.step(round(SETTLE_S / STEP_S))
    answer, _ = gazebo_calls.call(shared_graph, spawn, settle)
    assert answer.success, answer.status_message
    shared_graph.simulator_output = simulator.output
    yield shared_graph


def full(topics: Dict[str, Any]) -> Dict[str, Any]:
    return {f"{NAMESPACE}/{topic}": value for topic, value in topics.items()}


def test_all_of_them_on_one_robot_publish_what_they_say(everything: RosGraph) -> None:
    published = everything.call(probes.topics)
    for device in devices():
        expected = full(expected_topics(device, device))
        assert {t: published.get(t) for t in expected} == {
            t: kind for t, (kind, _) in expected.items()
        }


def test_the_simulator_has_nothing_to_say_about_them(everything: RosGraph) -> None:
    """Expects no unknown plugin, no unknown key, and no sensor left out."""
    complaints = [
        line
        for line in everything.simulator_output().splitlines()
        if "WARN" in line or "ERROR" in line
    ]
    assert not complaints


@pytest.fixture(scope="module")
def heard(everything: RosGraph) -> Dict[str, Any]:
    """Keeps summaries of each device's messages, filled as tests ask."""
    return {}


def listen(everything: RosGraph, heard: Dict[str, Any], device: str) -> Dict[str, Any]:
    """Returns {topic without namespace: summary} of the device; markers have no rate and are left out."""
    if device not in heard:
        wanted = {
            t: k for t, (k, _) in expected_topics(device, device).items() if "Marker" not in k
        }
        steps = math.ceil(5 / rate_hz(device) / STEP_S)
        found = everything.call(device_summary.step_and_collect, full(wanted), steps)
        heard[device] = {topic[len(NAMESPACE) + 1 :]: value for topic, value in found.items()}
    return heard[device]


def rate_hz(device: str) -> float:
    numbers = load(device)
    return numbers["rate_hz"] if "rate_hz" in numbers else load(numbers["also"])["rate_hz"]


@pytest.mark.parametrize("device", devices())
def test_device(everything: RosGraph, heard: Dict[str, Any], device: str) -> None:
    """Checks frames and rates of every topic, then the properties of the device's kind."""
    numbers = load(device)
    found = listen(everything, heard, device)
    for topic, (kind, frame) in expected_topics(device, device).items():
        if topic not in found:
            continue
        below = f"{NAMESPACE[1:]}/" if kind in FRAMES_BELOW_NAMESPACE else ""
        assert found[topic]["frame"] == below + frame, topic
        stamps = found[topic]["stamps"]
        periods = [b - a for a, b in zip(stamps, stamps[1:])]
        assert sum(periods) / len(periods) == pytest.approx(
            1 / rate_hz(device), abs=STEP_S / len(periods) + 1e-9
        )
        assert max(periods) - min(periods) < STEP_S + 1e-9
    last = {topic: value["last"] for topic, value in found.items()}
    CHECKS[numbers["kind"]](device, numbers, last)


def tolerance_m(numbers: Dict[str, Any], distance_m: float) -> float:
    """Returns six standard deviations of a lidar's noise: a false alarm in 5e8."""
    return 6 * (numbers["noise_std_m"] + numbers["noise_growth_m_per_m"] * distance_m) + 0.01


def check_lidar_2d(device: str, numbers: Dict[str, Any], last: Dict[str, Any]) -> None:
    scan = last[f"ardee/{device}"]
    assert scan["samples"] == scan["intensities"] == numbers["samples"]
    angles = (numbers["min_angle_rad"], numbers["max_angle_rad"])
    assert (scan["angle_min"], scan["angle_max"]) == pytest.approx(angles, abs=1e-6)
    increment = (angles[1] - angles[0]) / (numbers["samples"] - 1)
    assert scan["angle_increment"] == pytest.approx(increment, rel=1e-5)
    limits = (numbers["range_min_m"], numbers["range_max_m"])
    assert (scan["range_min"], scan["range_max"]) == pytest.approx(limits, rel=1e-6)
    assert scan["ahead"] == pytest.approx(WALL_M, abs=tolerance_m(numbers, WALL_M))


def check_lidar_3d(device: str, numbers: Dict[str, Any], last: Dict[str, Any]) -> None:
    cloud = last[f"ardee/{device}/points"]
    assert cloud["fields"][:5] == ["x", "y", "z", "intensity", "ring"]
    assert cloud["point_step"] == 32 or cloud["fields"][5:]
    assert set(cloud["rings"]) <= set(range(numbers["vertical_samples"]))
    low, high = numbers["vertical_min_angle_rad"], numbers["vertical_max_angle_rad"]
    beam = (high - low) / (numbers["vertical_samples"] - 1)
    # The ground and the wall (4 m high) fill the whole field of view.
    assert cloud["elevations"] == pytest.approx([low, high], abs=beam + 0.01)
    assert len(cloud["rings"]) == numbers["vertical_samples"]
    assert cloud["points"] > 0.2 * numbers["samples"] * numbers["vertical_samples"]
    assert cloud["ranges"][0] >= numbers["range_min_m"] - tolerance_m(numbers, 0)
    assert cloud["ranges"][1] <= numbers["range_max_m"] + tolerance_m(
        numbers, numbers["range_max_m"]
    )
    assert cloud["ahead"] == pytest.approx(WALL_M, abs=tolerance_m(numbers, WALL_M))


def check_info(info: Dict[str, Any], width: int, height: int, fov_deg: float) -> None:
    """Checks size and focal length; the principal point is within a pixel of the middle."""
    assert (info["width"], info["height"]) == (width, height)
    focal_px = width / 2 / math.tan(math.radians(fov_deg) / 2)
    assert (info["K"][0], info["K"][4]) == pytest.approx((focal_px, focal_px), rel=1e-6)
    assert (info["K"][2], info["K"][5]) == pytest.approx((width / 2, height / 2), abs=1)
    assert info["distortion_model"] == "plumb_bob" and not any(info["D"])


def check_camera(device: str, numbers: Dict[str, Any], last: Dict[str, Any]) -> None:
    image = last[f"ardee/{device}/image_raw"]
    size = numbers["width_px"], numbers["height_px"]
    assert (image["width"], image["height"], image["encoding"]) == (*size, "rgb8")
    assert 20 < image["middle"] < 255  # the wall, in daylight
    check_info(last[f"ardee/{device}/camera_info"], *size, numbers["horizontal_fov_deg"])


def check_depth(
    image: Dict[str, Any], cloud: Dict[str, Any], numbers: Dict[str, Any], encoding: str = "32FC1"
) -> None:
    size = numbers["width_px"], numbers["height_px"]
    assert (image["width"], image["height"], image["encoding"]) == (*size, encoding)
    std_m = (
        numbers["depth_noise_constant_m"]
        + numbers["depth_noise_linear"] * WALL_M
        + numbers["depth_noise_quadratic_per_m"] * WALL_M**2
    )
    assert image["middle"] == pytest.approx(WALL_M, abs=std_m + 0.005)  # a median of many pixels
    assert (cloud["width"], cloud["height"]) == size
    assert cloud["fields"][:3] == ["x", "y", "z"] and cloud["point_step"] == 32
    assert cloud["along_z"] == pytest.approx(WALL_M, abs=std_m + 0.005)


def check_rgbd(device: str, numbers: Dict[str, Any], last: Dict[str, Any]) -> None:
    base = f"ardee/{device}"
    color = "color" if device == "realsense_d435" else "rgb"
    depth_name = "image_rect_raw" if device == "realsense_d435" else "image_raw"
    points = "depth/color/points" if device == "realsense_d435" else "depth/points"
    depth_encoding = "16UC1" if device == "realsense_d435" else "32FC1"  # as realsense2_camera
    check_depth(
        last[f"{base}/depth/{depth_name}"], last[f"{base}/{points}"], numbers, depth_encoding
    )
    size = numbers["width_px"], numbers["height_px"]
    check_info(last[f"{base}/depth/camera_info"], *size, numbers["horizontal_fov_deg"])
    own = {
        k: numbers.get(f"rgb_{k}", numbers[k])
        for k in ("width_px", "height_px", "horizontal_fov_deg")
    }
    image = last[f"{base}/{color}/image_raw"]
    assert (image["width"], image["height"], image["encoding"]) == (
        own["width_px"],
        own["height_px"],
        "mono8" if device == "fotonic" else "rgb8",  # the former has no colours
    )
    assert 20 < image["middle"] < 255
    check_info(last[f"{base}/{color}/camera_info"], *own.values())
    if device in INFRARED:
        check_infrared(device, numbers, last)


def check_infrared(device: str, numbers: Dict[str, Any], last: Dict[str, Any]) -> None:
    """Checks the brightness of a white wall that fills the picture: (ambient + lamp x cosine) x the least exposure."""
    topic, encoding, pixel_bytes = INFRARED[device]
    image = last[f"ardee/{device}/{topic}"]
    size = numbers["width_px"], numbers["height_px"]
    assert (image["width"], image["height"], image["encoding"]) == (*size, encoding)
    assert image["step"] == pixel_bytes * numbers["width_px"]
    ambient, least_exposure = 0.4, 0.5
    light = ambient + LAMP * LAMP_WAY[0] / math.dist(LAMP_WAY, (0, 0, 0))
    full = {"mono8": 255, "16UC1": 65.535}[encoding]  # the summary takes 16UC1 for millimetres
    assert image["middle"] / full == pytest.approx(least_exposure * light, abs=0.005)
    info = last[f"ardee/{device}/{topic.split('/')[0]}/camera_info"]
    check_info(info, *size, numbers["horizontal_fov_deg"])


def check_stereo(device: str, numbers: Dict[str, Any], last: Dict[str, Any]) -> None:
    base = f"ardee/{device}"
    size = numbers["width_px"], numbers["height_px"]
    for side, baseline_m in (("left", 0.0), ("right", numbers["baseline_m"])):
        image, info = last[f"{base}/{side}/image_raw"], last[f"{base}/{side}/camera_info"]
        assert (image["width"], image["height"], image["encoding"]) == (*size, "rgb8")
        check_info(info, *size, numbers["horizontal_fov_deg"])
        assert info["P"][3] == pytest.approx(-info["P"][0] * baseline_m)
    check_depth(
        last[f"{base}/depth/depth_registered"],
        last[f"{base}/point_cloud/cloud_registered"],
        numbers,
    )


def check_gps(device: str, numbers: Dict[str, Any], last: Dict[str, Any]) -> None:
    fix = last[f"ardee/{device}"]
    own = {**load("gps"), **numbers}
    assert fix["latitude"] == pytest.approx(own["reference_latitude_deg"], abs=1e-3)
    assert fix["longitude"] == pytest.approx(own["reference_longitude_deg"], abs=1e-3)
    above_m = HEIGHT_M + own.get("mast_height_m", 0)
    assert fix["altitude"] == pytest.approx(
        own["reference_altitude_m"] + above_m, abs=6 * own["noise_m"] + 0.01
    )
    assert fix["status"].status >= 0
    speed = last[f"ardee/{device}/fix_velocity"]["vector"]
    assert (speed.x, speed.y, speed.z) == pytest.approx((0, 0, 0), abs=0.01)


def check_imu(device: str, numbers: Dict[str, Any], last: Dict[str, Any]) -> None:
    """Checks the IMU at rest on level ground: 9.8 m/s2 up, up to noise and drift."""
    imu = next(iter(last.values()))
    accel, rate = imu["linear_acceleration"], imu["angular_velocity"]
    assert (accel.x, accel.y, accel.z) == pytest.approx((0, 0, 9.8), abs=0.1)
    assert (rate.x, rate.y, rate.z) == pytest.approx((0, 0, 0), abs=0.05)
    assert imu["orientation"].w == pytest.approx(1, abs=0.01)


def check_magnetometer(device: str, numbers: Dict[str, Any], last: Dict[str, Any]) -> None:
    """Checks the field on level ground: x is east, y north; it dips northwards and declines to the west."""
    field = last[f"ardee/{device}/mag"]["magnetic_field"]
    dip, decline = (math.radians(numbers[f"{name}_deg"]) for name in ("inclination", "declination"))
    level_t = numbers["magnitude_t"] * math.cos(dip)
    expected = (
        level_t * math.sin(decline),
        level_t * math.cos(decline),
        -numbers["magnitude_t"] * math.sin(dip),
    )
    assert expected[0] < 0 < expected[1]
    assert (field.x, field.y, field.z) == pytest.approx(expected, abs=6 * numbers["noise_t"])


def check_range(device: str, numbers: Dict[str, Any], last: Dict[str, Any]) -> None:
    echo = last[f"ardee/{device}"]
    assert echo["radiation_type"] == 0  # ULTRASOUND
    assert echo["field_of_view"] == pytest.approx(math.radians(numbers["cone_angle_deg"]), rel=1e-5)
    limits = (numbers["range_min_m"], numbers["range_max_m"])
    assert (echo["min_range"], echo["max_range"]) == pytest.approx(limits, rel=1e-6)
    assert echo["range"] == pytest.approx(WALL_M, abs=6 * numbers["noise_m"] + 0.01)


def check_other(device: str, numbers: Dict[str, Any], last: Dict[str, Any]) -> None:
    if device == "encoder":
        # The wheel stands still, up to a pulse to each side.
        pulse_rad = 2 * math.pi / numbers["pulses_count"]
        assert last["ardee/encoder"]["position"] == pytest.approx(0, abs=1.01 * pulse_rad)
        assert abs(last["ardee/encoder"]["qpps"]) < 1.5 / SPEED_WINDOW_S
        return
    battery = last[f"ardee/{device}"]
    assert (battery["vmax"], battery["vmin"]) == (numbers["v_max_v"], numbers["v_min_v"])
    assert numbers["v_min_v"] <= battery["voltage"] <= numbers["v_initial_v"]
    state = last[f"ardee/{device}_state"]
    assert state["voltage"] == pytest.approx(battery["voltage"], abs=0.1)
    assert 0 <= state["percentage"] <= 1 and state["design_capacity"] > 0 and state["present"]
    # The message's value for a quantity that is not measured: the quick mode has no current.
    assert all(math.isnan(state[key]) for key in ("temperature", "current", "charge", "capacity"))


CHECKS = {
    "camera": check_camera,
    "gps": check_gps,
    "imu": check_imu,
    "lidar_2d": check_lidar_2d,
    "lidar_3d": check_lidar_3d,
    "magnetometer": check_magnetometer,
    "other": check_other,
    "range": check_range,
    "rgbd": check_rgbd,
    "stereo": check_stereo,
}
