# SPDX-License-Identifier: MIT
"""Tests judging runs, summing them up and reporting them, without a simulator."""
import math
import subprocess
import sys
from pathlib import Path
from typing import Callable, List, Optional, Tuple

import numpy as np
import pytest

from ardee_common.errors import GeneratorError
from ardee_models.terrain.ground import LevelGround
from ardee_navigation.evaluation.command import make_folder
from ardee_navigation.evaluation.experiment_report import (
    check_folder,
    in_short,
    write_report,
    write_run,
)
from ardee_navigation.evaluation.record import COLUMNS, Record
from ardee_navigation.evaluation.run_metrics import summarize
from ardee_navigation.evaluation.scan import Scan
from ardee_navigation.evaluation.trial import LARGEST_OFFSET_M, Judge, Seen
from ardee_world.row_truth import Field, Pose, Stalks
from ardee_world.trial import Trial

DT_S, SPEED_M_S = 0.025, 0.5
Course = Callable[[float], Tuple[float, float]]  # along m -> lateral m, heading rad


def trial(stalks: Optional[Stalks] = None) -> Trial:
    rows = (np.array([[0.0, 0.4], [10.0, 0.4]]), np.array([[0.0, -0.4], [10.0, -0.4]]))
    stalks = stalks or Stalks(np.empty((0, 2)), np.empty(0))
    return Trial(Path("x.world"), [], Field(rows, stalks), Pose(-1.0, 0.0, 0.0), LevelGround())


def run(course: Course, scans: int = 920, number: int = 0) -> Tuple[Record, List[Pose]]:
    """Drives at constant speed on a course until the judge ends it; also returns where the judge set the robot down."""
    judge, set_down = Judge(trial(), "test", number, 7, 0.2), []
    for i in range(scans):
        along = -1.0 + SPEED_M_S * DT_S * i
        lateral, heading = course(along)
        state = "finished" if along > 10.3 else "following"
        seen = Seen(0.38 - lateral, 0.40 + lateral, (True, False), state)
        pose = Pose(along, lateral, heading)
        back = judge.look(DT_S * i, pose, (SPEED_M_S, 0.0), seen)
        if back:
            set_down.append(back)
        if judge.record.end:
            break
    return judge.finish(2.0), set_down


def test_a_perfect_drive() -> None:
    record, set_down = run(lambda along: (0.03, -0.02))
    summary = summarize([record])
    assert record.end == "end of the row" and not set_down and summary.completed == 1
    assert summary.way_m == pytest.approx(10.0, abs=0.03)
    assert summary.lateral_rms_m == pytest.approx(0.03) and summary.share_near == 1.0
    assert summary.heading_max_rad == pytest.approx(0.02)
    assert summary.width_m == pytest.approx(0.78) and summary.width_sd_m == pytest.approx(0.0)
    assert summary.width_true_m == pytest.approx(0.8)
    lidar = 0.03 + 0.2 * math.sin(-0.02)  # place of the lidar, 0.2 m ahead
    assert summary.left_error_m == pytest.approx(0.35 - (0.4 - lidar))
    assert summary.right_error_m == pytest.approx(0.43 - (0.4 + lidar))
    assert summary.real_time_factor == pytest.approx(summary.time_s / 2.0)


def test_returns_are_kept_at_their_own_places() -> None:
    judge, heading, lateral = Judge(trial(), "test", 0, 7, 0.2), 0.1, 0.05
    judge.look(
        0.0, Pose(4.0, lateral, heading), (0.5, 0.0), Seen(0.4, 0.4, (True, True), "following")
    )
    lidar = np.array([4.0 + 0.2 * math.cos(heading), lateral + 0.2 * math.sin(heading)])
    post = np.array([4.18, 0.40])  # nearly abeam of the lidar, unlike the second beam
    x, y = post - lidar
    bearing, distance = math.atan2(y, x) - heading, math.hypot(x, y)
    scan = Scan(0.0, np.array([distance, 0.4, math.inf]), bearing, 0.5)
    judge.keep_scan(scan)
    ((along, across),) = judge.record.raw[0]
    assert along == pytest.approx(4.18)
    assert across == pytest.approx(distance * math.sin(bearing))


def test_errors_are_weighted_by_the_way() -> None:
    """With a quarter of the way 12 cm off, the rest in the middle, the RMS is 6 cm, and three quarters are near."""
    record, _ = run(lambda along: (0.12 if 2.5 < along <= 5.0 else 0.0, 0.0))
    summary = summarize([record])
    assert summary.lateral_rms_m == pytest.approx(0.06, abs=5e-4)
    assert summary.share_near == pytest.approx(0.75, abs=5e-3)
    assert summary.lateral_max_m == pytest.approx(0.12)


def test_a_person_steps_in_off_the_lane() -> None:
    record, set_down = run(lambda along: (0.39 if 3.995 < along < 4.007 else 0.0, 0.0))
    assert [step_in.why for step_in in record.interventions] == ["off the lane"]
    assert set_down[0][1:] == pytest.approx((0.0, 0.0)) and set_down[0].x_m == pytest.approx(4.0)
    assert summarize([record]).metres_per_intervention == pytest.approx(10.0, abs=0.03)
    nearly, _ = run(lambda along: (LARGEST_OFFSET_M - 0.001, 0.0))
    assert not nearly.interventions
    behind, _ = run(lambda along: (0.5 if along > 9.6 else 0.0, 0.0))
    assert not behind.interventions  # on its way out of the row


