# SPDX-License-Identifier: MIT
"""Tests two robots with their real sensors behind the bridge, as launch_default_tsv1.launch starts it (Listing A.21).

The first is a TerraSentia v3, the second a v1 in a namespace and with UDP ports of its own. The data of clients without
ROS are compared with the truth of the simulator.
"""
import io
import math
import re
import subprocess
import time
from typing import Any, Dict, Iterator, NamedTuple, Tuple

import numpy as np
import probes
import pytest
from bridge_bench import (
    PACKAGE,
    PLANE,
    compile_client,
    finish,
    finish_once_heard,
    free_port,
    interrupt,
    start_client,
)
from PIL import Image as Picture
from test_motion_sensors import reconfigure

from ardee_bridge.wire import codec
from ardee_bridge.wire.chunks import Assembler
from ardee_bridge.wire.pairing import Pairer
from ardee_bridge.wire.udp import open_socket
from ardee_common.ros_graph import RosGraph, wait_until

G_M_S2, WALL_X_M, LIDAR_AHEAD_M = 9.81, 4.0, 0.16
REFERENCE_DEG = (40.1021496545, -88.2267974168)  # as in both robots' sensor configurations
GPS_BEHIND_M = 0.15
EARTH_M, FLATTENING = 6378137.0, 1 / 298.257223563  # WGS-84
WHEELS = ("front_right", "front_left", "rear_right", "rear_left")  # by component id
SMALL = {"imu 0", "gps 0", "lidar 0", "battery 0", *(f"encoder {wheel}" for wheel in range(4))}
SPEED = 0.25  # share of the largest, 1.2 m/s


class Ports(NamedTuple):
    """UDP ports of a robot's bridge."""

    target: int
    sensors: int
    controls: int


class Robots(NamedTuple):
    """Graph, client in C, and each robot's ports."""

    graph: RosGraph
    program: str
    v3: Ports
    v1: Ports


@pytest.fixture(scope="module")
def robots(shared_graph: RosGraph) -> Iterator[Robots]:
    """Yields both robots, which stand before the wall and look at it."""
    shared_graph.spawn("rosrun", "ardee_sim_cpp", "simulator", PLANE)
    shared_graph.call(probes.clock_at_least, 0.1)
    ports = [Ports(free_port(), free_port(), free_port()) for _ in range(2)]
    places = (("v3", "y:=5"), ("v1", "y:=-5", "ns:=robot2"))
    for of_robot, (generation, *place) in zip(ports, places):
        model = f"bot_model:=ts{generation}_default.urdf.xacro"
        words = [model, "use_rviz:=false", "use_udp:=true", "yaw:=0", *place]
        words += [f"udp_{name}_port:={port}" for name, port in of_robot._asdict().items()]
        launched = shared_graph.launch(
            "terrasentia_description", "launch_default_tsv1.launch", *words
        )
        for port in (of_robot.sensors, of_robot.controls):
            wait_until(lambda: f"127.0.0.1:{port}" in launched.output(), f"a socket at {port}", 90)
    shared_graph.call(probes.wait_for_topics, ["/odom", "/robot2/odom"], [], 90.0)
    shared_graph.call(probes.clock_at_least, 5.0)  # the robots have come to rest on their springs
    yield Robots(shared_graph, str(compile_client(shared_graph.folder)), *ports)


def listen_in_c(robots: Robots, ports: Ports, *more: str) -> subprocess.Popen:
    """Starts a target that does not ask for anything."""
    command = [robots.program, "-p", ports.target, "-c", ports.controls, *more]
    return start_client(command)


def ask_in_python(ports: Ports, *more: str) -> subprocess.Popen:
    """Starts a client that asks for all sensors."""
    program = PACKAGE / "examples" / "ardee_client.py"
    command = ["/usr/bin/python3", "-I", program, "--port", "0", "--ask", ports.sensors]
    return start_client([*command, "--controls", ports.controls, *more])


def numbers(text: str) -> Dict[str, float]:
    """Returns the numbers in `name value` of the client in C, `path=value` of the one in Python."""
    pairs = re.findall(r"([a-z_.A-Z]+)[= ](-?[\d.]+(?:e-?\d+)?|nan)", text)
    return {name: float(value) for name, value in pairs}


def pose_of(graph: RosGraph, model: str) -> Any:
    """Returns the robot's true pose."""
    fields = {"model_name": model, "relative_entity_name": "world"}
    answer = graph.call(
        probes.call_service, "/gazebo/get_model_state", "gazebo_msgs/GetModelState", fields
    )
    assert answer.success
    return answer.pose


