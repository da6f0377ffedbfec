# SPDX-License-Identifier: MIT
"""Tests overlays: readers, what is perceived in walls, distances, and a simulated run as the real one."""
import csv
import re
from pathlib import Path
from typing import Dict

import numpy as np
import pytest
from ardee_sim import LidarReading
from browser import NEEDS, look_at
from small_campaign import run, write

from ardee_campaigns import tables
from ardee_campaigns.__main__ import main
from ardee_campaigns.lane.real_run import read_scans, write_scans
from ardee_campaigns.lane.scans import Scans
from ardee_campaigns.overlay import figures
from ardee_campaigns.overlay.look import QUANTITIES, compare, distance, look
from ardee_campaigns.overlay.sources import read_recorded
from ardee_campaigns.replay import ScanLog
from ardee_navigation.control import make

LEFT_M, RIGHT_M, COUNT, NEAR_BEAM = 0.40, 0.36, 30, 100
FIRST_RAD, STEP_RAD = -np.radians(135.0), np.radians(0.25)


def walls(left_m: float = LEFT_M, right_m: float = RIGHT_M, count: int = COUNT) -> Scans:
    """Scans between two walls, 40 a second; nothing is met within 2 degrees of the axis; a leaf is too near."""
    sines = np.sin(FIRST_RAD + STEP_RAD * np.arange(1081))
    with np.errstate(divide="ignore"):
        ranges = np.where(sines > 0.0, left_m, right_m) / np.abs(sines)
    ranges[np.abs(sines) < np.sin(np.radians(2.0))] = np.inf
    ranges[NEAR_BEAM] = 0.0
    return Scans(5.0 + 0.025 * np.arange(count), np.tile(ranges, (count, 1)), FIRST_RAD, STEP_RAD)


def test_what_is_perceived_between_walls() -> None:
    seen = look("walls", walls(), make, {}, 0.22)
    assert seen.left_m[5:] == pytest.approx(LEFT_M, abs=1e-3)
    assert seen.right_m[5:] == pytest.approx(RIGHT_M, abs=1e-3)
    line = {one.quantity.name: one for one in compare(seen, [seen])}
    assert np.median(line["offset_m"].real) == pytest.approx((RIGHT_M - LEFT_M) / 2, abs=1e-3)
    assert line["period_s"].real == pytest.approx(0.025)
    assert np.median(line["side_change_m"].real) == 0.0
    assert line["points"].real.min() > 50


def test_a_controller_gets_a_leaf_too_near_as_in_a_run() -> None:
    given = []

    class Listener:
        def reset(self) -> None:
            pass

        def step(self, observation: dict, time_s: float) -> tuple:
            given.append(observation["scan"].ranges_m)
            return 0.0, 0.0

    look("", walls(), lambda *_: Listener(), {}, 0.0)
    log = ScanLog()
    for number, ranges_m in enumerate(given):
        numbers = (FIRST_RAD, 0.0, STEP_RAD, 0.0, 0.025, 0.02, 30.0)
        log.watch(
            {"scan": LidarReading(number, "lidar", *numbers, ranges_m, np.zeros(len(ranges_m)))}
        )
    assert given[0][NEAR_BEAM] == -np.inf
    assert log.scans().ranges_m == pytest.approx(walls().ranges_m, abs=1e-5)


def test_a_shift_of_a_distribution_is_its_distance() -> None:
    values = np.random.default_rng(1).normal(size=500)
    assert distance(values, values) == (0.0, 0.0)
    assert distance(values, values + 0.3).wasserstein == pytest.approx(0.3)
    assert distance(values, values + 100.0).ks == 1.0
    assert np.isnan(distance(values, np.empty(0)).wasserstein)


def test_narrower_walls_are_apart_by_what_they_are_narrower() -> None:
    one, other = (look("", walls(left_m), make, {}, 0.22) for left_m in (LEFT_M, LEFT_M - 0.05))
    line = {each.quantity.name: each for each in compare(one, [other])}
    assert line["width_m"].distance.wasserstein == pytest.approx(0.05, abs=5e-3)
    assert line["offset_m"].distance.wasserstein == pytest.approx(0.025, abs=3e-3)
    assert line["width_m"].halves.wasserstein < 5e-3


def test_a_pause_makes_the_controller_begin_anew() -> None:
    class Counter:
        resets = 0

        def reset(self) -> None:
            Counter.resets += 1

        def step(self, observation: object, time_s: float) -> tuple:
            return 0.0, 0.0

    scans = walls()
    scans.time_s[15:] += 1.0
    seen = look("", scans, lambda *_: Counter(), {}, 0.0)
    assert Counter.resets == 3  # at first, before the first scan, after the pause
    lines = {line.quantity.name: line for line in compare(seen, [seen])}
    assert len(lines["width_m"].real) == 0 and len(lines["points"].real) == 0
    assert len(lines["period_s"].real) == COUNT - 2


def test_scans_are_read_as_they_were_written(tmp_path: Path) -> None:
    write_scans(walls(), tmp_path / "lidar_log.csv")
    for source in (tmp_path, tmp_path / "lidar_log.csv"):
        read = read_recorded(source, "/scan")
        assert read.ranges_m == pytest.approx(walls().ranges_m, abs=1e-6)
        assert (read.angle_min_rad, read.increment_rad) == (FIRST_RAD, STEP_RAD)
        assert read.time_s == pytest.approx(walls().time_s)


