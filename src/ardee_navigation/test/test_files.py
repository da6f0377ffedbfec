# SPDX-License-Identifier: MIT
"""Tests that scenarios, parameters, launch file and rviz configuration are whole and agree."""
import dataclasses
import math
import os
import re
import subprocess
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Any

import pytest
import yaml

from ardee_common.config import from_values
from ardee_common.errors import GeneratorError
from ardee_navigation.evaluation.scenario_files import read_parameters, read_scenarios
from ardee_navigation.lbirnt import Parameters
from ardee_navigation.nodes import hil_row_follower, row_follower_node
from ardee_navigation.nodes.row_follower_node import Settings
from ardee_navigation.vision import VisionParameters

PACKAGE = Path(__file__).resolve().parents[1]
WORLD = PACKAGE.parent / "ardee_world"
SCENARIOS = read_scenarios(WORLD / "config" / "scenarios.yaml")


@pytest.mark.parametrize("name", SCENARIOS)
def test_a_scenario_has_its_world_its_plan_and_its_rows(name: str) -> None:
    scenario = SCENARIOS[name]
    world = ElementTree.parse(WORLD / "worlds" / scenario.world).getroot()
    field = world.findall("world/include")[1].findtext("uri")[len("model://") :]
    assert (WORLD / "fields" / f"{field}.yaml").is_file()
    assert scenario.plan in (None, f"{field}.yaml")
    plan = yaml.safe_load((WORLD / "fields" / f"{field}.yaml").read_text())
    assert scenario.parameters.lane_width_m == plan.get("row_spacing_m", 0.762)
    from_values(VisionParameters, scenario.vision or {})  # refuses a wrong one


def roslaunch(option: str, *arguments: str, display: str = "") -> str:
    environment = dict(os.environ, ROS_PACKAGE_PATH=str(PACKAGE.parent), PATH="/usr/bin:/bin")
    environment["DISPLAY"] = display
    command = [
        "roslaunch",
        *option.split(),
        str(PACKAGE / "launch/row_following.launch"),
        *arguments,
    ]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    # without what makes the spawner one of its kind
    return re.sub(r"(?<=/spawn_terrasentia)_\w+", "", done.stdout)


def test_launch_file_starts_what_is_asked_for() -> None:
    usual = {"/gazebo", "/robot_state_publisher", "/spawn_terrasentia", "/row_follower"}
    assert set(roslaunch("--nodes").split()) == usual
    udp = {"/sim_sensor_node", "/udp_control_node", "/hil_row_follower"}
    without_display = usual | udp | {"/no_window"}
    assert set(roslaunch("--nodes", "hil:=true", "rviz:=true").split()) == without_display


@pytest.mark.parametrize("follower, view", [("lbirnt", "row_following"), ("vision", "vision")])
def test_rviz_opens_on_the_view_of_the_follower(follower: str, view: str) -> None:
    command = roslaunch("--args /rviz", f"follower:={follower}", display=":9")
    assert f"-d {PACKAGE}/rviz/{view}.rviz" in command


def test_every_argument_of_the_launch_file_has_a_doc() -> None:
    arguments = ElementTree.parse(PACKAGE / "launch/row_following.launch").getroot().findall("arg")
    assert arguments and all(argument.get("doc") for argument in arguments)


def test_rviz_shows_scan_lines_and_path() -> None:
    manager = yaml.safe_load((PACKAGE / "rviz/row_following.rviz").read_text())[
        "Visualization Manager"
    ]
    topics = {d.get("Topic") or d.get("Marker Topic") for d in manager["Displays"] if d["Enabled"]}
    assert {"ardee/hokuyo", "/row_follower/markers", "/row_follower/path"} <= topics