def test_a_person_steps_in_when_it_does_not_move() -> None:
    judge = Judge(trial(), "test", 0, 7, 0.2)
    seen = Seen(0.4, 0.4, (True, True), "following")
    looks = [judge.look(DT_S * i, Pose(5.0, 0.0, 0.0), (0.5, 0.0), seen) for i in range(100)]
    when = [i for i, back in enumerate(looks) if back]
    assert when == [80]  # 2 s
    assert looks[80].x_m == pytest.approx(5.5)
    assert judge.record.interventions[0].why == "stuck"


def test_a_person_steps_in_when_it_stops_in_the_row() -> None:
    judge = Judge(trial(), "test", 0, 7, 0.2)
    back = judge.look(
        0.0, Pose(5.0, 0.1, 0.0), (0.0, 0.0), Seen(0.4, 0.4, (True, True), "finished")
    )
    assert back[:2] == pytest.approx((5.5, 0.0)) and not judge.record.end
    judge.look(1.0, Pose(9.7, 0.1, 0.0), (0.0, 0.0), Seen(0.4, 0.4, (True, True), "finished"))
    assert judge.record.end == "end of the row"


def test_a_robot_that_does_not_stop_is_stopped() -> None:
    judge = Judge(trial(), "test", 0, 7, 0.2)
    judge.look(0.0, Pose(15.1, 0.0, 0.0), (0.5, 0.0), Seen(0.4, 0.4, (True, True), "following"))
    assert judge.record.end == "went on after the row"


def test_report_has_all_files_and_the_same_bytes(tmp_path: Path) -> None:
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
        records = [run(lambda along: (0.39 if 3.995 < along < 4.007 else 0.01, 0.0))[0]]
        records.append(run(lambda along: (0.02, 0.0), number=1)[0])
        for record in records:
            write_run(record, tmp_path / name)
        write_report(records, "run_experiment ...", tmp_path / name)
    files = sorted(path.name for path in (tmp_path / "one").iterdir())
    runs = [f"run_0{i}{end}" for i in (0, 1) for end in (".csv", "_errors.png", "_lidar.png")]
    assert files == ["report.md", *runs, "runs.csv"]
    for name in files:
        assert (tmp_path / "one" / name).read_bytes() == (tmp_path / "two" / name).read_bytes()
    assert in_short(records[1]).startswith("seed 7, end of the row, 10.0 m, lateral RMS ")
    text = (tmp_path / "one" / "report.md").read_text()
    assert "- run 0, 4.0 m along: off the lane" in text and "2 of 2 at the end" in text
    assert (tmp_path / "one" / "run_00.csv").read_text().splitlines()[0] == ",".join(COLUMNS)


def test_a_folder_holds_the_runs_of_its_report_alone(tmp_path: Path) -> None:
    records = [run(lambda along: (0.01, 0.0), number=number)[0] for number in (0, 1)]
    for record in records:
        write_run(record, tmp_path)
    write_report(records, "run_experiment ...", tmp_path)
    (tmp_path / "run_notes.txt").write_text("mine")
    write_run(records[0], tmp_path)
    write_report(records[:1], "run_experiment ...", tmp_path)
    kept = ["report.md", "run_00.csv", "run_00_errors.png", "run_00_lidar.png", "run_notes.txt"]
    assert sorted(path.name for path in tmp_path.iterdir()) == [*kept, "runs.csv"]


def test_a_report_is_erased_by_none_but_the_same_experiment(tmp_path: Path) -> None:
    check_folder(tmp_path, "test", range(1, 51))  # empty
    record, _ = run(lambda along: (0.01, 0.0))  # of seed 7
    write_run(record, tmp_path)
    write_report([record], "run_experiment ...", tmp_path)
    check_folder(tmp_path, "test", range(1, 51))  # seed 7 is driven again
    for scenario, seeds in (("test", range(51, 101)), ("corn", range(1, 51))):
        with pytest.raises(GeneratorError, match="found the report of an experiment .* erased"):
            check_folder(tmp_path, scenario, seeds)
    assert (tmp_path / "run_00.csv").is_file()


def test_two_experiments_do_not_write_into_one_folder_at_once(tmp_path: Path) -> None:
    code = "import sys, pathlib; from ardee_navigation.evaluation import command as r\n"
    code += "r.make_folder(pathlib.Path(sys.argv[1])); print('made', flush=True); sys.stdin.read()"
    command = [sys.executable, "-c", code, str(tmp_path)]
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True}
    with subprocess.Popen(command, **pipes) as other:
        assert other.stdout.readline() == "made\n"
        with pytest.raises(GeneratorError, match="where another experiment writes"):
            make_folder(tmp_path)
        other.communicate("")
    make_folder(tmp_path)


def test_runs_that_never_came_between_the_rows_are_reported(tmp_path: Path) -> None:
    astray, _ = run(lambda along: (0.39, 0.0), scans=60)  # set back 60 times before the first plant
    astray.end = "given up"
    write_run(astray, tmp_path)
    text = write_report([astray], "run_experiment ...", tmp_path).read_text()
    assert "| 0 | 7 | given up | 0.0 | - | - | - |" in text and "nan" not in text
    assert "No run came between the rows" in text and in_short(astray).startswith(
        "seed 7, given up, never between the rows, 60 interventions"
    )
    names, values = (line.split(",") for line in (tmp_path / "runs.csv").read_text().splitlines())
    csv = dict(zip(names, values))
    assert (csv["way_m"], csv["lateral_rms_m"], csv["interventions"]) == ("0", "nan", "60")
    good, _ = run(lambda along: (0.03, 0.0), number=1)
    text = write_report([astray, good], "run_experiment ...", tmp_path).read_text()
    assert "not measured there: run 0." in text and "| all |  | 1 of 2 at the end" in text
    assert summarize([astray, good]).lateral_rms_m == pytest.approx(0.03)
