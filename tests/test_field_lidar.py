# SPDX-License-Identifier: MIT
"""Tests lidar ranges between rows: sorghum is more cluttered than corn, late corn than early (thesis 5.2).

Each claim is a statistic over fields that differ only in their seed: a field is one sample, and two kinds of
field are compared in pairs of the same seed by Student's t-test, one-sided, at CONFIDENCE.
"""
import json
import os
import pathlib
from typing import Callable, Dict, List, Tuple

import numpy as np
import probes
import pytest
from scipy import stats

from ardee_common.ros_graph import RosGraph, wait_until
from ardee_world.generate_field import make_configured
from ardee_world.request import yaml_values

PLANS = pathlib.Path(__file__).resolve().parents[1] / "src" / "ardee_world" / "fields"
MODEL_PATH = [pathlib.Path(p) for p in os.environ["GAZEBO_MODEL_PATH"].split(":") if p]
SEEDS = range(1, 13)
CONFIDENCE = 0.99
RANGE_M, NEAR_M, HEIGHT_M, BEAMS = 10.0, 1.5, 0.3, 1081
LANE_HALF_WIDTH_M, END_RAD = 0.25, 2.35619
FIELD_STEP_M = 60.0  # distance of the fields of a world: farther than the lidars see
POSTS_M = (1.0, 1.75, 2.5, 3.25, 4.0)  # along rows of 5 m, from the entrance
SEASON_ROW_M, SEASON_POSTS_M = 13.0, (4.5, 5.5, 6.5, 7.5, 8.5)
POST = """
<model name="{name}"><static>true</static><pose>{x} {y} {z} 0 0 0</pose><link name="lidar">
  <sensor type="gpu_ray" name="lidar"><update_rate>20</update_rate>
    <ray>
      <scan><horizontal><samples>{beams}</samples><resolution>1</resolution>
        <min_angle>-{end}</min_angle><max_angle>{end}</max_angle></horizontal></scan>
      <range><min>0.02</min><max>{range}</max></range>
    </ray>
    <plugin name="lidar" filename="libgazebo_ros_gpu_laser.so">
      <robotNamespace>{name}</robotNamespace>
      <topicName>scan</topicName><frameName>lidar</frameName>
    </plugin>
  </sensor></link></model>
"""
GROUND = """
<model name="ground"><static>true</static><link name="link">
  <collision name="c"><geometry><plane/></geometry></collision></link></model>
"""


def scans(topics: List[str], timeout_s: float = 60.0) -> List[List[float]]:
    """Returns, as a probe, the ranges [m] of one scan of each topic."""
    import rospy
    from sensor_msgs.msg import LaserScan

    probes._start()
    found = {}  # type: dict
    for topic in topics:
        rospy.Subscriber(topic, LaserScan, lambda scan, name: found.setdefault(name, scan), topic)
    wait_until(lambda: len(found) == len(topics), f"a scan of each of {topics}", timeout_s)
    return [list(found[topic].ranges) for topic in topics]


def season_models(season: str) -> List[str]:
    """Returns the corn models of a season among those that the build makes."""
    paths = (p for folder in MODEL_PATH for p in folder.glob("corn_variant_*/metrics.json"))
    seasons = {path.parent.name: json.loads(path.read_text())["season"] for path in paths}
    return sorted(name for name, found in seasons.items() if found == season)


def thesis_plot(name: str) -> dict:
    """Returns options of a plot of thesis 5.2."""
    return {**yaml_values(PLANS / f"{name}.yaml"), "terrain": None}


def season_plot(season: str) -> dict:
    """Returns options of a field of all corn models of a season, wide enough that few beams leave it."""
    models = season_models(season)
    assert len(models) >= 5
    return {"models": tuple(models), "rows": 10, "row_length_m": SEASON_ROW_M}


KINDS: Dict[str, Tuple[Callable[[], dict], Tuple[float, ...]]] = {
    "corn": (lambda: thesis_plot("scenario-2-corn-plot"), POSTS_M),
    "sorghum": (lambda: thesis_plot("scenario-3-sorghum-plot"), POSTS_M),
    "early": (lambda: season_plot("early"), SEASON_POSTS_M),
    "late": (lambda: season_plot("late"), SEASON_POSTS_M),
}


