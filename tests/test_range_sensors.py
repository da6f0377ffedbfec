# SPDX-License-Identifier: MIT
"""Tests range sensors over ROS before a wall 4 m away: topics, types and layouts."""
import math
import pathlib
import struct
from typing import Any, Dict, Iterator, List

import probes
import pytest
from test_services import call, pose, spawn

from ardee_common.ros_graph import RosGraph

DATA = pathlib.Path(__file__).parent / "data"
WALL_M, RINGS, COLUMNS = 4.0, 16, 91
TYPES = {
    "/velodyne_points": "sensor_msgs/PointCloud2",
    "/hokuyo3d": "sensor_msgs/PointCloud",
    "/ranger": "sensor_msgs/Range",
    "/sonar": "sensor_msgs/Range",
}


@pytest.fixture(scope="module")
def world(shared_graph: RosGraph) -> Iterator[RosGraph]:
    """Yields a mast with one of each range sensor, 1 m above level ground."""
    shared_graph.spawn("rosrun", "ardee_sim_cpp", "simulator", str(DATA / "plane.world"))
    shared_graph.call(probes.clock_at_least, 0.1)
    answer = call(
        shared_graph, spawn("mast", (DATA / "range_sensors.sdf").read_text(), pose(z=1.0))
    )[0]
    assert answer.success, answer.status_message
    yield shared_graph


def first(world: RosGraph, topic: str) -> Any:
    message = world.call(probes.collect, topic, TYPES[topic], 1)[0]
    assert message.header.frame_id == "mast"
    return message


def test_each_has_its_topic_and_type_and_the_broken_one_none(world: RosGraph) -> None:
    found = world.call(probes.topics)  # type: Dict[str, str]
    assert {topic: found.get(topic) for topic in TYPES} == TYPES
    assert "/broken" not in found


def test_velodyne_cloud(world: RosGraph) -> None:
    cloud = first(world, "/velodyne_points")
    fields = [(f.name, f.offset, f.datatype, f.count) for f in cloud.fields]
    assert fields == [
        ("x", 0, 7, 1),
        ("y", 4, 7, 1),
        ("z", 8, 7, 1),
        ("intensity", 16, 7, 1),
        ("ring", 20, 4, 1),
        ("label", 24, 6, 1),
        ("time", 28, 7, 1),
        ("instance", 12, 6, 1),
    ]
    assert (cloud.point_step, cloud.height, cloud.is_bigendian, cloud.is_dense) == (
        32,
        1,
        False,
        True,
    )
    assert cloud.width == RINGS * COLUMNS  # the wall, and the ground before it, fill the view
    assert cloud.row_step == len(cloud.data) == 32 * cloud.width
    points = list(struct.iter_unpack("<fff4xfH2xI4x", cloud.data))
    assert [ring for *_, ring, _ in points] == list(range(RINGS)) * COLUMNS
    for x, y, z, intensity, _, label in points:
        assert x == pytest.approx(WALL_M, abs=1e-5)
        assert intensity == pytest.approx(WALL_M / math.sqrt(x * x + y * y + z * z), abs=1e-5)
        assert label == 0
    azimuths = [math.atan2(y, x) for x, y, *_ in points[::RINGS]]
    assert azimuths == pytest.approx([-0.45 + 0.01 * k for k in range(COLUMNS)], abs=1e-6)


def test_block_laser_cloud(world: RosGraph) -> None:
    cloud = first(world, "/hokuyo3d")
    assert len(cloud.points) == 33
    assert [channel.name for channel in cloud.channels] == [""]
    assert len(cloud.channels[0].values) == 33
    assert [point.x for point in cloud.points] == pytest.approx([WALL_M] * 33, abs=1e-5)


def test_range(world: RosGraph) -> None:
    reading = first(world, "/ranger")
    assert reading.radiation_type == reading.INFRARED
    told = [reading.range, reading.field_of_view, reading.min_range, reading.max_range]
    assert told == pytest.approx([WALL_M, 0.04, 0.1, 10.0], abs=1e-5)


def test_sonar(world: RosGraph) -> None:
    readings = world.call(probes.collect, "/sonar", TYPES["/sonar"], 3)  # type: List[Any]
    times = [reading.header.stamp.to_sec() for reading in readings]
    assert [b - a for a, b in zip(times, times[1:])] == pytest.approx([0.1, 0.1])
    reading = readings[0]
    assert reading.radiation_type == reading.ULTRASOUND
    told = [reading.range, reading.field_of_view, reading.min_range, reading.max_range]
    assert told == pytest.approx([3.0, 0.1, 0.1, 3.0], abs=1e-5)  # the wall is beyond its reach