def antenna_on_earth(pose: Any) -> Tuple[float, float]:
    """Returns the antenna's latitude and longitude [deg]: x points east, by the ellipsoid's radii there."""
    yaw = 2 * math.atan2(pose.orientation.z, pose.orientation.w)
    east_m = pose.position.x - GPS_BEHIND_M * math.cos(yaw)
    north_m = pose.position.y - GPS_BEHIND_M * math.sin(yaw)
    latitude = math.radians(REFERENCE_DEG[0])
    e2 = FLATTENING * (2 - FLATTENING)
    bow = 1 - e2 * math.sin(latitude) ** 2
    meridian_m = EARTH_M * (1 - e2) / bow**1.5
    parallel_m = EARTH_M / math.sqrt(bow) * math.cos(latitude)
    return (
        REFERENCE_DEG[0] + math.degrees(north_m / meridian_m),
        REFERENCE_DEG[1] + math.degrees(east_m / parallel_m),
    )


def assert_at_the_antenna(found: Dict[str, float], pose: Any) -> None:
    latitude_deg, longitude_deg = antenna_on_earth(pose)
    # The noise is 1 cm: six standard deviations; a degree is 111 km, of longitude 85 km.
    assert found["latitude"] == pytest.approx(latitude_deg, abs=0.06 / 111e3)
    assert found["longitude"] == pytest.approx(longitude_deg, abs=0.06 / 85e3)


def assert_stands(robots: Robots, space: str, found: Dict[str, Tuple[int, str]]) -> None:
    """Checks both clients' data of all small sensors of a robot that stands at x = 0 and looks at the wall."""
    said = {name: numbers(text) for name, (_, text) in found.items()}
    imu = said["imu 0"]
    up = imu.get("accel_z", imu.get("accel.z"))
    assert up == pytest.approx(G_M_S2, abs=0.1)  # noise and drift 0.005 m/s2
    assert imu.get("gyro_z", imu.get("gyro.z")) == pytest.approx(0.0, abs=0.02)
    beams, unit_m = said["lidar 0"]["beams"], 1e-3 if " mm" in found["lidar 0"][1] else 1.0
    nearest_m = said["lidar 0"]["nearest"] * unit_m
    assert (beams, nearest_m) == (1081, pytest.approx(WALL_X_M - LIDAR_AHEAD_M, abs=0.15))
    battery = robots.graph.call(probes.collect, f"{space}/ardee/battery", "ardee_msgs/Battery", 1)[
        0
    ]
    assert said["battery 0"]["voltage"] == pytest.approx(battery.voltage, abs=0.02)
    assert battery.vmin < battery.voltage < battery.vmax
    joints = robots.graph.call(probes.joint_positions, f"{space}/joint_states")
    for wheel, name in enumerate(WHEELS):
        encoder = said[f"encoder {wheel}"]
        pulse_rad = 2 * math.pi / 3416
        assert encoder["position"] == pytest.approx(joints[f"{name}_wheel_rev"], abs=3 * pulse_rad)
        assert encoder["speed"] == pytest.approx(0.0, abs=0.02)


def test_a_target_that_only_listens_gets_every_small_sensor(robots: Robots) -> None:
    found = finish(listen_in_c(robots, robots.v3, "-t", "4"))
    assert set(found) == SMALL
    assert_stands(robots, "", found)
    gps = numbers(found["gps 0"][1])
    assert_at_the_antenna(gps, pose_of(robots.graph, "TerraSentia_0"))
    assert (gps["north"], gps["west"]) == pytest.approx((0.0, 0.0), abs=0.01)
    assert found["imu 0"][0] > found["gps 0"][0] > 0


def test_the_robot_in_a_namespace_has_a_bridge_of_its_own(robots: Robots) -> None:
    found = finish(ask_in_python(robots.v1, "--duration-s", "6"))
    assert SMALL | {"time 0"} <= set(found)
    assert_stands(robots, "/robot2", found)
    assert [numbers(found[f"encoder {wheel}"][1])["id"] for wheel in range(4)] == [0, 1, 2, 3]
    gps = numbers(found["gps 0"][1])
    assert_at_the_antenna(gps, pose_of(robots.graph, "TerraSentia_robot2"))
    assert gps["status"] >= 0 and gps["velocity.x"] == pytest.approx(0.0, abs=0.01)


