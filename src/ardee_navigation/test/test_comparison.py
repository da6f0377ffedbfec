# SPDX-License-Identifier: MIT
"""Tests the comparison of experiments: intervals against closed forms and tables, pairs by seed, bad files."""
import math
from pathlib import Path
from typing import Dict, List

import numpy as np
import pytest

from ardee_common.errors import GeneratorError
from ardee_navigation.evaluation.comparison import (
    compare,
    mean_interval,
    poisson_interval,
    read_runs,
)

NAMES = "run,seed,end,way_m,lateral_rms_m,lateral_max_m,share_near,heading_rms_rad,width_m,interventions"
HEADER = NAMES + ",collisions,knocked,completed"


def runs_csv(folder: Path, lines: List[str]) -> Path:
    folder.mkdir(exist_ok=True)
    (folder / "runs.csv").write_text("\n".join([HEADER, *lines]) + "\n")
    return folder


def line(seed: int, rms_m: float = 0.01, interventions: int = 0) -> str:
    return f"0,{seed},end of the row,50,{rms_m},0.04,1,0.02,0.7,{interventions},0,0,1"


def rows(text: str) -> Dict[str, List[str]]:
    cells = [[c.strip() for c in row.split("|")[1:-1]] for row in text.splitlines() if "|" in row]
    return {row[0]: row[1:] for row in cells}


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


def test_runs_are_paired_by_seed(tmp_path: Path) -> None:
    one = runs_csv(tmp_path / "one", [line(1, 0.010), line(2, 0.030), line(9, 0.5, 50)])
    other = runs_csv(tmp_path / "other", [line(2, 0.033, 2), line(1, 0.011), line(7, 0.5, 50)])
    text = compare(read_runs(one), read_runs(other), ("one", "other"))
    found, reach = rows(text), 0.1 * math.tan(0.475 * math.pi)
    assert text.startswith("2 pairs of runs, seeds 1, 2; 2 runs without a partner are left out")
    interval = f"{0.2 - reach:+.2f} to {0.2 + reach:+.2f}"
    assert found["lateral RMS [cm]"] == ["2.00", "2.20", "+0.20", interval]
    assert found["interventions"][:3] == ["0.00", "1.00", "+1.00"]
    assert "one: 0 in 100.0 m: 0.00 per 100 m, 0.00 to 3.69" in text
    assert "other: 2 in 100.0 m: 2.00 per 100 m, 0.24 to 7.22" in text


def test_pairs_without_any_way_are_left_out_and_said_so(tmp_path: Path) -> None:
    astray = "0,9,given up,0,nan,nan,nan,nan,nan,100,0,0,0"
    one = read_runs(runs_csv(tmp_path / "one", [line(1, 0.01), line(2, 0.03), line(9)]))
    other = read_runs(runs_csv(tmp_path / "other", [line(1, 0.01), line(2, 0.03), astray]))
    text = compare(one, other, ("one", "other"))
    assert "seeds 1, 2; 1 pairs with a run that never came between the rows are left out" in text
    assert "other: 0 in 100.0 m" in text and "nan" not in text


def test_an_experiment_does_not_differ_from_itself(tmp_path: Path) -> None:
    runs = read_runs(runs_csv(tmp_path / "one", [line(1), line(2, 0.02)]))
    differences = [row[2:] for name, row in rows(compare(runs, runs, ("a", "b"))).items()][2:]
    assert len(differences) == 9 and all(d == ["+0.00", "+0.00 to +0.00"] for d in differences)


@pytest.mark.parametrize(
    "lines, message",
    [
        (["0,1,end"], r"runs.csv:2: not a line of run_experiment's runs.csv"),
        ([line(1), line(1)], r"runs.csv:3: found seed 1 twice"),
        ([line(1, math.inf)], r"runs.csv:2: lateral_rms_m: found inf, expected a number"),
        ([line(1).replace(",50,", ",far,")], r"runs.csv:2: .*'far'"),
    ],
)
def test_bad_files_are_named_with_their_line(
    tmp_path: Path, lines: List[str], message: str
) -> None:
    with pytest.raises(GeneratorError, match=message):
        read_runs(runs_csv(tmp_path / "bad", lines))


def test_too_little_to_compare(tmp_path: Path) -> None:
    with pytest.raises(GeneratorError, match="runs.csv: cannot be read: No such file"):
        read_runs(tmp_path / "nowhere")
    one = read_runs(runs_csv(tmp_path / "one", [line(1), line(2)]))
    other = read_runs(runs_csv(tmp_path / "other", [line(2), line(3)]))
    with pytest.raises(GeneratorError, match="found 1 seeds whose runs .* expected 2"):
        compare(one, other, ("one", "other"))
