# SPDX-License-Identifier: MIT
"""Tests the tables of a campaign's folder: what is written is read, in any order of writing the same bytes."""
import math
from pathlib import Path
from typing import List

import pyarrow as pa
import pytest

from ardee_campaigns import tables
from ardee_common.errors import GeneratorError

SCHEMA = tables.runs_schema(
    {"speed_m_s": pa.float64(), "kind": pa.string()}, ["distance_m", "collisions"], {"name": "a"}
)


def row(run_id: str, **changes: object) -> tables.RunRow:
    values = {
        "run_id": run_id,
        "world": "field",
        "robot": "tsv1",
        "controller": "constant",
        "factors": {"speed_m_s": 1, "kind": "x"},
        "replicate": 0,
        "seed": 2**64 - 1,
        "status": tables.OK,
        "sim_s": 2.5,
        "measures": {"distance_m": 1.25, "collisions": 3},
    }
    return tables.RunRow(**{**values, **changes})


def test_a_whole_number_that_no_float_holds_is_rounded(tmp_path: Path) -> None:
    large = row("0" * 16, factors={"speed_m_s": 2**53 + 1, "kind": "x"})
    assert tables._flat(large, SCHEMA)["factor_speed_m_s"] == float(2**53)


def samples(count: int) -> pa.Table:
    line = {name: 0 for name, _ in tables.SAMPLE_FIELDS}
    line.update(event="", raw_along_m=[1.0, 2.0], raw_lateral_m=[0.25, -0.25])
    lines = [{**line, "time_ns": number, "x_m": number / 8} for number in range(count)]
    return pa.Table.from_pylist(lines, schema=tables.RUN_FILE_SCHEMA)


def run(run_id: str, count: int = 3) -> tables.RunFile:
    timing = tables.Timing(run_id, 0.5, "host", 2, "the worker died")
    return tables.RunFile(row(run_id), timing, samples(count), {"length_m": 5.0})


def test_rows_come_back_sorted_with_factors_and_measures(tmp_path: Path) -> None:
    rows = [row("b"), row("a", status=tables.FAILED, error="why", sim_s=math.nan, measures={})]
    tables.write_runs(tmp_path, rows, SCHEMA)
    read = tables.read_runs(tmp_path)
    assert read.column("run_id").to_pylist() == ["a", "b"]
    assert read.column("seed").to_pylist() == [2**64 - 1] * 2
    assert read.column("factor_speed_m_s").to_pylist() == [1.0, 1.0]
    assert math.isnan(read.column("distance_m")[0].as_py())
    assert read.column("collisions")[1].as_py() == 3.0
    assert tables.factors_of(read.schema) == ["speed_m_s", "kind"]
    assert tables.measures_of(read.schema) == ["distance_m", "collisions"]
    assert read.schema.metadata[b"name"] == b"a"


def test_the_order_of_the_rows_does_not_show_in_the_bytes(tmp_path: Path) -> None:
    def written(rows: List[tables.RunRow]) -> bytes:
        return tables.write_runs(tmp_path, rows, SCHEMA).read_bytes()

    rows = [row(name) for name in "cab"]
    assert written(rows) == written(rows[::-1])
    assert written(rows) != written([row("d"), *rows])


def test_a_runs_own_file_holds_all_of_it(tmp_path: Path) -> None:
    tables.write_run(tmp_path, run("a"))
    read = tables.read_run(tmp_path, "a")
    assert (read.row, read.timing, read.about) == (row("a"), run("a").timing, {"length_m": 5.0})
    assert read.samples.equals(samples(3))
    assert tables.read_run_head(tmp_path, "a").row == row("a")
    assert [path.name for path in (tmp_path / "runs").iterdir()] == ["a.parquet"]


def test_samples_of_all_runs_can_be_read_in_part(tmp_path: Path) -> None:
    for name, count in (("b", 2), ("a", 3), ("c", 0)):
        tables.write_run(tmp_path, run(name, count))
    assert tables.finished(tmp_path) == ["a", "b", "c"]
    tables.write_samples(tmp_path, tables.finished(tmp_path))
    assert tables.read_samples(tmp_path).column("run_id").to_pylist() == list("aaabb")
    part = tables.read_samples(tmp_path, ["b"], ["run_id", "x_m"])
    assert part.to_pydict() == {"run_id": ["b", "b"], "x_m": [0.0, 0.125]}


def test_timings_come_back(tmp_path: Path) -> None:
    tables.write_timings(tmp_path, [run("b").timing, run("a").timing])
    assert tables.read_timings(tmp_path).to_pylist()[0] == vars(run("a").timing)


@pytest.mark.parametrize(
    "values, kind",
    [
        ([True, False], pa.bool_()),
        ([1, 2.5], pa.float64()),
        (["a", 1], pa.string()),
        ([True, 1], pa.string()),
    ],
)
def test_a_factors_column_fits_its_values(values: list, kind: pa.DataType) -> None:
    assert tables.factor_type(values) == kind


@pytest.mark.parametrize("text", [None, b"", b"PAR1 but nothing else"])
def test_a_file_that_is_no_table_is_named_in_one_line(tmp_path: Path, text: object) -> None:
    if text is not None:
        (tmp_path / tables.RUNS).write_bytes(text)
    with pytest.raises(GeneratorError) as caught:
        tables.read_runs(tmp_path)
    assert str(tmp_path / tables.RUNS) in str(caught.value) and "\n" not in str(caught.value)
