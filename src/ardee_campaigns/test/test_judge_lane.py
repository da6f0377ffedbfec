# SPDX-License-Identifier: MIT
"""Tests the figures of a lane on a run whose figures follow from its geometry, and the reader of a real run's logs."""
import math
from dataclasses import replace
from pathlib import Path
from typing import List

import numpy as np
import pytest

from ardee_campaigns.experiment.scenarios import find_scenario
from ardee_campaigns.lane import judge_lane
from ardee_campaigns.lane.lane_figures import (
    MEASURES,
    LaneFigures,
    measure_follower,
    measure_real,
    read_real_lane,
    table,
    with_ride,
    write_real_lane,
)
from ardee_campaigns.lane.real_run import LIDAR_LOG, PERCEPTION_LOG, read_real_run
from ardee_campaigns.lane.scan_speed import scan_speed_m_s
from ardee_campaigns.lane.scans import Scans, returns_m
from ardee_common.errors import GeneratorError

ANGLE_MIN_RAD, INCREMENT_RAD = -2.35619, 2 * 2.35619 / 1080  # of a UST-10LX
SCANS, LEFT_M, RIGHT_M, JUMP_M, LEAF_M = 40, 0.40, 0.37, 0.15, 1.0
DEGREES = -135.0 + 0.25 * np.arange(1080)


def scan_mm(left_m: float) -> List[int]:
    """Ranges between two walls; a leaf ahead within 5 degrees, no return beyond 130 degrees."""
    sines = np.sin(np.radians(DEGREES))
    with np.errstate(divide="ignore"):
        ranges = np.where(sines > 0.0, left_m, RIGHT_M) / np.abs(sines)
    leaf = np.abs(DEGREES) <= 5.0
    ranges[leaf] = LEAF_M / np.cos(np.radians(DEGREES[leaf]))
    ranges[np.abs(DEGREES) > 130.0] = 65.533
    return [round(1e3 * value) for value in ranges]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A real run: the left wall jumps from scan to scan; the robot's own follower saw other distances."""
    run = tmp_path / "run"
    run.mkdir()
    scans, answers = [], [
        "LANE_WIDTH,0.77,v,23",
        "heading,distance_left,distance_right,lidar_ts_ms,x",
    ]
    for i in range(SCANS):
        odd, time_ms = i % 2, 5000 + 25 * i
        scans.append(",".join(map(str, [time_ms, *scan_mm(LEFT_M + JUMP_M * odd)])))
        answers.append(f"{0.02 - 0.04 * odd},{0.40 + 0.01 * odd},0.37,{time_ms}")
    (run / LIDAR_LOG).write_text("\n".join(scans) + "\n")
    (run / PERCEPTION_LOG).write_text("\n".join(answers) + "\n")
    return run


def test_figures_follow_from_the_geometry(folder: Path) -> None:
    figures = measure_real(read_real_run(folder), "test").figures
    assert figures.no_return_share == pytest.approx(39 / 1080)
    assert figures.ahead_no_return_share == 0.0
    assert figures.ahead_median_m == pytest.approx(LEAF_M / math.cos(math.radians(5.0)), abs=1e-3)
    assert figures.ahead_p10_m == pytest.approx(LEAF_M, abs=1e-3)
    assert figures.axis_returns == 41  # the leaf's beams, 0.25 degrees apart
    assert figures.flicker_share == 0.5 and figures.flicker_median_m == pytest.approx(
        JUMP_M / 2, abs=1e-3
    )
    # Nearer than r are acos(0.37 m / r) of the 30 degrees at the right, in half the scans acos(0.4 m / r) at the left.
    r = figures.side_median_m
    nearer = math.acos(RIGHT_M / r) / 2 + math.acos(LEFT_M / r) / 4
    assert nearer == pytest.approx(math.radians(30.0) / 2, abs=0.01)
    assert figures.width_m == pytest.approx(0.775)
    assert figures.width_sd_m == pytest.approx(0.005)
    assert figures.left_change_median_m == pytest.approx(0.01)
    assert figures.left_change_p95_m == pytest.approx(0.01)
    assert figures.heading_sd_rad == pytest.approx(0.02)
    assert figures.right_spread_m < 1e-3  # a straight wall


