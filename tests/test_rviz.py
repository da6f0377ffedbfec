# SPDX-License-Identifier: MIT
"""Tests the saved rviz views of the README, drawn off-screen: every display is content, and the picture has colours."""
import json
import os
import pathlib
import re
import signal
import time
from typing import Any, Dict, Tuple

import numpy as np
import probes
import pytest
import rosgraph
import rospy
from bridge_bench import free_port
from PIL import Image as Picture
from sensor_msgs.msg import Image

from ardee_common.ros_graph import RosGraph, wait_until

ROOT = pathlib.Path(__file__).resolve().parents[1]
ROBOT_VIEW = ROOT / "src/terrasentia_description/config/rviz/waypoint_follower_paths.rviz"
WORLD_VIEW = ROOT / "src/ardee_world/rviz/world.rviz"
PICTURE = ROOT / "scripts/rviz_picture"
MIN_COLOURS = 1000  # an empty 3-D view has one


def draw(graph: RosGraph, config: pathlib.Path) -> Dict[str, Any]:
    """Returns statuses of a view's displays by name; checks the picture's colours."""
    picture, status = graph.folder / "rviz.png", graph.folder / "rviz.json"
    graph.run(
        str(PICTURE),
        str(config),
        "--output",
        str(picture),
        "--status",
        str(status),
        "--timeout-s",
        "60",
        timeout_s=150,
    )
    found = json.loads(status.read_text())
    pixels = np.asarray(Picture.open(picture).convert("RGB").crop(found["view_3d_px"]))
    assert len(np.unique(pixels.reshape(-1, 3), axis=0)) > MIN_COLOURS
    return {display["name"]: display for display in found["displays"] if display["enabled"]}


def child_of(pid: int) -> int:
    """Returns the child of a picture's process in which rviz runs, not Xvfb."""
    children = pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
    names = {child: pathlib.Path(f"/proc/{child}/comm").read_text().strip() for child in children}
    (found,) = [int(child) for child, name in names.items() if name != "Xvfb"]
    return found


def assert_content(displays: Dict[str, Any]) -> None:
    assert displays
    for name, display in displays.items():
        assert display["status"] == "Ok", f"{name}: {display}"
        if display["topic"]:
            assert display["messages"] > 0, f"{name}: {display}"


def test_robot_in_the_field(graph: RosGraph) -> None:
    graph.launch("ardee_world", "custom_world.launch", "world:=farm.world")
    graph.call(probes.clock_at_least, 0.2)
    graph.launch("terrasentia_description", "launch_default_tsv1.launch", "use_rviz:=false")
    graph.call(probes.wait_for_topics, ["/odom", "/ardee/hokuyo"], [])
    graph.spawn("rosrun", "terrasentia_description", "camera_preview")
    displays = draw(graph, ROBOT_VIEW)
    assert_content(displays)
    assert {"Front camera", "Left camera"} <= displays.keys()
    assert "URDF parsed OK" in displays["RobotModel"]["lines"].values()


def preview_of(camera: str) -> Tuple[Tuple[int, int, str], int, int]:
    """Returns size and encoding of a camera's preview, and the camera's subscribers then and 3 s later."""
    rospy.init_node("probe", anonymous=True, disable_signals=True)
    topic = f"/ardee/camera/{camera}"
    image = rospy.wait_for_message(f"{topic}/preview", Image, timeout=30.0)
    counts = []
    for wait_s in (0.0, 3.0):
        time.sleep(wait_s)
        _, subscribed, _ = rosgraph.Master("/test").getSystemState()
        counts.append(len(dict(subscribed).get(f"{topic}/image_raw", [])))
    return (image.width, image.height, image.encoding), counts[0], counts[1]


def test_a_preview_takes_pictures_only_while_it_is_looked_at(graph: RosGraph) -> None:
    graph.launch("ardee_world", "custom_world.launch", "world:=farm.world")
    graph.call(probes.clock_at_least, 0.2)
    graph.launch("terrasentia_description", "launch_default_tsv1.launch", "use_rviz:=false")
    node = graph.spawn("rosrun", "terrasentia_description", "camera_preview")
    shape, _, later = graph.call(preview_of, "front")
    assert shape == (320, 240, "rgb8") and later == 0
    node.interrupt()
    assert node.wait(20.0) == 0 and node.output() == ""


def test_a_launch_with_rviz_prints_nothing_yellow_or_red(graph: RosGraph) -> None:
    screen = graph.spawn("Xvfb", "-displayfd", "1", "-screen", "0", "1280x960x24")
    # Xvfb also tells of each display that another server has taken.
    number = wait_until(lambda: re.search(r"^\d+$", screen.output(), re.M), "the display's number")
    graph.env.update(DISPLAY=f":{number[0]}", LIBGL_ALWAYS_SOFTWARE="1", QT_X11_NO_MITSHM="1")
    world = graph.launch("ardee_world", "custom_world.launch", "world:=farm.world", "gui:=true")
    graph.call(probes.clock_at_least, 0.2)
    robot = graph.launch("terrasentia_description", "launch_default_tsv1.launch", "use_joy:=false")
    graph.call(probes.wait_for_topics, ["/odom", "/ardee/camera/front/preview"], [])
    for launch in (robot, world):
        launch.interrupt()
        launch.wait(60.0)
        assert "started roslaunch server" in launch.output()
        bad = re.findall(r".*(?:\033\[3[13]m|WARN|ERROR|Traceback).*", launch.output())
        # rospy's word for a subscriber that left while it connected: the one of this test.
        assert not [line for line in bad if "Inbound TCP/IP connection failed" not in line]


def test_world_alone(graph: RosGraph) -> None:
    graph.launch("ardee_world", "custom_world.launch", "world:=farm.world")
    graph.call(probes.clock_at_least, 0.2)
    displays = draw(graph, WORLD_VIEW)
    assert displays["Scenery"]["status"] == "Ok"
    assert displays["Scenery"]["messages"] > 0


@pytest.mark.parametrize("crashes, code", [(1, 0), (3, 1)])
def test_crashes_of_rviz_are_forgiven_twice(graph: RosGraph, crashes: int, code: int) -> None:
    picture = graph.folder / "again.png"
    command = str(PICTURE), str(WORLD_VIEW), "--output", str(picture), "--timeout-s", "1"
    process = graph.spawn(*command)
    for count in range(crashes):
        wait_until(lambda: process.output().count("OpenGl version") > count, "a window of rviz")
        os.kill(child_of(process.pid), signal.SIGSEGV)
    assert process.wait(60.0) == code
    notes = [line for line in process.output().splitlines() if line.startswith("rviz_picture:")]
    again = [line for line in notes if line.endswith(" and is started again")]
    assert 1 <= len(again) <= 2  # it may crash by itself, too
    assert "rviz_picture: rviz ended by signal 11 and is started again" in again
    assert [line.startswith("rviz_picture: rviz ended") for line in notes] == [True] * len(notes)
    assert len(notes) == len(again) + code
    assert picture.exists() == (code == 0)


def test_without_a_master_it_ends_in_time(graph: RosGraph) -> None:
    uri = f"http://127.0.0.1:{free_port()}"
    picture, started_s = graph.folder / "none.png", time.monotonic()
    command = (str(PICTURE), str(WORLD_VIEW), "--output", str(picture), "--timeout-s", "1")
    process = graph.spawn(*command, ROS_MASTER_URI=uri)
    assert process.wait(60.0) == 1 and time.monotonic() - started_s > 1.0
    assert process.output() == f"rviz_picture: found no ROS master at {uri} within 1 s\n"
    assert not picture.exists()
