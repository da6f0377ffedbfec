# SPDX-License-Identifier: MIT
"""Tests the row follower in the simulator: an experiment in lockstep, the launch file, and the same over UDP alone."""
import csv
import pathlib
import time
from typing import Dict, List, Tuple

import pytest
from bridge_bench import free_port

from ardee_common.ros_graph import RosGraph, wait_until

LARGEST_RMS_M = 0.05


def experiment(
    graph: RosGraph, output: pathlib.Path, *arguments: str, scenario: str = "artificial"
) -> pathlib.Path:
    command = ["rosrun", "ardee_navigation", "run_experiment", "--scenario", scenario]
    graph.run(*command, "--output", str(output), *arguments, timeout_s=120.0)
    return output


def rows(path: pathlib.Path) -> List[Dict[str, str]]:
    with path.open() as file:
        return list(csv.DictReader(file))


def test_artificial_row_in_lockstep(graph: RosGraph, tmp_path: pathlib.Path) -> None:
    first = experiment(graph, tmp_path / "first", "--seed", "3", "--runs", "2")
    run, _ = rows(first / "runs.csv")
    assert run["end"] == "end of the row" and run["interventions"] == "0"
    assert float(run["way_m"]) == pytest.approx(22 * 0.1524, abs=0.03)  # 23 stalks; 1.25 cm a scan
    assert float(run["lateral_rms_m"]) < LARGEST_RMS_M and float(run["share_near"]) >= 0.98
    assert float(run["row_width_m"]) == pytest.approx(0.762, abs=0.06)
    track = (first / "run_00.csv").read_bytes()
    assert track != (first / "run_01.csv").read_bytes()
    # The summary is that of the track, of which it has six digits.
    inside = [r for r in rows(first / "run_00.csv") if 0 <= float(r["along_m"]) <= 3.3528]
    largest_m = max(abs(float(r["lateral_m"])) for r in inside)
    assert largest_m == pytest.approx(float(run["lateral_max_m"]), rel=1e-5)
    assert (first / "report.md").read_text().count(".png)") == 4
    for name in ("run_00_lidar.png", "run_00_errors.png"):
        assert (first / name).read_bytes().startswith(b"\x89PNG")
    # An experiment goes on where another of fewer runs has ended, to the same bytes.
    again = experiment(graph, tmp_path / "again", "--seed", "3", "--runs", "1")
    assert track == (again / "run_00.csv").read_bytes()
    command = ("rosrun", "ardee_navigation", "run_experiment", "--scenario", "artificial")
    words = ("--seed", "3", "--runs", "2", "--output", str(again))
    process = graph.spawn(*command, *words)
    assert process.wait(120.0) == 0 and "1 of 2 runs are done already" in process.output()
    for name in ("run_00.csv", "run_01.csv", "runs.csv", "campaign/runs.parquet"):
        assert (first / name).read_bytes() == (again / name).read_bytes()


@pytest.mark.parametrize("scenario", ["corn", "sorghum"])
def test_the_fields_of_the_thesis_are_driven_to_their_end(
    graph: RosGraph, tmp_path: pathlib.Path, scenario: str
) -> None:
    """Sections 5.2.3 and 5.2.4: 5 m between mature plants, sown anew; a person may step in once."""
    report = experiment(graph, tmp_path, "--seed", "51", "--runs", "1", scenario=scenario)
    (run,) = rows(report / "runs.csv")
    assert run["end"] == "end of the row" and int(run["interventions"]) <= 1
    assert float(run["way_m"]) == pytest.approx(5.0, abs=0.6)  # less what it was carried
    assert float(run["lateral_rms_m"]) < LARGEST_RMS_M


def test_a_bad_scenario_is_one_line(graph: RosGraph) -> None:
    process = graph.spawn("rosrun", "ardee_navigation", "run_experiment", "--scenario", "rice")
    assert process.wait() == 2
    assert process.output().count("\n") == 1 and "'rice'" in process.output()


def at_work(folder: pathlib.Path) -> List[str]:
    """Returns the command lines of the processes whose temporary files are in a folder."""
    found = []
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            if f"TMPDIR={folder}".encode() in (process / "environ").read_bytes():
                found.append((process / "cmdline").read_bytes().decode().replace("\0", " "))
        except OSError:  # it has ended
            continue
    return [line for line in found if line]


