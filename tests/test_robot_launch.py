# SPDX-License-Identifier: MIT
"""A robot's launch file sets it down where the world has a robot start, and takes it away when it ends."""
import math
import pathlib
from typing import Any, List, Tuple

import probes
import pytest

from ardee_common.ros_graph import Process, RosGraph, wait_until

WORLDS = pathlib.Path(__file__).resolve().parents[1] / "src" / "ardee_world" / "worlds"
LAUNCH = ("terrasentia_description", "launch_default_tsv1.launch", "use_rviz:=false")


def start_world(graph: RosGraph, world: str) -> Process:
    """Starts a world of ardee_world."""
    process = graph.launch("ardee_world", "custom_world.launch", f"world:={world}")
    graph.call(probes.clock_at_least, 0.1)
    return process


def spawned(graph: RosGraph, *arguments: str) -> Process:
    """Starts the launch file; returns once the robot is there."""
    launched = graph.launch(*LAUNCH, *arguments)
    wait_until(lambda: "Successfully spawned" in launched.output(), "the robot", 60.0)
    return launched


def models(graph: RosGraph) -> List[str]:
    """Names of the models in the world."""
    return graph.call(probes.collect, "/gazebo/model_states", "gazebo_msgs/ModelStates", 1)[0].name


def place_of(graph: RosGraph, model: str) -> Tuple[float, float, float]:
    """x, y [m] and yaw [rad] of a model."""
    fields = {"model_name": model, "relative_entity_name": "world"}
    service = ("/gazebo/get_model_state", "gazebo_msgs/GetModelState", fields)
    pose = graph.call(probes.call_service, *service).pose  # type: Any
    yaw = 2.0 * math.atan2(pose.orientation.z, pose.orientation.w)
    return pose.position.x, pose.position.y, yaw


def assert_place(found: Tuple[float, float, float], x: float, y: float, yaw: float) -> None:
    assert found[:2] == pytest.approx((x, y), abs=0.03)
    assert abs(math.sin((found[2] - yaw) / 2.0)) < 0.02


def test_a_robot_starts_where_its_world_says_and_elsewhere_where_told(graph: RosGraph) -> None:
    start_world(graph, "long_corn.world")
    told = graph.call(probes.parameter, "/gazebo/start_pose")
    assert told == {"x_m": 51.5, "y_m": 0.0, "z_m": 0.065, "yaw_rad": 3.1415927}
    spawned(graph)
    assert_place(place_of(graph, "TerraSentia_0"), 51.5, 0.0, math.pi)
    spawned(graph, "ns:=robot2", "y:=0.76")
    assert_place(place_of(graph, "TerraSentia_robot2"), 51.5, 0.76, math.pi)
    spawned(graph, "ns:=robot3", "x:=53", "yaw:=0")
    assert_place(place_of(graph, "TerraSentia_robot3"), 53.0, 0.0, 0.0)


def test_the_start_of_an_earlier_world_is_forgotten(graph: RosGraph) -> None:
    before = start_world(graph, "long_corn.world")
    before.interrupt()
    assert before.wait() == 0
    start_world(graph, "empty.world")
    assert "start_pose" not in graph.call(probes.parameter, "/gazebo")
    spawned(graph)
    assert_place(place_of(graph, "TerraSentia_0"), 0.0, 0.0, -3.14)


def test_a_bad_start_file_is_refused(graph: RosGraph, tmp_path: pathlib.Path) -> None:
    world = tmp_path / "my.world"
    world.write_text((WORLDS / "empty.world").read_text())
    (tmp_path / "my.start.yaml").write_text("x_m: 1\ny_m: nan\n")
    refused = graph.spawn("rosrun", "ardee_sim_cpp", "simulator", str(world))
    assert refused.wait(30.0) == 2
    expected = f"{tmp_path}/my.start.yaml:2: y_m: found 'nan', expected a finite number"
    assert expected in refused.output()


def test_a_robot_goes_with_its_launch_file_and_comes_again(graph: RosGraph) -> None:
    world = start_world(graph, "farm.world")
    scenery = models(graph)
    for _ in range(2):
        launched = spawned(graph)
        assert models(graph) == [*scenery, "TerraSentia_0"]
        launched.interrupt()
        assert launched.wait() == 0
        assert "escalating" not in launched.output() and "[ERROR]" not in launched.output()
        assert models(graph) == scenery
    assert world.exit_code() is None


def assert_whole(graph: RosGraph, first: Process) -> None:
    """Checks that the first robot stands at its place, and that its wheels and its description are told."""
    assert first.exit_code() is None
    assert_place(place_of(graph, "TerraSentia_0"), 0.0, 0.0, -3.14)
    assert graph.call(probes.transform, "odom", "front_left_wheel_link")
    assert '<robot name="TSv1"' in graph.call(probes.parameter, "/robot_description")


def test_a_taken_namespace_or_name_leaves_the_first_robot_whole(graph: RosGraph) -> None:
    start_world(graph, "empty.world")
    first = spawned(graph)
    for arguments in ([], ["y:=3", "model_name:=Another", "bot_model:=tsv3_default.urdf.xacro"]):
        second = graph.launch(*LAUNCH, *arguments)
        assert second.wait() != 0
        assert "a robot runs in the namespace / already" in second.output()
        assert "another namespace: ns:=NAME" in second.output()
        assert_whole(graph, first)
    namesake = graph.launch(*LAUNCH, "ns:=robot2", "model_name:=TerraSentia_0")
    namesake.wait()
    told = [line for line in namesake.output().splitlines() if "already exists" in line]
    assert len(told) == 1
    assert "there is a model named 'TerraSentia_0'; delete it" in told[0]
    assert "rosservice call /gazebo/delete_model TerraSentia_0" in told[0]
    assert "model_name:=NAME" in told[0]
    assert_whole(graph, first)
    first.interrupt()  # as the first message says
    assert first.wait() == 0
    spawned(graph, "y:=3")
    assert_place(place_of(graph, "TerraSentia_0"), 0.0, 3.0, -3.14)


def test_a_launch_file_ends_without_a_word_when_the_world_ended_first(graph: RosGraph) -> None:
    world = start_world(graph, "empty.world")
    launched = spawned(graph)
    for process in (world, launched):
        process.interrupt()
        assert process.wait() == 0
    assert "escalating" not in launched.output() and "[ERROR]" not in launched.output()
