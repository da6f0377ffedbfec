# SPDX-License-Identifier: MIT
"""Tests the shell scripts of thesis 4.6.3: a field and a terrain put together, the dialogue, the clean shutdown."""
import os
import pathlib
import subprocess

import numpy as np
import probes
import pytest
from test_drive_row import drive_row

from ardee_common.ros_graph import RosGraph, wait_until

SCRIPTS = pathlib.Path(__file__).resolve().parents[1] / "scripts"
LISTING_4_4 = ("ardee_world/urdf/corn_plot.urdf.xacro", "ardee_models/heightmap_ground")
QUESTION = "Do you want to continue? Enter (y) or (n)"


def _left(graph: RosGraph) -> bool:
    return not graph.alive()


@pytest.mark.parametrize("script", ["run_custom_world", "run_demo_world"])
def test_ctrl_c_ends_world_and_robot_and_nothing_else(graph: RosGraph, script: str) -> None:
    bystander = graph.spawn("rostopic", "echo", "/clock")
    names = LISTING_4_4 if script == "run_custom_world" else ()
    run = graph.spawn(str(SCRIPTS / script), "-y", *names, "use_rviz:=false")
    graph.call(probes.wait_for_topics, ["/odom", "/ardee/hokuyo"], [])
    assert graph.call(probes.clock_at_least, 0.5) >= 0.5
    run.interrupt()
    assert run.wait(60.0) == 0
    assert "_____ CTRL-C Triggered [EXITING] _____" in run.output()
    assert "***** Simulation Exited *****" in run.output() and "escalating" not in run.output()
    assert bystander.exit_code() is None
    bystander.stop()
    wait_until(lambda: _left(graph), f"all ended; left: {graph.alive()}", 10.0)


@pytest.mark.parametrize("argument", ["use_rvis:=false", "world:=empty.world"])
def test_an_argument_of_neither_launch_file_is_refused(argument: str) -> None:
    run = subprocess.run(
        [str(SCRIPTS / "run_custom_world"), "-y", argument], stderr=subprocess.PIPE, timeout=60
    )
    message = run.stderr.decode()
    assert run.returncode == 2
    assert f"found {argument}, expected an argument of the world (gui headless paused" in message
    assert message.count("\n") == 1


@pytest.mark.parametrize("answer", [b"n", b""])
def test_no_ends_it_and_so_does_the_end_of_input(graph: RosGraph, answer: bytes) -> None:
    result = subprocess.run(
        [str(SCRIPTS / "run_custom_world"), *LISTING_4_4],
        env=graph.env,
        input=answer,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        timeout=90,
    )
    text = result.stdout.decode()
    assert result.returncode == 0 and QUESTION in text and text.endswith("Simulation Exited\n")
    assert "spawn_terrasentia" not in text
    wait_until(lambda: _left(graph), f"all ended; left: {graph.alive()}", 10.0)


def test_without_names_the_world_is_empty_and_its_files_can_be_kept(
    graph: RosGraph, tmp_path: pathlib.Path
) -> None:
    kept = tmp_path / "kept"
    run = graph.spawn(str(SCRIPTS / "run_custom_world"), "-o", str(kept))
    assert run.wait(90.0) == 0 and QUESTION in run.output()
    assert "empty.urdf.xacro ardee_models/heightmap_flat ardee_geofence/" in run.output()
    made = {str(p.relative_to(kept)) for p in kept.rglob("*") if p.is_file()}
    for name in ("worlds/custom.world", "models/custom_field/plots.xacro"):
        assert name in made
    geofence = (kept / "ardee_geofence" / "custom_gps_behavior.geofence").read_bytes()
    source = SCRIPTS.parent / "src" / "ardee_geofence" / "default_gps_behavior.geofence"
    assert geofence == source.read_bytes()


def test_a_field_of_ones_own_stands_where_plots_truth_and_start_say(
    graph: RosGraph, tmp_path: pathlib.Path
) -> None:
    """Follows the README's sequence: the robot looks into a lane, and the GPS's plot is around the plants."""
    words = [
        "--models",
        "corn_variant_8",
        "--rows-per-plot",
        "4",
        "--row-length-m",
        "5",
        "--seed",
        "1",
    ]
    words += ["--terrain", "heightmap_ground", "--name", "my_field", "--output", str(tmp_path)]
    graph.run("rosrun", "ardee_world", "generate_field", *words)
    recipe = SCRIPTS.parent / "src" / "ardee_world" / "terrains" / "heightmap_rough.yaml"
    words = [str(recipe), "--name", "my_ground", "--output", str(tmp_path)]
    graph.run("rosrun", "ardee_models", "generate_terrain", *words)
    names = [str(tmp_path / "my_field/my_field.urdf.xacro"), str(tmp_path / "my_ground")]
    graph.spawn(str(SCRIPTS / "run_custom_world"), "-y", *names, "use_rviz:=false")
    scan = graph.call(probes.collect, "/ardee/hokuyo", "sensor_msgs/LaserScan", 5)[-1]
    angles = scan.angle_min + scan.angle_increment * np.arange(len(scan.ranges))
    middle_m, slope, half_width_m = drive_row.row_ahead(np.array(scan.ranges), angles)
    assert abs(middle_m) < 0.2 and abs(slope) < 0.2  # leaves hang into the lane
    assert half_width_m == pytest.approx(0.762 / 2, abs=0.08)
    states = [("my_field", -1.57), ("TerraSentia_0", -1.57 - np.pi / 2)]
    for name, yaw in states:
        service = ("/gazebo/get_model_state", "gazebo_msgs/GetModelState", {"model_name": name})
        answer = graph.call(probes.call_service, *service)
        assert answer.success
        pose = answer.pose
        turn = 2.0 * np.arctan2(pose.orientation.z, pose.orientation.w)
        assert np.hypot(pose.position.x, pose.position.y) < 0.05
        assert abs(np.sin((turn - yaw) / 2.0)) < 0.02


