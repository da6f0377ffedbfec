# SPDX-License-Identifier: MIT
"""What a lidar sees between rows: sorghum is more cluttered than corn, late corn than early (thesis 5.2)."""
import json
import os
import pathlib
import re
from typing import List

import numpy as np
import probes
import pytest
from ros_graph import RosGraph, wait_until

from ardee_models.terrain_files import ground_model

WORLDS = pathlib.Path(__file__).resolve().parents[1] / "src" / "ardee_world" / "worlds"
MODEL_PATH = [pathlib.Path(p) for p in os.environ["GAZEBO_MODEL_PATH"].split(":") if p]
RANGE_M, NEAR_M, HEIGHT_M, BEAMS = 10.0, 1.5, 0.3, 1081
LANE_HALF_WIDTH_M, END_RAD = 0.25, 2.35619
# In all these worlds the middle lane lies on y = 0 and the rows, of 5 m or more, begin at x = -1 m.
POSTS_X_M = (-1.5, -2.5, -3.5, -4.5, -5.5)
INNER_POSTS_X_M = (-4.0, -5.5, -7.0, -8.5, -10.0)  # of rows of 13 m
POST = """
<model name="post{number}"><static>true</static><pose>{x} 0 {z} 0 0 3.14159</pose><link name="lidar">
  <sensor type="gpu_ray" name="lidar"><update_rate>20</update_rate>
    <ray>
      <scan><horizontal><samples>{beams}</samples><resolution>1</resolution>
        <min_angle>-{end}</min_angle><max_angle>{end}</max_angle></horizontal></scan>
      <range><min>0.02</min><max>{range}</max></range>
    </ray>
    <plugin name="lidar{number}" filename="libgazebo_ros_gpu_laser.so">
      <robotNamespace>post{number}</robotNamespace>
      <topicName>scan</topicName><frameName>lidar</frameName>
    </plugin>
  </sensor></link></model>
"""


def scans(topics: List[str], timeout_s: float = 60.0) -> List[List[float]]:
    """Probe: the ranges [m] of one scan of each topic."""
    import rospy
    from sensor_msgs.msg import LaserScan

    probes._start()
    found = {}  # type: dict
    for topic in topics:
        rospy.Subscriber(topic, LaserScan, lambda scan, name: found.setdefault(name, scan), topic)
    wait_until(lambda: len(found) == len(topics), f"a scan of each of {topics}", timeout_s)
    return [list(found[topic].ranges) for topic in topics]


def measure(graph: RosGraph, world: str, posts_x_m: tuple = POSTS_X_M, **env: str) -> np.ndarray:
    """Ranges [m] of lidars HEIGHT_M above the lane, a row each; nothing in reach counts as RANGE_M."""
    ground = ground_model(re.search(r"model://(heightmap_\w+)", world).group(1), MODEL_PATH)
    at_z = ground.height_at(np.array(posts_x_m), np.zeros(len(posts_x_m))) + HEIGHT_M
    posts = "".join(
        POST.format(number=number, x=x, z=z, beams=BEAMS, range=RANGE_M, end=END_RAD)
        for number, (x, z) in enumerate(zip(posts_x_m, at_z.tolist()))
    )
    file = graph.folder / "posts.world"
    file.write_text(world.replace("</world>", posts + "</world>"))
    simulator = graph.spawn("rosrun", "ardee_sim_cpp", "simulator", str(file), **env)
    topics = [f"/post{number}/scan" for number in range(len(posts_x_m))]
    ranges = np.array(graph.call(scans, topics))
    simulator.stop()
    assert ranges.shape == (len(posts_x_m), BEAMS) and not np.isnan(ranges).any()
    return np.clip(ranges, 0.0, RANGE_M)


def near_share(ranges: np.ndarray) -> float:
    """Share of the beams that end within NEAR_M."""
    return float(np.mean(ranges < NEAR_M))


def lane_share(ranges: np.ndarray) -> float:
    """Share of the beams that end on something in the lane, LANE_HALF_WIDTH_M or less from its middle."""
    across_m = np.abs(ranges * np.sin(np.linspace(-END_RAD, END_RAD, BEAMS)))
    return float(np.mean((ranges < RANGE_M) & (across_m < LANE_HALF_WIDTH_M)))


def shipped(name: str) -> str:
    """Text of a world of ardee_world."""
    return (WORLDS / f"{name}.world").read_text()


def season_models(season: str) -> List[str]:
    """The corn models of a season, of those that the build makes."""
    paths = (p for folder in MODEL_PATH for p in folder.glob("corn_variant_*/metrics.json"))
    seasons = {path.parent.name: json.loads(path.read_text())["season"] for path in paths}
    return sorted(name for name, found in seasons.items() if found == season)


def season_field(graph: RosGraph, season: str, folder: pathlib.Path) -> None:
    """A field of all corn models of a season, wide enough that few beams leave it."""
    models = season_models(season)
    assert len(models) >= 5
    graph.run(
        *("rosrun", "ardee_world", "generate_field", "--models", *models, "--name", season),
        *("--rows", "10", "--row-length", "13", "--terrain", "heightmap_ground"),
        *("--seed", "2", "--output", str(folder)),
    )


@pytest.mark.parametrize(
    "corn_world, sorghum_world", [("scenario_2_corn", "scenario_3_sorghum"), ("corn", "sorghum")]
)
def test_sorghum_is_denser_and_more_cluttered_than_corn(
    graph: RosGraph, corn_world: str, sorghum_world: str
) -> None:
    corn, sorghum = (measure(graph, shipped(name)) for name in (corn_world, sorghum_world))
    medians_m = [float(np.median(ranges)) for ranges in (corn, sorghum)]
    shares = [near_share(ranges) for ranges in (corn, sorghum)]
    print(f"corn, sorghum: medians {medians_m} m, shares within {NEAR_M} m {shares}")
    assert medians_m[1] < 0.9 * medians_m[0]
    assert shares[1] > shares[0] + 0.02
    assert 0.2 < min(shares) and max(shares) < 0.9  # both are fields, and neither is a wall


def test_early_corn_lets_the_beam_farther_than_late(
    graph: RosGraph, tmp_path: pathlib.Path
) -> None:
    fields = tmp_path / "fields"
    model_path = os.pathsep.join([str(fields), os.environ["GAZEBO_MODEL_PATH"]])
    found = {}
    for season in ("early", "late"):
        season_field(graph, season, fields)
        world = shipped("scenario_2_corn").replace("scenario-2-corn-plot", season)
        assert f"<uri>model://{season}</uri>" in world
        found[season] = measure(graph, world, INNER_POSTS_X_M, GAZEBO_MODEL_PATH=model_path)
    medians_m = {season: float(np.median(ranges)) for season, ranges in found.items()}
    in_lane = {season: lane_share(ranges) for season, ranges in found.items()}
    print(f"medians {medians_m} m, shares that end in the lane {in_lane}")
    assert medians_m["early"] > 1.05 * medians_m["late"]
    # The leaves of late corn reach into the lane; those of early corn hardly do.
    assert in_lane["late"] > 2.0 * in_lane["early"]