@pytest.mark.parametrize("speed_m_s", [0.25, 0.5])
def test_speed_is_found_in_scans_of_plants_that_pass_by(speed_m_s: float) -> None:
    rng, time_s = np.random.default_rng(1), 0.025 * np.arange(13)
    angles = ANGLE_MIN_RAD + INCREMENT_RAD * np.arange(1081)
    starts_m = rng.uniform(-3.0, 3.0, 40)
    offsets_m = rng.choice([-0.38, 0.38], 40) + rng.normal(0.0, 0.03, 40)

    def scan(moved_m: float) -> np.ndarray:
        nearest = np.full(len(angles), np.inf)
        for from_m, beside_m in zip(starts_m - moved_m, offsets_m):
            with np.errstate(divide="ignore"):
                ranges = beside_m / np.sin(angles)
            ahead_m = ranges * np.cos(angles)
            is_met = (ranges > 0.0) & (ahead_m >= from_m) & (ahead_m <= from_m + 0.06)
            nearest = np.where(is_met & (ranges < nearest), ranges, nearest)
        return nearest + 0.01 * rng.standard_normal(len(angles))

    ranges_m = np.array([scan(speed_m_s * t) for t in time_s])
    found = scan_speed_m_s(Scans(time_s, ranges_m, ANGLE_MIN_RAD, INCREMENT_RAD))
    assert found == pytest.approx(speed_m_s, abs=0.03)
    assert math.isnan(scan_speed_m_s(Scans(20 * time_s, ranges_m, ANGLE_MIN_RAD, INCREMENT_RAD)))


def test_a_leaf_too_near_to_measure_is_a_return() -> None:
    ranges_m = np.array([-math.inf, 0.0, 0.02, 31.0, math.inf, math.nan])
    assert returns_m(ranges_m).tolist() == [0.0, math.inf, 0.02, 31.0, math.inf, math.inf]
    assert returns_m(ranges_m, 0.1, 30.0).tolist() == [0.0, math.inf, 0.0, *[math.inf] * 3]


def test_the_ride_is_the_spread_of_the_robots_own_angles() -> None:
    figures = LaneFigures(*[0.5] * len(MEASURES))
    ride = with_ride(figures, np.radians([[1.0, 0.0, 4.0], [3.0, 6.0, 4.0]]))
    spreads = (ride.roll_sd_rad, ride.pitch_sd_rad, ride.yaw_sd_rad)
    assert np.degrees(spreads) == pytest.approx([1.0, 3.0, 0.0])
    assert ride.heading_sd_rad == 0.5


def test_no_pair_is_made_across_a_pause(folder: Path) -> None:
    run = read_real_run(folder)
    paused = replace(run.scans, time_s=np.arange(SCANS) * 1.0)
    answers = replace(run.perceived, time_s=np.arange(SCANS) * 1.0)
    figures = measure_real(run._replace(scans=paused, perceived=answers), "test").figures
    assert math.isnan(figures.flicker_median_m) and math.isnan(figures.left_change_p95_m)


def test_this_follower_finds_the_walls_in_real_scans(folder: Path) -> None:
    lines = (folder / LIDAR_LOG).read_text().splitlines()
    still = [f"{5000 + 25 * i}," + lines[0].partition(",")[2] for i in range(SCANS)]
    (folder / LIDAR_LOG).write_text("\n".join(still))
    own = measure_follower(read_real_run(folder))
    assert own.width_m == pytest.approx(LEFT_M + RIGHT_M, abs=0.005) and own.left_spread_m < 1e-3
    assert own.flicker_median_m == 0.0


def test_real_lane_file_is_read_as_it_was_written(folder: Path, tmp_path: Path) -> None:
    lane = measure_real(read_real_run(folder), "test")
    write_real_lane(lane, tmp_path / "lane.yaml")
    again = read_real_lane(tmp_path / "lane.yaml")
    assert (again.source, again.scans) == ("test", SCANS)
    assert again.ranges_p50_m == pytest.approx(lane.ranges_p50_m, abs=6e-4)
    for one in MEASURES:
        expected = getattr(lane.figures, one.name)
        assert getattr(again.figures, one.name) == pytest.approx(
            expected, rel=1e-3, abs=1e-9, nan_ok=True
        )


def test_shipped_real_lane() -> None:
    lane = read_real_lane(judge_lane.REAL_LANE)
    assert lane.scans == 479 and "d3d4e19" in lane.source
    assert len(lane.ranges_p10_m) == len(lane.ranges_p50_m) == len(lane.ranges_p90_m) == 54
    assert lane.figures.speed_m_s == pytest.approx(0.24, abs=0.01)
    assert lane.figures.no_return_share < 0.02 and lane.figures.axis_returns == pytest.approx(
        72.3, abs=0.1
    )


