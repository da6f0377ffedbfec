# SPDX-License-Identifier: MIT
"""Tests the UDP bridge between the simulator and clients without ROS: sensors, driving, control codes, and restarts."""
import subprocess
from typing import Iterator

import probes
import pytest
from bridge_bench import SENSORS, Bench, feed_until_killed, finish_once_heard, interrupt, start_in

from ardee_bridge.wire import codec
from ardee_common.ros_graph import RosGraph, wait_until

FRAMES = {"image 2", "image 3", "point_cloud 0"}


@pytest.fixture(scope="module")
def bench(shared_graph: RosGraph) -> Iterator[Bench]:
    """Yields simulator, robot, both nodes."""
    made = Bench(shared_graph)
    yield made
    made.close()


@pytest.fixture(scope="module")
def fed(bench: Bench) -> Iterator[Bench]:
    """Yields the bench, with publishers of the sensors that the robot does not carry."""
    feeder, ours = start_in(bench.graph, feed_until_killed)
    assert ours.recv() == "feeding"
    yield bench
    ours.send("end")
    feeder.join(20)
    assert feeder.exitcode == 0


def test_the_c_client_gets_every_sensor(fed: Bench) -> None:
    found = finish_once_heard(lambda seconds: fed.c_client("-t", seconds), SENSORS)
    assert found["lidar 0"][1].startswith("beams 1081 nearest")
    assert found["imu 0"][1] == "accel_z 9.810 m/s2 gyro_z 0.0000 rad/s"
    assert found["battery 0"][1] == "voltage 12.340 V"
    assert found["encoder 1"][1].startswith("position -2.5000 rad")
    assert found["gps 0"][1].startswith("latitude 40.1234567 deg")
    assert "width 640 height 480 bytes 1228800" in found["image 3"][1]
    assert found["point_cloud 0"][1] == "points 28800"
    assert found["imu 0"][0] > 2 * found["battery 0"][0] > 0


def test_the_python_client_gets_every_sensor(fed: Bench) -> None:
    found = finish_once_heard(lambda seconds: fed.python_client("--duration-s", seconds), SENSORS)
    assert "accel.z=9.81" in found["imu 0"][1]
    assert "position=-2.5" in found["encoder 1"][1]
    assert found["image 3"][1] == "DEPTH_32F_M width 640 height 480 bytes 1228800"
    assert found["image 2"][1].startswith("JPEG width 640 height 480 bytes")
    assert found["point_cloud 0"][1] == "points 28800"


def test_the_server_says_what_it_sent(fed: Bench) -> None:
    finish_once_heard(lambda seconds: fed.c_client("-t", seconds), FRAMES)
    counters = fed.counters("sensor_server_node")
    assert all(counters[f"sent {name}"] > 0 for name in ("imu", "camera", "depth", "points"))


def test_the_c_client_drives_the_robot(bench: Bench) -> None:
    before = bench.state().x_m
    client = bench.c_client("-v", "0.5", "-t", "120")
    wait_until(lambda: bench.state().x_m - before > 0.3, "it has come a way", 60.0)
    assert abs(bench.state().speed_m_s - 0.5 * codec.MAX_SPEED_M_S) < 0.1
    interrupt(client)
    bench.standing_within(20.0)


def test_the_python_client_turns_the_robot(bench: Bench) -> None:
    before = bench.state().turn
    turning = bench.python_client("--yaw-rate", "0.3", "--duration-s", "120")
    # Skidding wheels turn it less than commanded.
    least = 0.3 * 0.3 * codec.MAX_YAW_RATE_RAD_S
    wait_until(lambda: bench.state().yaw_rate_rad_s > least, "it turns", 60.0)
    wait_until(lambda: abs(bench.state().turn - before) > 0.1, "it has turned", 60.0)
    interrupt(turning)
    bench.standing_within(20.0)


def test_a_client_that_dies_leaves_a_robot_that_stands(bench: Bench) -> None:
    client = bench.c_client("-v", "-0.5", "-t", "60")
    wait_until(lambda: bench.state().speed_m_s < -0.4, "it drives")
    client.kill()
    client.communicate()
    bench.standing_within(20.0)
    assert bench.counters("controls_client_node")["watchdog stops"] >= 1
    again = bench.c_client("-v", "-0.5", "-t", "60")
    wait_until(lambda: bench.state().speed_m_s < -0.4, "another client drives it")
    again.kill()
    again.communicate()
    bench.standing_within(20.0)


def test_pause_and_resume(bench: Bench) -> None:
    bench.control("PAUSE")
    wait_until(lambda: bench.graph.call(probes.clock_stands_still), "the simulation pauses")
    bench.control("RESUME")
    wait_until(lambda: not bench.graph.call(probes.clock_stands_still), "it goes on")


def test_stop_holds_the_robot_until_start(bench: Bench) -> None:
    client = bench.c_client("-v", "-0.4", "-t", "120")
    wait_until(lambda: bench.state().speed_m_s < -0.3, "it drives")
    bench.control("STOP")
    bench.standing_within(20.0)
    assert client.poll() is None
    bench.control("START")
    wait_until(lambda: bench.state().speed_m_s < -0.3, "it drives again")
    client.kill()
    client.communicate()
    bench.standing_within(20.0)


def drives(bench: Bench, client: subprocess.Popen) -> None:
    """Checks that the robot obeys this client, and that the client gets scans."""
    wait_until(lambda: abs(bench.state().speed_m_s) > 0.2, "it drives", 60.0)
    bench.interrupt_once_it_gets_scans(client)


def test_the_simulator_dies_and_comes_back_while_the_client_goes_on(bench: Bench) -> None:
    client = bench.c_client("-v", "-0.3", "-t", "180")
    wait_until(lambda: bench.state().speed_m_s < -0.2, "it drives")
    bench.kill_simulator()
    assert bench.alive()
    bench.start_simulator()
    bench.spawn_robot()
    drives(bench, client)
    assert bench.alive()


def test_both_die_and_the_client_comes_back_first(bench: Bench) -> None:
    first = bench.c_client("-v", "-0.3", "-t", "60")
    wait_until(lambda: bench.state().speed_m_s < -0.2, "it drives")
    first.kill()
    first.communicate()
    bench.kill_simulator()
    client = bench.python_client("--speed", "-0.3", "--duration-s", "180")
    bench.start_simulator()
    bench.spawn_robot()
    drives(bench, client)
    assert bench.alive()