@pytest.mark.parametrize("model, space", [("TerraSentia_0", ""), ("TerraSentia_robot2", "/robot2")])
def test_each_is_driven_alone_and_says_how_fast_it_is(
    robots: Robots, model: str, space: str
) -> None:
    ports, other = (robots.v1, "TerraSentia_0") if space else (robots.v3, "TerraSentia_robot2")
    still, start = pose_of(robots.graph, other), pose_of(robots.graph, model)
    speed_m_s = SPEED * 1.2
    if space:
        speed_m_s = -speed_m_s
        client = ask_in_python(ports, "--speed", f"{-SPEED}", "--duration-s", "120")
    else:
        client = listen_in_c(robots, ports, "-v", f"{SPEED}", "-t", "120")
    direction = math.copysign(1, speed_m_s)

    def has_come_a_way() -> bool:
        way_m = pose_of(robots.graph, model).position.x - start.position.x
        return way_m * direction > 0.5

    wait_until(has_come_a_way, f"{model} drives", 90.0)
    found = interrupt(client)
    gps = numbers(found["gps 0"][1])
    west_m_s = gps["velocity.y"] if space else gps["west"]
    for wheel in range(4):
        said_m_s = numbers(found[f"encoder {wheel}"][1])["speed"]
        assert said_m_s == pytest.approx(speed_m_s, rel=0.1)
    assert west_m_s == pytest.approx(-speed_m_s, rel=0.1)
    now = pose_of(robots.graph, other)
    drift_m = math.hypot(now.position.x - still.position.x, now.position.y - still.position.y)
    assert drift_m < 2e-3


def test_a_gps_without_fix_says_so(robots: Robots) -> None:
    robots.graph.call(reconfigure, "/ardee/gps/status", {"STATUS_FIX": False})
    try:
        in_c = finish(listen_in_c(robots, robots.v3, "-t", "4"))
        in_python = finish(ask_in_python(robots.v3, "--duration-s", "6"))
    finally:
        robots.graph.call(reconfigure, "/ardee/gps/status", {"STATUS_FIX": True})
    assert in_c["gps 0"][1] == "no fix"
    gps = numbers(in_python["gps 0"][1])
    assert gps["status"] == -1
    for name in ("latitude", "longitude", "altitude", "velocity.x"):
        assert math.isnan(gps[name])
    with_fix = numbers(finish(listen_in_c(robots, robots.v3, "-t", "4"))["gps 0"][1])
    assert_at_the_antenna(with_fix, pose_of(robots.graph, "TerraSentia_0"))


def next_picture(server_port: int, component_id: int) -> Picture.Image:
    """Returns the next whole image of a camera, decoded."""
    pairer, assembler = Pairer(), Assembler()
    with open_socket("127.0.0.1", 0) as opened:
        opened.settimeout(60.0)
        for datagram in codec.encode_set_port([codec.DataType.IMAGE], component_id=component_id):
            opened.sendto(datagram, ("127.0.0.1", server_port))
        while True:
            message = pairer.feed("server", opened.recv(65535), time.monotonic())
            if message is None or message.header.data_type != codec.DataType.IMAGE:
                continue
            whole = assembler.feed(message.header, message.data)
            if whole:
                assert whole.component_id == component_id
                return Picture.open(io.BytesIO(whole.payload))


@pytest.mark.parametrize("component_id, place", enumerate(("front", "left", "right")))
def test_cameras_show_by_udp_what_they_show_in_ros(
    robots: Robots, component_id: int, place: str
) -> None:
    topic = f"/ardee/camera/{place}/image_raw"
    image = robots.graph.call(probes.collect, topic, "sensor_msgs/Image", 1)[0]
    assert image.encoding in ("rgb8", "bgr8")
    truth = np.frombuffer(image.data, np.uint8).reshape(image.height, image.width, 3)
    if image.encoding == "bgr8":
        truth = truth[:, :, ::-1]
    picture = np.asarray(next_picture(robots.v3.sensors, component_id).convert("RGB"))
    assert picture.shape == truth.shape == (480, 640, 3)
    # The scene is at rest; noise and JPEG average out over blocks of 40 x 40 pixels.
    blocks = [a.reshape(12, 40, 16, 40, 3).mean(axis=(1, 3)) for a in (picture, truth)]
    assert np.abs(blocks[0] - blocks[1]).max() < 8.0
    if place != "front":  # the front camera may see only the wall
        assert np.ptp(blocks[1]) > 20.0


def test_all_clients_that_ask_get_pictures(robots: Robots) -> None:
    command = [robots.program, "-p", 0, "-a", robots.v3.sensors, "-c", robots.v3.controls]
    starts = (
        (lambda seconds: start_client([*command, "-t", seconds]), 3),
        (lambda seconds: ask_in_python(robots.v1, "--duration-s", seconds), 2),
    )
    for start, cameras in starts:
        wanted = SMALL | {"time 0"} | {f"image {number}" for number in range(cameras)}
        found = finish_once_heard(start, wanted)
        for number in range(cameras):
            assert "width 640 height 480" in found[f"image {number}"][1]
