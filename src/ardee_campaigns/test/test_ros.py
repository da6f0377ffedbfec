# SPDX-License-Identifier: MIT
"""Tests controllers that are ROS nodes, in lockstep and in real time."""
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any, List

import numpy as np
import pytest
import rosbag
import small_campaign
from small_campaign import run, write

from ardee_campaigns import tables
from ardee_campaigns.campaign_file import read_campaign
from ardee_campaigns.plan import Planner
from ardee_common.errors import GeneratorError

PROGRAM = [sys.executable, str(small_campaign.HERE / "ros_program.py")]


def controller(*words: str, **keys: Any) -> dict:
    return {"kind": "ros", "command": [*PROGRAM, *words], **keys}


@pytest.mark.slow
def test_nodes_drive_as_the_same_controllers_without_ros(tmp_path: Path) -> None:
    controllers = {
        "node": {"kind": "ros", "command": ["rosrun", "ardee_navigation", "row_follower"]},
        "lidar": "ardee_navigation.control:make",
        "ends": controller("0.5", "10"),
        "realtime": controller("{speed}", "1000", params={"speed": 0.5}, realtime=True),
        "straight": small_campaign.CAMPAIGN["controllers"]["straight"],
    }
    file = write(tmp_path, controllers=controllers, replicates=1, workers=2)
    output = tmp_path / "out"
    run(file, "--output", output)
    found = {row["controller"]: row for row in tables.read_runs(output).to_pylist()}
    errors = {name: row["error"] for name, row in found.items() if row["status"] != tables.OK}
    assert list(errors) == ["ends"], errors
    assert "ros_program.py 0.5 10 has ended with exit code 0" in errors["ends"]
    node, lidar, realtime = (
        tables.read_run(output, found[name]["run_id"]) for name in ("node", "lidar", "realtime")
    )
    for name in ("time_ns", "x_m", "y_m", "yaw_rad", "command_turn_rad_s"):
        pair = (run.samples[name].to_numpy() for run in (node, lidar))
        assert np.array_equal(next(pair), next(pair)), name  # to the last bit
    energies_j = (run.samples["energy_j"][-1].as_py() for run in (node, lidar))
    assert next(energies_j) == pytest.approx(next(energies_j), rel=1e-6)
    assert realtime.timing.wall_s > realtime.row.sim_s
    straight_m = found["straight"]["distance_m"]
    assert found["realtime"]["distance_m"] == pytest.approx(straight_m, abs=0.1)


@pytest.mark.slow
def test_a_run_is_replayed_to_a_bag(tmp_path: Path) -> None:
    controllers = {"turning": small_campaign.CAMPAIGN["controllers"]["turning"]}
    task = {"stuck_within_m": 9.0, "stuck_after_s": 1.0}  # a person steps in once
    file = write(tmp_path, controllers=controllers, replicates=1, task=task)
    output = tmp_path / "out"
    run(file, "--output", output)
    (run_id,) = tables.finished(output)
    done = run(file, "--output", output, "--replay", run_id, "--bag")
    assert done.stdout.splitlines()[-1] == str(output / f"{run_id}.bag")
    samples = tables.read_run(output, run_id).samples
    assert samples["event"].to_pylist().count("stuck") == 1
    with rosbag.Bag(str(output / f"{run_id}.bag")) as bag:
        found = bag.get_type_and_topic_info().topics
        scans = {scan.header.stamp.to_nsec() for _, scan, _ in bag.read_messages("/ardee/hokuyo")}
        turns = [command.angular.z for _, command, _ in bag.read_messages("/cmd_vel")]
    assert {"/clock", "/odom", "/tf", "/joint_states"} <= set(found)
    assert scans >= set(samples["time_ns"].to_pylist())
    assert [turn for turn in turns if turn] == samples["command_turn_rad_s"].to_pylist()


