# SPDX-License-Identifier: MIT
"""Tests the comparison of experiments: intervals against closed forms and tables, pairs by seed."""
import math
from pathlib import Path
from typing import Dict, List

import numpy as np
import pytest

from ardee_campaigns import tables
from ardee_campaigns.__main__ import main
from ardee_campaigns.experiment.report import CAMPAIGN, MEASURES
from ardee_campaigns.report.statistics import mean_interval, poisson_interval


def row(seed: int, rms_m: float = 0.01, interventions: int = 0, way_m: float = 50.0) -> dict:
    values = dict.fromkeys(MEASURES, 0.0 if way_m else math.nan)
    values.update(way_m=way_m, lateral_rms_m=rms_m, interventions=interventions)
    return {"run_id": f"{seed:016x}", "seed": seed, "replicate": 0, "measures": values}


def experiment(folder: Path, rows: List[dict], world: str = "corn") -> str:
    """Writes the tables of an experiment; returns its folder."""
    names = {"world": world, "robot": "robot", "controller": "lidar", "factors": {}}
    made = [tables.RunRow(**names, status=tables.OK, **values) for values in rows]
    (folder / CAMPAIGN).mkdir(parents=True)
    tables.write_runs(folder / CAMPAIGN, made, tables.runs_schema({}, MEASURES, {}))
    return str(folder)


def cells(text: str) -> Dict[str, List[str]]:
    found = [
        [c.strip() for c in line.split("|")[1:-1]] for line in text.splitlines() if "|" in line
    ]
    return {line[0]: line[1:] for line in found}


def test_mean_interval_of_two_values_is_students() -> None:
    """One degree of freedom gives t as tan of 0.475 pi; mean 2, standard error 1."""
    reach = math.tan(0.475 * math.pi)
    assert mean_interval([1.0, 3.0]) == pytest.approx((2.0, 2.0 - reach, 2.0 + reach))


def test_mean_interval_covers_as_it_says() -> None:
    """In 4000 samples of 6 normal values, 95 % are covered, within 3.9 standard errors (99.99 %)."""
    samples = np.random.default_rng(3).standard_normal((4000, 6)) + 5.0
    found = [mean_interval(sample) for sample in samples]
    share = np.mean([interval.low <= 5.0 <= interval.high for interval in found])
    assert abs(share - 0.95) < 3.9 * math.sqrt(0.95 * 0.05 / 4000)


def test_poisson_interval() -> None:
    """No event gives -ln 0.025 as the upper end; ten events that of the table of Garwood (1936)."""
    assert poisson_interval(0) == pytest.approx((0.0, 0.0, -math.log(0.025)))
    assert poisson_interval(10) == pytest.approx((10.0, 4.795, 18.390), abs=1e-3)


def test_runs_are_paired_by_seed(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    one = experiment(tmp_path / "one", [row(1, 0.010), row(2, 0.030), row(9, 0.5, 50)])
    other = experiment(tmp_path / "other", [row(2, 0.033, 2), row(1, 0.011), row(7, 0.5, 50)])
    assert main(["compare_experiments", one, other]) == 0
    text = capsys.readouterr().out
    found, reach = cells(text), 0.1 * math.tan(0.475 * math.pi)
    assert text.startswith("2 pairs of runs, seeds 1, 2; 2 runs without a partner are left out")
    interval = f"{0.2 - reach:+.2f} to {0.2 + reach:+.2f}"
    assert found["lateral RMS [cm]"] == ["2.00", "2.20", "+0.20", interval]
    assert found["interventions"][:3] == ["0.00", "1.00", "+1.00"]
    assert f"{one}: 0 in 100.0 m: 0.00 per 100 m, 0.00 to 3.69" in text
    assert f"{other}: 2 in 100.0 m: 2.00 per 100 m, 0.24 to 7.22" in text


def test_a_pair_without_a_number_is_left_out_of_its_quantity(
    tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    one = experiment(tmp_path / "one", [row(1, 0.010), row(2, 0.030), row(3, math.nan)])
    other = experiment(tmp_path / "other", [row(1, 0.011), row(2, 0.033), row(3, 0.5)])
    assert main(["compare_experiments", one, other]) == 0
    text = capsys.readouterr().out
    assert cells(text)["lateral RMS [cm], 2 pairs"][:3] == ["2.00", "2.20", "+0.20"]
    assert "nan" not in text


def test_a_single_pair_has_no_interval(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    one = experiment(tmp_path / "one", [row(1, 0.010), row(2, math.nan)])
    other = experiment(tmp_path / "other", [row(1, 0.011), row(2, 0.033)])
    assert main(["compare_experiments", one, other]) == 0
    found = cells(capsys.readouterr().out)["lateral RMS [cm], 1 pairs"]
    assert found == ["1.00", "1.10", "+0.10", "-"]


def test_pairs_without_any_way_are_left_out_and_said_so(
    tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    one = experiment(tmp_path / "one", [row(1, 0.01), row(2, 0.03), row(9)])
    other = experiment(tmp_path / "other", [row(1, 0.01), row(2, 0.03), row(9, math.nan, 9, 0.0)])
    assert main(["compare_experiments", one, other]) == 0
    text = capsys.readouterr().out
    assert "seeds 1, 2; 1 pairs with a run that never came between the rows are left out" in text
    assert f"{other}: 0 in 100.0 m" in text and "nan" not in text
    assert main(["compare_experiments", one, one]) == 0
    differences = [values[2:] for values in cells(capsys.readouterr().out).values()][2:]
    assert len(differences) == 9 and all(d == ["+0.00", "+0.00 to +0.00"] for d in differences)


@pytest.mark.parametrize(
    "seeds, message",
    [
        ((2, 3), "found 1 seeds whose runs came between the rows in both experiments, expected 2"),
        ((), "runs.parquet: found no such file"),
    ],
)
def test_too_little_to_compare_is_one_line(
    tmp_path: Path, seeds: tuple, message: str, capsys: pytest.CaptureFixture
) -> None:
    one = experiment(tmp_path / "one", [row(1), row(2)])
    other = experiment(tmp_path / "other", [row(s) for s in seeds]) if seeds else str(tmp_path)
    with pytest.raises(SystemExit) as ended:
        main(["compare_experiments", one, other])
    printed = capsys.readouterr().err
    assert ended.value.code == 2 and message in printed and printed.count("\n") == 1


def test_experiments_of_different_worlds_are_not_paired(
    tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    one = experiment(tmp_path / "one", [row(1), row(2)])
    other = experiment(tmp_path / "other", [row(1), row(2)], "sorghum")
    with pytest.raises(SystemExit) as ended:
        main(["compare_experiments", one, other])
    said = f"found the worlds corn in {one} and sorghum in {other}, expected one and the same"
    printed = capsys.readouterr().err
    assert ended.value.code == 2 and said in printed and printed.count("\n") == 1
