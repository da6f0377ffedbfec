# SPDX-License-Identifier: MIT
"""Tests the report of experiments on runs of known numbers, folders that hold another one, and bad arguments."""
import math
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any, Dict, List

import pytest
import synthetic_campaign

from ardee_campaigns import tables
from ardee_campaigns.experiment import run_experiment, scenarios
from ardee_campaigns.experiment.report import CAMPAIGN, MEASURES, Report, in_short, pooled
from ardee_campaigns.plan import Planner, params_of
from ardee_common.cli import Parser
from ardee_common.errors import GeneratorError
from ardee_navigation.evaluation.scenarios import known_scenarios
from ardee_navigation.lbirnt import Parameters

NUMBERS = dict.fromkeys(MEASURES, 0.0)
USUAL = {**NUMBERS, "way_m": 10.0, "lateral_rms_m": 0.03, "completed": 1.0, "time_s": 20.0}
ASTRAY = {**dict.fromkeys(MEASURES, math.nan), "way_m": 0.0, "interventions": 60.0, "time_s": 5.0}
ASTRAY.update(dict.fromkeys(("collisions", "plants_touched", "plants_knocked", "completed"), 0.0))


@pytest.fixture
def run(tmp_path: Path) -> Any:
    """Returns a function that makes a run from its measures; without any it has failed."""
    folder = synthetic_campaign.write(tmp_path / "synthetic", 8, samples=40)
    usual = tables.read_run(folder, tables.finished(folder)[0])

    def made(measures: Dict[str, float], *, seed: int = 7, **about: Any) -> tables.RunFile:
        error = {} if measures else {"status": tables.FAILED, "error": "a | b", "end_reason": ""}
        row = vars(usual.row) | {"seed": seed, "measures": measures} | error
        values = usual.about | about
        return tables.RunFile(tables.RunRow(**row), usual.timing, usual.samples, values)

    return made


def summary(**changes: float) -> Dict[str, float]:
    return {**USUAL, "true_width_m": 0.8, "wall_s": 4.0, **changes}


def test_runs_are_pooled_by_their_way() -> None:
    """12 cm off on a quarter of the way, in the middle on the rest, is an RMS of 6 cm."""
    one = summary(
        way_m=2.5, lateral_rms_m=0.12, lateral_max_m=0.2, row_width_m=0.7, interventions=2
    )
    other = summary(way_m=7.5, lateral_rms_m=0.0, share_near=1.0, row_width_m=0.8)
    found = pooled([one, other, {**ASTRAY, "true_width_m": 0.8, "wall_s": 2.0}])
    assert found["lateral_rms_m"] == pytest.approx(0.06)
    assert found["lateral_max_m"] == 0.2 and found["share_near"] == 0.75
    # 0.7 m with weight 1/4, 0.8 m with 3/4: variance 1/4 * 3/4 * 0.1^2
    assert found["row_width_m"] == pytest.approx(0.775)
    assert found["row_width_sd_m"] == pytest.approx(math.sqrt(3.0) / 40.0)
    assert (found["way_m"], found["interventions"], found["completed"]) == (10.0, 62.0, 2.0)
    assert found["metres_per_intervention"] == pytest.approx(10.0 / 62.0)
    assert (found["time_s"], found["wall_s"]) == (45.0, 10.0)


def test_a_run_without_a_number_does_not_count_in_it() -> None:
    unseen = ("row_width_m", "row_width_sd_m", "left_error_m", "right_error_m")
    blind = summary(way_m=30.0, lateral_rms_m=0.01, **dict.fromkeys(unseen, math.nan))
    seeing = summary(row_width_m=0.7, row_width_sd_m=0.02, left_error_m=0.01, right_error_m=-0.01)
    found = pooled([blind, seeing])
    assert [found[name] for name in unseen] == pytest.approx([0.7, 0.02, 0.01, -0.01])
    # 1 cm on three quarters of the way and 3 cm on one: mean square of 3 cm^2
    assert found["lateral_rms_m"] == pytest.approx(0.01 * math.sqrt(3.0))


def test_report_has_all_files_and_the_same_bytes(run: Any, tmp_path: Path) -> None:
    folders = [tmp_path / name for name in ("one", "two")]
    for folder in folders:
        report = Report(folder, "Row following: test", "run_experiment ...")
        folder.mkdir()
        for number in (1, 0) if folder == folders[0] else (0, 1):  # in whatever order they end
            report.add(number, run(USUAL, seed=7 + number, latency_ms=[1.0, 3.0], unanswered=1))
    files = sorted(path.name for path in folders[0].iterdir())
    runs = [f"run_0{i}{end}" for i in (0, 1) for end in (".csv", "_errors.png", "_lidar.png")]
    assert files == ["report.md", *runs, "runs.csv"]
    for name in files:
        assert (folders[0] / name).read_bytes() == (folders[1] / name).read_bytes()
    assert in_short(run(USUAL)).startswith("seed 7, end of the row, 10.0 m, lateral RMS 3.0 cm, 1 ")
    text = (folders[0] / "report.md").read_text()
    assert "- run 0, 0.2 m along: off the lane" in text and "2 of 2 at the end" in text
    assert "3.0 ms median, 3.0 ms p99, 3.0 ms at most, over 4 commands; 2 scans" in text