@pytest.mark.parametrize(
    "head, message",
    [
        ("angle_min_rad,0.5", "increment_rad"),
        ("angle_min_rad,x,increment_rad,0.1", "found 'x', expected a number"),
        ("angle_min_rad,0,increment_rad,0", "expected more than 0"),
    ],
)
def test_a_wrong_head_is_refused(tmp_path: Path, head: str, message: str) -> None:
    path = tmp_path / "scans.csv"
    path.write_text(f"{head}\n0,1000\n25,1000\n")
    with pytest.raises(Exception, match=re.escape(f"{path}:1")) as caught:
        read_scans(path)
    assert message in str(caught.value)


def bag(path: Path, scans: Scans) -> Path:
    rosbag = pytest.importorskip("rosbag")
    import rospy
    from sensor_msgs.msg import LaserScan
    from std_msgs.msg import String

    with rosbag.Bag(str(path), "w") as file:
        file.write("/said", String("a word"), rospy.Time(1))
        for time_s, ranges in zip(scans.time_s, scans.ranges_m):
            ranges = np.where(ranges > 0.0, ranges, -np.inf)
            ranges[NEAR_BEAM + 1] = 0.01  # less than range_min
            message = LaserScan(range_min=0.02, range_max=30.0, ranges=ranges.tolist())
            message.angle_min, message.angle_increment = scans.angle_min_rad, scans.increment_rad
            message.header.stamp = rospy.Time.from_sec(time_s)
            file.write("/scan", message, message.header.stamp)
    return path


def test_a_bag_is_read(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    path = bag(tmp_path / "run.bag", walls())
    read, expected_m = read_recorded(path, "/scan"), walls().ranges_m
    expected_m[:, NEAR_BEAM + 1] = 0.0
    assert read.ranges_m == pytest.approx(expected_m, abs=1e-5)
    assert read.time_s == pytest.approx(walls().time_s)
    for topic, message in (("/scam", "did you mean '/scan'?"), ("/said", "expected a LaserScan")):
        with pytest.raises(SystemExit) as ended:
            main(["overlay", str(path), "--real", str(path), "--topic", topic])
        assert ended.value.code == 2 and message in capsys.readouterr().err


@pytest.mark.parametrize(
    "arguments, message",
    [
        (["/nowhere.bag"], "not a bag that can be read"),
        (["/nowhere.csv"], "cannot be read"),
        ([__file__], "expected a time and 1080 or 1081 ranges"),
        ([__file__, "--param", "x"], "--param: found 'x', expected NAME=VALUE"),
        (["/dev/null"], "found 0 lines of data, expected 2 or more"),
        (
            [__file__, "--runs", "2"],
            "--runs: found it with /nowhere, which is no campaign's folder",
        ),
        ([__file__, "--topic", "/scan"], "--topic: found '/scan' without a .bag file"),
        ([__file__, "--factory", "nobody:make"], "--factory: found 'nobody:make'"),
    ],
)
def test_bad_input_is_named_in_a_line(
    arguments: list, message: str, capsys: pytest.CaptureFixture
) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["overlay", "/nowhere", "--real", *arguments])
    printed = capsys.readouterr().err
    assert ended.value.code == 2 and message in printed and printed.count("\n") == 1


def apart(file: Path) -> Dict[str, float]:
    """Returns the Wasserstein distance of each quantity, all runs together."""
    with file.open(newline="") as lines:
        rows = [row for row in csv.DictReader(lines) if row["run"] == "all"]
    return {row["quantity"]: float(row["wasserstein"]) for row in rows}


@pytest.fixture(scope="module")
def campaign(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A campaign of two fields of corn, sown differently, and a straight drive through them."""
    folder = tmp_path_factory.mktemp("overlay")
    file = write(
        folder, replicates=1, limit_sim_s=3, worlds={"near": "tiny.yaml", "far": "far.yaml"}
    )
    recipe = (folder / "tiny.yaml").read_text().replace("row_length_m: 1.0", "row_length_m: 2.0")
    (folder / "tiny.yaml").write_text(recipe)
    (folder / "far.yaml").write_text(recipe + "row_spacing_m: 0.84\n")
    run(file, "--output", folder / "out")
    return folder


@pytest.fixture(scope="module")
def overlays(campaign: Path) -> Dict[str, Path]:
    """The folder of the overlay of each field's run over the near field's, which is the real one."""
    rows = tables.read_runs(campaign / "out").to_pylist()
    ids = {row["world"]: row["run_id"] for row in rows if row["controller"] == "straight"}
    run(campaign / "campaign.yaml", "--output", campaign / "out", "--replay", ids["near"])
    real = campaign / "out" / f"{ids['near']}_scans.csv"
    for world, run_id in ids.items():
        words = [campaign / "out", "--real", real, "--run", run_id, "--output", campaign / world]
        words += ["--param", "lane_width_tolerance_m=0.3"]
        assert main(["overlay", *map(str, words)]) == 0
    return {world: campaign / world for world in ids}


@pytest.mark.slow
def test_a_simulated_run_is_like_itself_and_unlike_another_field(overlays: Dict[str, Path]) -> None:
    near, far = (apart(overlays[world] / "overlay.csv") for world in ("near", "far"))
    assert set(near) == {one.name for one in QUANTITIES}
    assert all(value < 1e-5 for value in near.values())
    assert 0.04 < far["width_m"] < 0.12
    assert far["side_range_m"] > 0.005
    page = (overlays["far"] / "overlay.md").read_text()
    assert "perceived row width [cm]" in page and "(distances.png)" in page


@NEEDS
def test_a_browser_shows_the_page(overlays: Dict[str, Path]) -> None:
    seen = look_at(overlays["far"] / "overlay.html", 2600)
    assert not seen.complaints
    for color in (*figures.REAL, *figures.SIMULATED):
        assert seen.has(color) > 100, color