@pytest.mark.parametrize(
    "text, message",
    [
        ("speed: 1\n", r"p.yaml:1: unknown key 'speed'"),
        ("kp: 25\nspeed_m_s: 3\n", r"p.yaml:2: speed_m_s: found 3, expected 0 to 1.2"),
        ("kp: 25\nkp: 26\n", r"p.yaml:2: found key 'kp' a second time"),
        ("kp: '25'\n", r"p.yaml:1: kp: found '25', expected 0 to 10000"),
        ("kp: {p: 25}\n", r"p.yaml:1: kp: found .*, expected 0 to 10000"),
        ("- kp\n", r"p.yaml: found list, expected a mapping"),
        ("kp: [\n", r"p.yaml:2: not valid YAML"),
        (
            "lateral_max_m: 0.3\n",
            r"p.yaml:1: lateral_min_m, lateral_max_m: found 0.15 and 0.3, expected half the lane_width_m",
        ),
        ("lane_width_m: 1.4\n", r"p.yaml:1: lateral_min_m, lateral_max_m: .* between them, 0.7$"),
        ("max_speed_m_s: 0.4\n", r"p.yaml:1: speed_m_s: found 0.5, expected at most .*, 0.4$"),
        ("min_points: 2.5\n", r"p.yaml:1: min_points: found 2.5, expected a whole number"),
        ("kp: .nan\n", r"p.yaml:1: kp: found nan"),
    ],
)
def test_bad_parameters_are_named_with_their_line(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "p.yaml"
    path.write_text(text)
    with pytest.raises(GeneratorError, match=message):
        read_parameters(path, Parameters())


@pytest.mark.parametrize(
    "text, message",
    [
        ("rice:\n  wrold: rice.world\n", r"s.yaml:2: unknown key 'wrold', known: world, plan, vis"),
        ("rice:\n  parameters:\n    kq: 1\n", r"s.yaml:3: unknown key 'kq', nearest of .*: kp, "),
        ("rice:\n  parameters:\n    kp: -1\n", r"s.yaml:3: kp: found -1, expected 0 to 10000"),
        ("rice:\n  parameters:\n    lane_width_m: 2.9\n", r"s.yaml:3: beside_min_m, "),
        ("rice: 5\n", r"s.yaml:1: rice: found 5, expected a mapping"),
    ],
)
def test_bad_scenarios_are_named_with_their_line(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "s.yaml"
    path.write_text(text)
    with pytest.raises(GeneratorError, match=message):
        read_scenarios(path)


def test_a_bad_key_of_a_scenarios_camera_is_named_with_its_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "s.yaml"
    path.write_text("rice:\n  vision:\n    end_confidense: 0.2\n")
    monkeypatch.setattr(row_follower_node, "known_scenarios", lambda: read_scenarios(path))
    message = r"s.yaml:3: unknown key 'end_confidense', .*did you mean 'end_confidence'"
    with pytest.raises(GeneratorError, match=message):
        row_follower_node._parameters(Settings(follower="vision", scenario="rice"))


@pytest.mark.parametrize(
    "values, message",
    [
        ({"scna": "/scan"}, "^unknown key 'scna', .*: scan, .* did you mean 'scan'"),
        ({"drive": "no"}, "^drive: found 'no', expected true or false"),
        ({"drive": 1}, "^drive: found 1, expected true or false"),
        ({"parameters": 7}, "^parameters: found 7, expected a text"),
        ({"follower": "eye"}, "^follower: found 'eye', expected one of lbirnt, vision"),
        ({"scan": ""}, "^scan: found '', expected a ROS name"),
        ({"cmd": "cmd vel"}, "^cmd: found 'cmd vel', expected a ROS name"),
        (5, "^found 5, expected a mapping of keys to values"),
    ],
)
def test_bad_parameters_of_the_node_are_named(values: Any, message: str) -> None:
    with pytest.raises(GeneratorError, match=message):
        from_values(Settings, values)


def test_parameters_of_the_node_default_to_the_listed_ones() -> None:
    assert from_values(Settings, {"scan": "/a/scan", "drive": False}) == Settings(
        scan="/a/scan", drive=False
    )


@pytest.mark.parametrize("name, value", [("kp", -1.0), ("speed_m_s", math.nan), ("bin_m", 0.0)])
def test_parameters_beyond_their_limits_are_refused_in_python_too(name: str, value: float) -> None:
    with pytest.raises(ValueError, match=f"{name}: found {value}, expected "):
        Parameters(**{name: value})


def test_parameters_default_to_the_listed_ones(tmp_path: Path) -> None:
    path = tmp_path / "p.yaml"
    path.write_text("kd: 4\n")
    assert read_parameters(path, Parameters()) == Parameters(kd=4.0)


def test_a_file_of_parameters_leaves_the_others_as_the_scenario_has_them(tmp_path: Path) -> None:
    path = tmp_path / "p.yaml"
    path.write_text("kp: 30\n")
    wanted = dataclasses.replace(SCENARIOS["tobacco"].parameters, kp=30.0)
    assert wanted.lane_width_m == 1.0 and Parameters().lane_width_m == 0.762
    settings = Settings(scenario="tobacco", parameters=str(path))
    assert row_follower_node._parameters(settings) == wanted
    by_camera = row_follower_node._parameters(Settings(follower="vision", scenario="tobacco"))
    ends = {"end_confidence": 0.2, "end_after_s": 2.0}
    assert by_camera == VisionParameters(lane_width_m=1.0, **ends)
    words = ["--scenario", "tobacco", "--parameters", str(path)]
    words += ["--scenarios", str(WORLD / "config" / "scenarios.yaml")]
    assert hil_row_follower._parameters(hil_row_follower._arguments(words)) == wanted