def test_without_names_the_gps_sees_the_open_sky(graph: RosGraph) -> None:
    run = graph.spawn(str(SCRIPTS / "run_custom_world"), "-y", "use_rviz:=false")
    fix = graph.call(probes.collect, "/ardee/gps", "sensor_msgs/NavSatFix", 1)[0]
    assert fix.status.status >= 0 and np.isfinite(fix.latitude)
    quality = graph.call(probes.collect, "/ardee/gps/data", "ardee_msgs/GpsQuality", 1)[0]
    assert quality.region == "" and quality.has_fix
    assert "left out" not in run.output()


def test_a_field_stands_where_the_user_says_with_its_origin_on_the_earth(
    graph: RosGraph, tmp_path: pathlib.Path
) -> None:
    x, y, turn = 5.0, 2.0, 0.5
    words = [
        "--models",
        "corn_variant_8",
        "--rows-per-plot",
        "2",
        "--row-length-m",
        "3",
        "--seed",
        "1",
    ]
    words += ["--gps-origin-deg", "52", "6", "--name", "my_field", "--output", str(tmp_path)]
    graph.run("rosrun", "ardee_world", "generate_field", *words)
    kept, field = tmp_path / "kept", str(tmp_path / "my_field/my_field.urdf.xacro")
    words = ["-y", "-o", str(kept), "-p", str(x), str(y), str(turn), field]
    graph.spawn(str(SCRIPTS / "run_custom_world"), *words, "use_rviz:=false")
    fix = graph.call(probes.collect, "/ardee/gps", "sensor_msgs/NavSatFix", 1)[0]
    states = graph.call(probes.collect, "/gazebo/model_states", "gazebo_msgs/ModelStates", 1)[0]
    poses = dict(zip(states.name, states.pose))
    for name, yaw in (("my_field", turn), ("TerraSentia_0", turn - np.pi / 2)):
        pose = poses[name]
        assert np.hypot(pose.position.x - x, pose.position.y - y) < 0.05
        turned = 2.0 * np.arctan2(pose.orientation.z, pose.orientation.w)
        assert abs(np.sin((turned - yaw) / 2.0)) < 0.02
    # the antenna is 0.14 m behind; a degree at 52 degrees north is 111,267 m north and 68,678 m east
    east_m, north_m = x - 0.14 * np.sin(turn), y + 0.14 * np.cos(turn)
    assert (fix.latitude - 52.0) * 111_267.0 == pytest.approx(north_m, abs=0.06)
    assert (fix.longitude - 6.0) * 68_678.0 == pytest.approx(east_m, abs=0.06)
    truth = np.genfromtxt(
        kept / "models/custom_field/truth.csv", delimiter=",", names=True, dtype=None, encoding=None
    )
    plants = np.array([truth["world_x_m"].mean(), truth["world_y_m"].mean()])
    # the robot's lane is the field's: 1 m of headland, then rows of 3 m, of which the middle is 2.5 m ahead
    ahead = np.array([np.sin(turn), -np.cos(turn)])
    assert plants == pytest.approx([x, y] + 2.5 * ahead, abs=0.3)
    regions = graph.call(probes.collect, "/ardee/gps/regions", "visualization_msgs/MarkerArray", 1)[
        0
    ]
    boxes = [m for m in regions.markers if m.action == m.ADD and m.type == m.CUBE]
    assert len(boxes) == 1
    middle = boxes[0].pose.position
    assert (middle.x, middle.y) == pytest.approx(tuple([x, y] + 2.5 * ahead), abs=0.05)


@pytest.mark.parametrize("words", [("-p", "1", "2"), ("-p", "1", "2", "north")])
def test_a_pose_that_is_none_is_refused(graph: RosGraph, words: tuple) -> None:
    run = graph.spawn(str(SCRIPTS / "run_custom_world"), *words)
    assert run.wait(60.0) == 2
    assert "X Y YAW" in run.output() or "argument --world-pose: invalid" in run.output()


def test_a_running_simulator_is_left_alone(graph: RosGraph) -> None:
    world = graph.launch("ardee_world", "custom_world.launch", "world:=empty.world")
    graph.call(probes.clock_at_least, 0.1)
    run = graph.spawn(str(SCRIPTS / "run_custom_world"), "-y")
    assert run.wait(60.0) == 2 and "a simulator runs at" in run.output()
    assert world.exit_code() is None


@pytest.mark.parametrize("names", [("no.urdf.xacro",), (LISTING_4_4[0], "no_terrain")])
def test_what_is_not_there_is_said_once(graph: RosGraph, names: tuple) -> None:
    before = set(os.listdir(graph.folder))
    run = graph.spawn(str(SCRIPTS / "run_custom_world"), "-y", *names)
    assert run.wait(60.0) == 2
    assert run.output().count("assemble_world: ") == 1 and "roslaunch" not in run.output()
    assert set(os.listdir(graph.folder)) - before <= {run.log.name}