@pytest.mark.slow
def test_a_robot_of_ros_control_drives_with_and_without_ros(tmp_path: Path) -> None:
    """A replay to a bag is refused if the node's robot is not where the run's was."""
    robots = small_campaign.HERE.parents[2] / "tests" / "robots_with_ros_control"
    jackal = {
        "model": str(robots / "jackal.urdf.xacro"),
        "parameters": str(robots / "jackal.yaml"),
        "controllers": ["jackal_joint_publisher", "jackal_velocity_controller"],
        "topics": {"command": "jackal_velocity_controller/cmd_vel"},
        "period_s": 0.1,
        "stand_m": 0.07,
    }
    controllers = {"straight": small_campaign.CAMPAIGN["controllers"]["straight"]}
    file = write(tmp_path, controllers=controllers, replicates=1, robots={"jackal": jackal})
    output = tmp_path / "out"
    run(file, "--output", output)
    (row,) = tables.read_runs(output).to_pylist()
    assert row["status"] == tables.OK, row["error"]
    assert row["distance_m"] > 0.5
    run(file, "--output", output, "--replay", row["run_id"], "--bag")
    with rosbag.Bag(str(output / f"{row['run_id']}.bag")) as bag:
        found = bag.get_type_and_topic_info().topics
    assert {"/joint_states", "/jackal_velocity_controller/odom"} <= set(found)
    jackal["controllers"] = ["jackal_velocity"]
    bad = write(tmp_path, controllers=controllers, replicates=1, robots={"jackal": jackal})
    said = run(bad, "--output", tmp_path / "bad", code=2).stderr
    assert "robot jackal: controllers: " in said and "jackal_velocity" in said


def processes_of(mark: str) -> List[str]:
    """Returns the commands of all processes with a variable in their environment."""
    found = []
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            if mark.encode() in (folder / "environ").read_bytes().split(b"\0"):
                found.append((folder / "cmdline").read_text().replace("\0", " "))
        except OSError:
            continue
    return found


@pytest.mark.slow
def test_a_campaign_that_is_ended_leaves_no_process_behind(tmp_path: Path) -> None:
    file = write(tmp_path, controllers={"a": controller("0.5", "100000", realtime=True)})
    mark = f"CAMPAIGN_OF={tmp_path}"
    env = {**small_campaign.environment(), "CAMPAIGN_OF": str(tmp_path)}
    words = small_campaign.command(file, "--output", tmp_path / "out")
    child = subprocess.Popen(words, env=env, start_new_session=True, stderr=subprocess.DEVNULL)

    def until(is_wanted: Any) -> None:
        end = time.monotonic() + 60.0
        while not is_wanted(processes_of(mark)):
            assert time.monotonic() < end, processes_of(mark)
            time.sleep(0.1)

    until(lambda found: any("ros_program" in words for words in found))
    os.kill(child.pid, signal.SIGINT)
    assert child.wait(60) == 130
    until(lambda found: not found)


@pytest.mark.parametrize(
    "keys, said",
    [
        ({"kind": "ros"}, "found no command"),
        (controller("{speed}"), "found KeyError('speed')"),
        ({"factory": "a:b", "realtime": True}, "realtime: found true for kind python"),
    ],
)
def test_a_node_that_cannot_be_meant_is_refused(tmp_path: Path, keys: dict, said: str) -> None:
    file = write(tmp_path, controllers={"a": keys})
    with pytest.raises(GeneratorError) as caught:
        Planner(read_campaign(file))
    assert said in str(caught.value) and str(caught.value).startswith(f"{file}:")


@pytest.mark.slow
def test_a_node_needs_readings_or_a_command_in_the_end(tmp_path: Path) -> None:
    robots = {"a": {"model": "tsv1_default", "period_s": 0.05, "topics": {"command": "cmd_vel"}}}
    file = write(tmp_path, controllers={"a": controller("1", "1")}, robots=robots)
    with pytest.raises(GeneratorError, match="found no topic of its pace 'scan'.*realtime: true"):
        Planner(read_campaign(file))
    file = write(tmp_path, controllers={"mute": controller("0", "-1")}, replicates=1)
    run(file, "--output", tmp_path / "out")
    (row,) = tables.read_runs(tmp_path / "out").to_pylist()
    assert row["status"] == tables.FAILED and "sent nothing on /cmd_vel" in row["error"]