@pytest.mark.parametrize("how, last_started", [((), ""), (("--hil",), "hil_row_follower")])
def test_ctrl_c_ends_an_experiment_and_leaves_nothing(
    how: Tuple[str, ...], last_started: str, graph: RosGraph, tmp_path: pathlib.Path
) -> None:
    work = tmp_path / "work"
    work.mkdir()
    words = ("--scenario", "energy_farm", "--runs", "50", "--output", str(tmp_path / "report"))
    command = ("rosrun", "ardee_navigation", "run_experiment", *words, *how)
    process = graph.spawn(*command, TMPDIR=str(work))
    wait_until(lambda: list(work.glob("*/ardee_drive_*")), "the first run", 60.0)
    wait_until(lambda: any(last_started in line for line in at_work(work)), last_started, 60.0)
    process.interrupt()
    assert process.wait() == 130 and "Traceback" not in process.output()
    wait_until(lambda: not at_work(work), "the end of all processes", 10.0)
    assert not list(work.iterdir()) and not (tmp_path / "report").exists()
    assert "run_experiment: no run had ended" in process.output()


def test_ctrl_c_says_where_the_runs_are_that_had_ended(
    graph: RosGraph, tmp_path: pathlib.Path
) -> None:
    words = ("--scenario", "artificial", "--runs", "50", "--output", str(tmp_path))
    process = graph.spawn("rosrun", "ardee_navigation", "run_experiment", *words)
    wait_until(lambda: "1 of 50: " in process.output(), "the end of a run", 60.0)
    process.interrupt()
    assert process.wait() != 0
    report = tmp_path / "report.md"
    said = f"run_experiment: what had ended by then is in {report}; the same command goes on\n"
    assert process.output().endswith(said)
    assert "| end of the row |" in report.read_text()


def commands_around_a_silence() -> Tuple[List[float], List[float], List[float]]:
    """Returns the speeds commanded at two scans, in a pause after them, once time goes on, and at a scan after that."""
    import numpy as np
    import rospy
    from geometry_msgs.msg import Twist
    from rosgraph_msgs.msg import Clock
    from sensor_msgs.msg import LaserScan

    rospy.init_node("probe", anonymous=True, disable_signals=True, disable_rostime=True)
    speeds: List[float] = []
    commands = rospy.Subscriber("/cmd_vel", Twist, lambda twist: speeds.append(twist.linear.x))
    clock = rospy.Publisher("/clock", Clock, queue_size=10)
    scans = rospy.Publisher("/ardee/hokuyo", LaserScan, queue_size=10)
    ends = (commands, clock, scans)
    wait_until(lambda: all(end.get_num_connections() for end in ends), "the row follower")

    def wait_s(simulated_s: List[float], duration_s: float) -> None:
        for now_s in simulated_s:
            clock.publish(rospy.Time.from_sec(now_s))
            time.sleep(duration_s / len(simulated_s))

    def look(now_s: float) -> None:
        wait_s([now_s], 0.1)
        answers = len(speeds)
        angles = np.linspace(-2.35, 2.35, 1081)  # even: none is 0
        scan = LaserScan(angle_min=-2.35, angle_increment=4.7 / 1080)
        scan.header.stamp = rospy.Time.from_sec(now_s)
        scan.ranges = 0.381 / np.maximum(np.abs(np.sin(angles)), 0.05)
        scans.publish(scan)
        wait_until(lambda: len(speeds) > answers, "an answer")

    look(10.0)
    look(10.025)
    wait_s([10.025], 1.2)
    paused = speeds[:]
    wait_s([11.0, 11.2, 12.0, 13.0], 1.6)
    silent = speeds[len(paused) :]
    look(13.1)
    return paused, silent, speeds[len(paused) + len(silent) :]


def test_stops_the_robot_once_when_scans_stop_but_not_in_a_pause(graph: RosGraph) -> None:
    graph.run("rosparam", "set", "/use_sim_time", "true")
    node = graph.spawn("rosrun", "ardee_navigation", "row_follower")
    paused, silent, after = graph.call(commands_around_a_silence)
    assert (paused, silent, after) == ([0.5, 0.5], [0.0], [0.5])
    assert node.output().count("no scans for 0.5 s: stopped") == 1


def model_position(name: str) -> Tuple[float, float]:
    from probes import call_service

    fields = {"model_name": name, "relative_entity_name": "world"}
    answer = call_service("/gazebo/get_model_state", "gazebo_msgs/GetModelState", fields)
    assert answer.success
    return answer.pose.position.x, answer.pose.position.y