def test_table_has_the_interval_of_the_runs() -> None:
    real = LaneFigures(*[0.5] * len(MEASURES))
    runs = [LaneFigures(*[value] * len(MEASURES)) for value in (0.1, 0.3)]
    runs.append(LaneFigures(*[math.nan] * len(MEASURES)))
    lines = table({"real": real}, runs, "corn").splitlines()
    assert lines[0] == "|  | real | corn | 95 % interval |" and len(lines) == 2 + len(MEASURES)
    # Student, one degree of freedom: 12.706 * 0.1
    assert "| range: median [m] | 0.50 | 0.20 | -1.07 to 1.47 |" in lines
    assert "| range: median [m] | 0.50 | 0.10 | - |" in table({"real": real}, runs[:1], "corn")


@pytest.mark.parametrize(
    "name, old, new, message",
    [
        (LIDAR_LOG, "5025,", "5025,x,", ":2: found 1081 ranges, expected 1080"),
        (LIDAR_LOG, "5025,", "x,", ":2: found 'x', expected a number"),
        (LIDAR_LOG, "5025,", "4000,", ":2: found a time not later than the line's before"),
        (
            LIDAR_LOG,
            "5000,",
            "5000,1,2,",
            ":1: found 1082 ranges, expected a time and 1080 or 1081",
        ),
        (PERCEPTION_LOG, "LANE_WIDTH", "WIDTH", ":1: found no LANE_WIDTH"),
        (PERCEPTION_LOG, "0.77", "wide", ":1: LANE_WIDTH: found 'wide', expected a number"),
        (PERCEPTION_LOG, "distance_left", "left", ":2: found no column 'distance_left'"),
        (PERCEPTION_LOG, "0.4,", "", ":3: found 3 columns, expected at least 4"),
    ],
)
def test_a_bad_log_is_one_line(folder: Path, name: str, old: str, new: str, message: str) -> None:
    path = folder / name
    path.write_text(path.read_text().replace(old, new, 1))
    with pytest.raises(GeneratorError) as error:
        read_real_run(folder)
    assert str(error.value).startswith(f"{path}{message}")


def test_a_missing_log_is_one_line(tmp_path: Path) -> None:
    with pytest.raises(GeneratorError, match=f"{LIDAR_LOG}: cannot be read: No such file"):
        read_real_run(tmp_path)


def judge(*words: str) -> int:
    """Runs the command in this process; returns its exit code."""
    try:
        return judge_lane.main(words)
    except SystemExit as ended:
        return ended.code


def test_a_real_run_alone(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    output = tmp_path / "report"
    monkeypatch.setattr("ardee_campaigns.lane.judge_lane.end_by_signals", lambda: None)
    assert judge("--real-run", str(folder), "--output", str(output)) == 0
    printed = capsys.readouterr().out
    assert "| perceived width [m] | 0.775 | " in printed
    assert printed.splitlines()[0] == "|  | real | real scans, this follower |"
    assert (output / "lane.png").read_bytes().startswith(b"\x89PNG")
    assert read_real_lane(output / "real_lane.yaml").scans == SCANS
    assert "| perceived width [m] | 0.775 | " in (output / "lane.md").read_text()


@pytest.mark.parametrize(
    "words, message",
    [
        ((), "found neither WORLD nor --real-run, expected at least one"),
        (("corn", "--scans", "1"), "argument --scans: found '1', expected a whole number from 2"),
        (("rice",), "WORLD: found 'rice', no such file, and nearest of"),
        (("corn", "--real-run", "/nowhere"), f"/nowhere/{LIDAR_LOG}: cannot be read: No such file"),
    ],
)
def test_bad_arguments(
    words: List[str],
    message: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture,
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("ardee_campaigns.lane.judge_lane.end_by_signals", lambda: None)
    assert judge(*words) == 2
    assert message in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


def test_a_world_by_name_or_file(tmp_path: Path) -> None:
    corn, tobacco = find_scenario("corn"), find_scenario("tobacco.world")
    assert corn.plan == "scenario-2-corn-plot.yaml" and find_scenario("scenario_2_corn") == corn
    assert tobacco.parameters.lane_width_m == 1.0
    assert find_scenario("sorghum.world").plan == "sorghum-field.yaml"  # no scenario's world
    own = tmp_path / "mine.world"
    own.write_text("<sdf version='1.6'/>")
    assert find_scenario(str(own)).world == str(own) and find_scenario(str(own)).plan is None
