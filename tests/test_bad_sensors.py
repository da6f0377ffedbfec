# SPDX-License-Identifier: MIT
"""Tests robots with impossible sensors: each is spawned without that sensor, and the simulator says why once."""
import pathlib
import re
from typing import Iterator, List, NamedTuple, Tuple

import probes
import pytest
from gazebo_calls import call, pose, spawn

from ardee_common.ros_graph import RosGraph

STEP_S = 0.005
WORLD = f"""<sdf version="1.5"><world name="default"><physics type="ode">
  <max_step_size>{STEP_S}</max_step_size></physics></world></sdf>"""
ROBOT = """<robot name="{name}" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:property name="robot_namespace" value="/{name}" />
  <xacro:include filename="$(find ardee_sensors)/urdf/all_sensors.urdf.xacro" />
  <link name="base_footprint">
    <xacro:inertial_box mass="1" x="0.4" y="0.4" z="0.1"><origin xyz="0 0 0" /></xacro:inertial_box></link>
  <link name="wheel">
    <xacro:inertial_box mass="1" x="0.1" y="0.1" z="0.1"><origin xyz="0 0 0" /></xacro:inertial_box></link>
  <joint name="axle" type="continuous">
    <parent link="base_footprint" /><child link="wheel" /><axis xyz="0 1 0" /></joint>
  <xacro:sensor_sonar name="good" parent="base_footprint"><origin xyz="0.5 0 0" /></xacro:sensor_sonar>
  {call}
</robot>"""


class Bad(NamedTuple):
    """A macro's name, its bad arguments, the topic that must not appear, and the text of the one message."""

    macro: str
    arguments: str
    topic: str
    said: Tuple[str, ...]


TEXTS = {
    "no.plots": "<robot />",
    "not_xml.geofence": "a fence about a field",
    "crossed.geofence": "<geofence><field_gps_noise_characteristics><biomass_height_noise_coefficient>"
    "<r1>tall</r1><r2>1</r2><mean>1</mean><variance>1</variance></biomass_height_noise_coefficient>"
    "</field_gps_noise_characteristics></geofence>",
}
BAD = {
    "unknown_joint": Bad("encoder", 'joint="no_such_joint"', "ticks", ("no_such_joint", "<joint>")),
    "zero_encoder_rate": Bad(
        "encoder", 'joint="axle" update_rate="0"', "ticks", ("<updateRate>", "found 0")
    ),
    "zero_battery_rate": Bad(
        "approx_battery", 'rate_hz="0"', "ardee/bad", ("<updateRate>", "found 0")
    ),
    "negative_lidar_rate": Bad(
        "hokuyo_ust10lx", 'rate_hz="-40"', "ardee/bad", ("<update_rate>", "found -40")
    ),
    "lidar_rate_of_words": Bad(
        "hokuyo_ust10lx", 'rate_hz="fast"', "ardee/bad", ("<update_rate>", "found 'fast'")
    ),
    "infinite_camera_rate": Bad(
        "kinect", 'rate_hz="inf"', "ardee/bad/rgb/image_raw", ("<update_rate>", "found 'inf'")
    ),
    "negative_gps_noise": Bad(
        "gps", 'noise="-0.1"', "ardee/bad", ("<gaussianNoise>", "below zero")
    ),
    "negative_lidar_noise": Bad(
        "hokuyo_ust10lx", 'noise_std_m="-0.01"', "ardee/bad", ("<stddev>", "found -0.01")
    ),
    "negative_range_resolution": Bad(
        "hokuyo_ust10lx", 'range_resolution_m="-1"', "ardee/bad", ("<resolution>", "found -1")
    ),
    "namespace_with_a_blank": Bad(
        "sonar", 'robot_namespace="a b"', "ardee/bad", ("found 'a b' as a namespace", "valid name")
    ),
    "image_too_large": Bad(
        "ueye_cp_gige",
        'width_px="8000" height_px="8000"',
        "ardee/bad/image_raw",
        ("8000", "<image>"),
    ),
    "missing_plots": Bad(
        "gps_with_dropout",
        'plots_file="/nowhere/plots.xacro"',
        "ardee/bad",
        ("/nowhere/plots.xacro",),
    ),
    "empty_plots": Bad(
        "gps_with_dropout",
        'plots_file="{folder}/no.plots"',
        "ardee/bad",
        ("no.plots:1: <robot>", "found nothing in it", "periodic_noise_box"),
    ),
    "broken_geofence": Bad(
        "gps_with_dropout",
        'geofence_file="{folder}/not_xml.geofence"',
        "ardee/bad",
        ("not_xml.geofence",),
    ),
    "wrong_number_in_geofence": Bad(
        "gps_with_dropout",
        'geofence_file="{folder}/crossed.geofence"',
        "ardee/bad",
        ("crossed.geofence", "<r1>", "tall"),
    ),
}