def assert_behind_the_row(position: Tuple[float, float]) -> None:
    """Checks that the robot stops behind the last stalks; the artificial rows run from x = -1 m to -4.35 m at y = 0."""
    x, y = position
    assert -6.0 < x < -4.3 and abs(y) < 0.15


def what_rviz_gets() -> Dict[str, int]:
    from probes import collect

    (array,) = collect("/row_follower/markers", "visualization_msgs/MarkerArray", 1)
    path = collect("/row_follower/path", "nav_msgs/Path", 1)[0]
    found = {marker.ns: len(marker.points) for marker in array.markers}
    assert all(marker.header.frame_id == "hokuyo_link" for marker in array.markers)
    return {**found, "path": len(path.poses)}


def test_launch_file_drives_the_row(graph: RosGraph) -> None:
    arguments = ("scenario:=artificial", "rviz:=false", "rtf:=2")
    launched = graph.launch("ardee_navigation", "row_following.launch", *arguments)
    wait_until(lambda: "following" in launched.output(), "the first row in sight", 60.0)
    shown = graph.call(what_rviz_gets)
    for line in ("left line", "right line", "centre line"):
        assert shown[line] == 2
    assert shown["chosen points"] > 20 and shown["path"] >= 1
    wait_until(lambda: "]: finished" in launched.output(), "the end of the row", 60.0)
    assert_behind_the_row(graph.call(model_position, "TerraSentia_0"))


def overlay_and_way() -> Tuple[Tuple[str, int, int], Tuple[float, float]]:
    """Returns the form of the picture with rows, and where the robot is 0.6 m behind the first stalks, at x = -1 m."""
    from probes import collect

    (picture,) = collect("/row_follower/overlay", "sensor_msgs/Image", 1)

    def is_inside() -> bool:
        return model_position("TerraSentia_0")[0] < -1.6

    wait_until(is_inside, "the robot between the rows", 60.0)
    return (picture.encoding, picture.width, picture.height), model_position("TerraSentia_0")


@pytest.mark.parametrize("scenario", ["early_corn", "low_sun", "overcast"])
def test_launch_file_drives_a_row_by_camera(graph: RosGraph, scenario: str) -> None:
    arguments = (f"scenario:={scenario}", "follower:=vision", "rviz:=false")
    launched = graph.launch("ardee_navigation", "row_following.launch", *arguments)
    form, (_, y) = graph.call(overlay_and_way)
    assert form == ("rgb8", 640, 480) and abs(y) < 0.1
    assert "]: following" in launched.output()


def test_a_process_without_ros_drives_the_row_over_udp(graph: RosGraph) -> None:
    ports = (f"sensors_port:={free_port()}", f"controls_port:={free_port()}")
    arguments = ("scenario:=artificial", "rviz:=false", "hil:=true", *ports)
    launched = graph.launch("ardee_navigation", "row_following.launch", *arguments)
    wait_until(
        lambda: "hil_row_follower: finished" in launched.output(), "the end of the row", 90.0
    )
    for state in ("following", "finished"):
        assert launched.output().count(f": {state}") == 1  # by the driving node only
    assert_behind_the_row(graph.call(model_position, "TerraSentia_0"))


def test_an_experiment_over_udp(graph: RosGraph, tmp_path: pathlib.Path) -> None:
    report = experiment(graph, tmp_path / "report", "--hil", "--runs", "1")
    (run,) = rows(report / "runs.csv")
    assert (run["end"], run["interventions"]) == ("end of the row", "0")
    assert float(run["lateral_rms_m"]) < LARGEST_RMS_M
    assert float(run["row_width_m"]) == pytest.approx(0.762, abs=0.06)
    assert "from a scan's datagrams to its command's" in (report / "report.md").read_text()


def test_a_lane_is_judged_in_lockstep(graph: RosGraph, tmp_path: pathlib.Path) -> None:
    command = ["rosrun", "ardee_navigation", "judge_lane", "artificial", "--seed", "3"]
    words = ("--runs", "2", "--scans", "40", "--from-m", "0.5")
    for name in ("first", "again"):
        output = str(tmp_path / name)
        printed = graph.run(*command, *words, "--output", output, timeout_s=120.0)
        assert "| perceived width [m] | 0.768 | 0.7" in printed
    for name in ("lane.md", "lane.png"):
        first, again = (tmp_path / folder / name for folder in ("first", "again"))
        assert first.read_bytes().replace(b"/first", b"/again") == again.read_bytes()