def test_a_folder_holds_the_runs_of_its_report_alone(run: Any, tmp_path: Path) -> None:
    for kept in ([], [0]):
        report = Report(tmp_path, "test", "run_experiment ...")
        report.begin(kept)
        for number in (0, 1)[: 2 - len(kept)]:
            report.add(number, run(USUAL))
    (tmp_path / "run_notes.txt").write_text("mine")
    names = ["report.md", "run_00.csv", "run_00_errors.png", "run_00_lidar.png", "run_notes.txt"]
    assert sorted(path.name for path in tmp_path.iterdir() if path.is_file()) == [
        *names,
        "runs.csv",
    ]


def test_a_report_is_erased_by_none_but_the_same_experiment(run: Any, tmp_path: Path) -> None:
    check, output = run_experiment.check_folder, tmp_path / "out"
    check(output, "corn", range(1, 51))  # not there
    tables.write_run(output / CAMPAIGN, run(USUAL))  # of corn, seed 7
    check(output, "corn", range(1, 51))  # seed 7 is driven again
    for scenario, seeds in (("corn", range(51, 101)), ("sorghum", range(1, 51))):
        with pytest.raises(GeneratorError, match="experiment of corn, seed 7, which would be eras"):
            check(output, scenario, seeds)
    (tmp_path / "report.md").write_text("# Row following: corn")
    with pytest.raises(GeneratorError, match="without its campaign, which would be erased"):
        check(tmp_path, "corn", range(1, 51))


def test_finished_runs_of_other_parameters_are_not_erased(
    run: Any, tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    output, of_seed_7 = tmp_path / "out", ["--scenario", "corn", "--seed", "7", "--runs", "1"]
    kept = tables.write_run(output / CAMPAIGN, run(USUAL))  # of corn, seed 7
    (output / CAMPAIGN / scenarios.FILE).write_text("as it was")
    assert run_experiment.main([*of_seed_7, "--output", str(output)]) == 2
    said = capsys.readouterr().err
    assert (
        f"run_experiment: {output}: found finished runs of another first seed, parameters" in said
    )
    assert said.count("\n") == 1 and "expected another --output" in said and kept.is_file()
    assert (output / CAMPAIGN / scenarios.FILE).read_text() == "as it was"
    tables.write_run(output / CAMPAIGN, run({}))  # a failed one is no loss
    run_experiment.check_runs(output / CAMPAIGN, [])


def test_runs_that_failed_or_never_came_between_the_rows_are_reported(
    run: Any, tmp_path: Path
) -> None:
    report = Report(tmp_path, "test", "run_experiment ...")
    report.add(0, run(ASTRAY))
    text = report.path.read_text()
    assert "| 0 | 7 | end of the row | 0.0 | - | - | - |" in text and "nan" not in text
    assert "No run came between the rows" in text and not report.has_failed
    assert in_short(run(ASTRAY)).startswith("seed 7, end of the row, never between the rows, 1 ")
    names, values = (line.split(",") for line in (tmp_path / "runs.csv").read_text().splitlines())
    csv = dict(zip(names, values))
    assert (csv["way_m"], csv["lateral_rms_m"], csv["interventions"]) == ("0", "nan", "60")
    report.add(2, run({}))
    report.add(1, run(USUAL))
    text = report.path.read_text()
    assert "not measured there: run 0, 2." in text and "| all |  | 1 of 3 at the end" in text
    assert report.has_failed and "| 2 | 7 | failed: a \\| b | - |" in text
    assert in_short(run({})) == "seed 7, failed: a | b"


def test_an_experiment_is_a_campaign_over_its_seeds(tmp_path: Path) -> None:
    (tmp_path / "p.yaml").write_text("kp: 30\n")
    words = ["--runs", "2", "--seed", "5", "--parameters", str(tmp_path / "p.yaml")]
    parser = Parser("test")
    scenarios.add_arguments(parser)
    tobacco, args = known_scenarios()["tobacco"], scenarios.parse(parser, words)
    campaign = scenarios.write_campaign(tmp_path, "tobacco", tobacco, args, measures=["way_m"])
    planner = Planner(campaign)
    jobs = [planner.job(*planner.cells, number, tmp_path) for number in range(2)]
    assert [(job.seed, job.field_seed) for job in jobs] == [(5, 5), (6, 6)]
    params = Parameters(**params_of(campaign, *planner.cells))
    assert params == replace(tobacco.parameters, kp=30.0) and params.lane_width_m == 1.0


HINT = " (--help lists all arguments)"


@pytest.mark.parametrize(
    "words, message",
    [
        (
            ["--runs", "x"],
            "argument --runs: found 'x', expected a whole number from 1 to 10000" + HINT,
        ),
        (
            ["--seed", "1.5"],
            "argument --seed: found '1.5', expected a whole number from 0 to 2147483647" + HINT,
        ),
        (
            ["--runs", "2", "--seed", "2147483647"],
            "--seed and --runs: found a last seed above 2147483647, the largest" + HINT,
        ),
        (
            ["--output", __file__],
            f"found --output {__file__} (File exists), expected a folder that can be written",
        ),
        (["--bot-model", "nobody.xacro"], "--bot-model: found 'nobody.xacro', no such file, and "),
    ],
)
def test_bad_arguments_are_one_line(words: List[str], message: str, tmp_path: Path) -> None:
    command = [sys.executable, "-m", "ardee_campaigns", "run_experiment", "--scenario", "corn"]
    done = subprocess.run([*command, *words], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 2 and done.stderr.startswith(f"run_experiment: {message}")
    assert done.stderr.count("\n") == 1 and not list(tmp_path.glob("*/*"))