MASSLESS = "massless"  # a valid robot: a sensor may have no mass


def robot(name: str, folder: pathlib.Path) -> str:
    """Returns a robot's xacro file: a good sonar, and the bad sensor."""
    bad = BAD.get(name) or Bad("kinect", 'mass_kg="0"', "", ())
    arguments = bad.arguments.format(folder=folder)
    if bad.macro == "encoder":
        call = (
            f'<xacro:sensor_encoder parent="base_footprint" name="bad" topic="ticks" {arguments} />'
        )
    else:
        macro = f"xacro:sensor_{bad.macro}"
        call = f'<{macro} name="bad" parent="base_footprint" {arguments}><origin xyz="0 0 0.5" /></{macro}>'
    return ROBOT.format(name=name, call=call)


@pytest.fixture(scope="module")
def complaints(
    shared_graph: RosGraph, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[List[str]]:
    """Yields warnings and errors of a paused simulator in which all of the robots are spawned."""
    folder = tmp_path_factory.mktemp("bad_sensors")
    (folder / "empty.world").write_text(WORLD)
    for name, text in TEXTS.items():
        (folder / name).write_text(text)
    simulator = shared_graph.spawn(
        "rosrun", "ardee_sim_cpp", "simulator", str(folder / "empty.world"), "--paused"
    )
    calls = []
    for name in [*BAD, MASSLESS]:
        file = folder / f"{name}.urdf.xacro"
        file.write_text(robot(name, folder))
        xml = shared_graph.run("rosrun", "xacro", "xacro", str(file))
        calls.append(spawn(name, xml, pose(), "urdf", robot_namespace="/" + name))
    answers = call(shared_graph, *calls)
    assert [
        (fields["model_name"], a.status_message)
        for (*_, fields), a in zip(calls, answers)
        if not a.success
    ] == []
    yield [line for line in simulator.output().splitlines() if "WARN" in line or "ERROR" in line]


@pytest.mark.parametrize("name", BAD)
def test_one_message_and_the_robot_without_it(
    shared_graph: RosGraph, complaints: List[str], name: str
) -> None:
    own = [line for line in complaints if f"'{name}'" in line]
    assert len(own) == 1, complaints
    assert re.search(r"(sensor|plugin) 'bad_\w+' \(\w+\.so\) is left out: ", own[0]), own[0]
    assert all(said in own[0] for said in BAD[name].said), own[0]


def test_the_rest_of_each_robot_is_there(shared_graph: RosGraph, complaints: List[str]) -> None:
    assert len(complaints) == len(BAD)
    published = shared_graph.call(probes.topics)
    for name, bad in BAD.items():
        assert published.get(f"/{name}/ardee/good") == "sensor_msgs/Range", name
        assert f"/{name}/{bad.topic}" not in published
    assert published.get(f"/{MASSLESS}/ardee/bad/depth/points") == "sensor_msgs/PointCloud2"
