# SPDX-License-Identifier: MIT
"""Tests that every shipped world, model, robot, launch file and YAML can be loaded."""
import os
import pathlib
import subprocess
from typing import Any, Dict, Iterator, List

import probes
import pytest
import roslaunch.config
import roslib.packages
import yaml
from geometry_msgs.msg import Point, Pose, Quaternion

from ardee_common.ros_graph import RosGraph

ROOT = pathlib.Path(__file__).resolve().parents[1]
SRC = ROOT / "src"


def shipped(pattern: str) -> Dict[str, pathlib.Path]:
    """Returns files of the packages in this tree, by their name in it; a linked package counts where it is."""
    found = [*SRC.glob(f"*/{pattern}"), *(ROOT / "compat").glob(f"*/{pattern}")]
    return {str(f.relative_to(ROOT)): f for f in sorted(found) if not f.parents[-1].is_symlink()}


def models() -> Dict[str, pathlib.Path]:
    """Returns model directories on the workspace's model path, by name; without lights (sun)."""
    folders = [pathlib.Path(f) for f in os.environ.get("GAZEBO_MODEL_PATH", "").split(":") if f]
    found = {p.parent.name: p.parent for f in folders for p in sorted(f.glob("*/model.sdf"))}
    return {name: p for name, p in found.items() if "<model" in (p / "model.sdf").read_text()}


# The model of Willow Garage belongs to Gazebo's database.
WORLDS = {n: f for n, f in shipped("worlds/*.world").items() if f.stem != "willowgarage"}
ROBOTS = shipped("robots/*.urdf.xacro")
LAUNCH_FILES = shipped("launch/*.launch")
YAML_FILES = {**shipped("config/**/*.yaml"), **shipped("**/*.rviz")}
MODELS = models()
NO_MASTER = "http://127.0.0.1:1"  # nobody listens at port 1


def test_something_of_each_kind_is_shipped() -> None:
    for kind in (WORLDS, ROBOTS, LAUNCH_FILES, YAML_FILES, MODELS):
        assert kind


@pytest.mark.parametrize("name", WORLDS)
def test_world_runs(graph: RosGraph, name: str) -> None:
    simulator = graph.spawn("rosrun", "ardee_sim_cpp", "simulator", str(WORLDS[name]))
    assert graph.call(probes.clock_at_least, 0.05) >= 0.05
    assert "ERROR" not in simulator.output()


@pytest.fixture(scope="module")
def empty_world(shared_graph: RosGraph) -> Iterator[RosGraph]:
    """Yields the simulator, paused, on an empty world."""
    world = SRC / "ardee_world" / "worlds" / "empty.world"
    shared_graph.spawn("rosrun", "ardee_sim_cpp", "simulator", str(world), "_paused:=true")
    shared_graph.call(
        probes.call_service, "/gazebo/get_world_properties", "gazebo_msgs/GetWorldProperties", {}
    )
    yield shared_graph


def spawn_and_delete(graph: RosGraph, kind: str, name: str, xml: str) -> List[str]:
    """Returns the messages of the two services if they fail."""
    place = Pose(Point(0, 0, 1), Quaternion(0, 0, 0, 1))
    fields = {"model_name": name, "model_xml": xml, "initial_pose": place}
    answers = graph.call(
        probes.call_services,
        [
            (f"/gazebo/spawn_{kind}_model", "gazebo_msgs/SpawnModel", fields),
            ("/gazebo/delete_model", "gazebo_msgs/DeleteModel", {"model_name": name}),
        ],
    )
    return [answer.status_message for answer in answers if not answer.success]


@pytest.mark.parametrize("name", MODELS)
def test_model_spawns(empty_world: RosGraph, name: str) -> None:
    xml = (MODELS[name] / "model.sdf").read_text()
    assert spawn_and_delete(empty_world, "sdf", f"shipped_{name}", xml) == []


@pytest.mark.parametrize("name", ROBOTS)
def test_robot_spawns(empty_world: RosGraph, name: str) -> None:
    command = ["rosrun", "xacro", "xacro", str(ROBOTS[name])]
    xml = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    assert spawn_and_delete(empty_world, "urdf", "shipped_robot", xml) == []


@pytest.mark.parametrize("name", LAUNCH_FILES)
def test_launch_file_loads(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_MASTER_URI", NO_MASTER)  # a robot of another graph would be in the way
    config = roslaunch.config.load_config_default([str(LAUNCH_FILES[name])], None, verbose=False)
    assert config.nodes
    assert not config.config_errors
    missing = [n for n in config.nodes if not roslib.packages.find_node(n.package, n.type)]
    assert not missing


class Loader(yaml.SafeLoader):
    """Knows xacro's !degrees and !radians; refuses a key that is there twice, of which YAML's loader drops one."""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> Dict[Any, Any]:
        """Constructs the mapping if its keys differ."""
        keys = [key.value for key, _ in node.value]
        assert len(set(keys)) == len(keys), f"{node.start_mark}: a key twice among {keys}"
        return super().construct_mapping(node, deep)


for tag in ("!degrees", "!radians"):
    Loader.add_constructor(tag, lambda loader, node: float(loader.construct_scalar(node)))


@pytest.mark.parametrize("name", YAML_FILES)
def test_yaml_is_a_mapping_without_a_key_twice(name: str) -> None:
    found = yaml.load(YAML_FILES[name].read_text(), Loader)
    assert isinstance(found, dict) and found
    assert not name.endswith(".rviz") or found["Visualization Manager"]["Displays"]