@pytest.fixture(scope="module")
def scanned(
    shared_graph: RosGraph, tmp_path_factory: pytest.TempPathFactory
) -> Dict[str, np.ndarray]:
    """Returns kind of field to ranges [m] (seeds, posts, beams) HEIGHT_M above the lane; no hit counts as RANGE_M.

    All fields stand in one world, FIELD_STEP_M apart along y; rows run from the entrance at x = -1 m to smaller x.
    """
    fields = tmp_path_factory.mktemp("fields")
    world, topics = [GROUND], []  # type: Tuple[List[str], List[str]]
    for kind, (options, posts_m) in KINDS.items():
        for seed in SEEDS:
            name, y_m = f"{kind}_{seed}", FIELD_STEP_M * len(topics) / len(posts_m)
            make_configured(
                {**options(), "name": name, "output": str(fields), "seed": seed, "format": "sdf"}
            )
            include = (
                f"<include><uri>model://{name}</uri><pose>0 {y_m} 0 0 0 -1.5707963</pose></include>"
            )
            world.append(include)
            for number, along_m in enumerate(posts_m):
                post = f"{name}_{number}"
                where = dict(x=-1.0 - along_m, y=y_m, z=HEIGHT_M, end=END_RAD)
                world.append(POST.format(name=post, beams=BEAMS, range=RANGE_M, **where))
                topics.append(f"/{post}/scan")
    file = shared_graph.folder / "fields.world"
    file.write_text(f"<sdf version='1.6'><world name='fields'>{''.join(world)}</world></sdf>")
    model_path = os.pathsep.join([str(fields), os.environ["GAZEBO_MODEL_PATH"]])
    simulator = shared_graph.spawn(
        "rosrun", "ardee_sim_cpp", "simulator", str(file), GAZEBO_MODEL_PATH=model_path
    )
    ranges = np.array(shared_graph.call(scans, topics))
    simulator.stop()
    assert ranges.shape == (len(topics), BEAMS) and not np.isnan(ranges).any()
    per_kind = ranges.reshape(len(KINDS), len(SEEDS), -1, BEAMS)
    return dict(zip(KINDS, np.clip(per_kind, 0.0, RANGE_M)))


def medians_m(ranges: np.ndarray) -> np.ndarray:
    """Returns the median range of each field [m]."""
    return np.median(ranges.reshape(len(ranges), -1), axis=1)


def near_shares(ranges: np.ndarray) -> np.ndarray:
    """Returns the share of each field's beams that end within NEAR_M."""
    return np.mean(ranges < NEAR_M, axis=(1, 2))


def lane_shares(ranges: np.ndarray) -> np.ndarray:
    """Returns the share of each field's beams that end in the lane, LANE_HALF_WIDTH_M or less from its middle."""
    across_m = np.abs(ranges * np.sin(np.linspace(-END_RAD, END_RAD, BEAMS)))
    return np.mean((ranges < RANGE_M) & (across_m < LANE_HALF_WIDTH_M), axis=(1, 2))


def assert_greater(what: str, more: np.ndarray, less: np.ndarray) -> None:
    """Checks by a paired t-test over the seeds that the mean of `more` is above that of `less`, at CONFIDENCE."""
    p_value = float(stats.ttest_rel(more, less, alternative="greater").pvalue)
    print(
        f"{what}: {more.mean():.3f} +- {more.std(ddof=1):.3f} against {less.mean():.3f} +- "
        f"{less.std(ddof=1):.3f} over {len(more)} fields, p = {p_value:.2g}"
    )
    assert p_value < 1.0 - CONFIDENCE


def test_sorghum_is_denser_than_corn(scanned: Dict[str, np.ndarray]) -> None:
    corn, sorghum = scanned["corn"], scanned["sorghum"]
    assert_greater("median range [m], corn and sorghum", medians_m(corn), medians_m(sorghum))


def test_sorghum_is_more_cluttered_than_corn(scanned: Dict[str, np.ndarray]) -> None:
    corn, sorghum = scanned["corn"], scanned["sorghum"]
    shares = near_shares(sorghum), near_shares(corn)
    assert_greater(f"beams that end within {NEAR_M} m, sorghum and corn", *shares)
    assert 0.2 < min(map(np.mean, shares)) and max(map(np.mean, shares)) < 0.9  # not walls


def test_early_corn_lets_the_beam_farther_than_late(scanned: Dict[str, np.ndarray]) -> None:
    early, late = scanned["early"], scanned["late"]
    assert_greater("median range [m], early and late corn", medians_m(early), medians_m(late))
    # The leaves of late corn reach into the lane; those of early corn hardly do.
    lane = lane_shares(late), lane_shares(early)
    assert_greater("beams that end in the lane, late and early corn", *lane)
