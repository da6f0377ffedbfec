# SPDX-License-Identifier: MIT
"""Tables of a campaign's folder as parquet files, each written whole: runs, timings, samples, and a file for each run.

    OUTPUT/runs/<run_id>.parquet   samples of one run; its row and timing as metadata
    OUTPUT/runs.parquet            one row a run, sorted by run_id; the same bytes however the campaign was worked off
    OUTPUT/timings.parquet         one row a run: what differs each time
    OUTPUT/samples.parquet         samples of all runs, sorted by run_id and time

SI units, in the names of the columns; poses of the robot in the world; lateral and heading from the lane's centre line,
positive to the left. A number that is not known is NaN.
"""
import contextlib
import dataclasses
import json
import math
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict, Iterator, List, Mapping, Optional, Sequence, Union

import pyarrow as pa
import pyarrow.parquet as pq

from ardee_common.errors import GeneratorError
from ardee_common.output import write_file

VERSION = 1  # of the tables
RUNS, TIMINGS, SAMPLES, FOLDER = "runs.parquet", "timings.parquet", "samples.parquet", "runs"
OK, FAILED = "ok", "failed"
# Key of the metadata of runs.parquet: names of the factors of a low and a high value.
SCALES = "scales"
_COMPRESSION = "zstd"
Factor = Union[float, str, bool]

_REQUIRED = (
    ("run_id", pa.string()),  # hash of all inputs of the run
    ("world", pa.string()),  # name in the campaign's file
    ("robot", pa.string()),
    ("controller", pa.string()),
)
_OUTCOME = (
    ("replicate", pa.int32()),
    ("seed", pa.uint64()),  # the same for all robots, controllers and factors
    ("status", pa.string()),  # ok or failed
    ("error", pa.string()),  # one line; empty if status is ok
    ("end_reason", pa.string()),
    ("sim_s", pa.float64()),  # simulated time from the start of driving
)
TIMING_SCHEMA = pa.schema(
    [
        ("run_id", pa.string()),
        ("wall_s", pa.float64()),  # real time of the last attempt
        ("host", pa.string()),
        ("attempts", pa.int32()),  # 1, and one more for each worker that was lost or stalled
        ("lost", pa.string()),  # why the attempts before the last one were lost, one line each
    ]
)
SAMPLE_FIELDS = (
    ("time_ns", pa.int64()),  # simulated
    ("x_m", pa.float64()),
    ("y_m", pa.float64()),
    ("yaw_rad", pa.float64()),
    ("command_speed_m_s", pa.float64()),
    ("command_turn_rad_s", pa.float64()),
    ("along_m", pa.float64()),  # on the lane's centre line, from the rows' first place
    ("lateral_m", pa.float64()),  # from the centre line, positive to the left
    ("heading_rad", pa.float64()),
    ("left_true_m", pa.float64()),  # from the sensor to the ideal line of the left row
    ("right_true_m", pa.float64()),
    ("left_seen_m", pa.float64()),  # as the controller perceives it; NaN if it does not say
    ("right_seen_m", pa.float64()),
    ("touching", pa.int32()),  # stalks in contact with the robot's outline
    ("charge_a_h", pa.float64()),  # left in the battery
    ("energy_j", pa.float64()),  # taken from the battery since the start of driving
    ("event", pa.string()),  # why a person stepped in after this sample, or empty
)
# Of a run's own file alone: returns of the lidar abeam of it
RAW_FIELDS = (
    ("raw_along_m", pa.list_(pa.float32())),
    ("raw_lateral_m", pa.list_(pa.float32())),  # from the lidar, positive to the left
)
SAMPLE_SCHEMA = pa.schema([("run_id", pa.string()), *SAMPLE_FIELDS])
RUN_FILE_SCHEMA = pa.schema([*SAMPLE_FIELDS, *RAW_FIELDS])


@dataclass(frozen=True)
class RunRow:
    """Row of runs.parquet."""

    run_id: str
    world: str
    robot: str
    controller: str
    factors: Mapping[str, Factor]
    replicate: int
    seed: int
    status: str
    error: str = ""
    end_reason: str = ""
    sim_s: float = math.nan
    measures: Mapping[str, float] = dataclasses.field(default_factory=dict)


@dataclass(frozen=True)
class Timing:
    """Row of timings.parquet."""

    run_id: str
    wall_s: float
    host: str
    attempts: int = 1
    lost: str = ""


@dataclass(frozen=True)
class RunFile:
    """All that one run left behind."""

    row: RunRow
    timing: Timing
    samples: pa.Table  # RUN_FILE_SCHEMA; empty if the run failed before its first sample
    about: Mapping[str, Any]  # length_m and width_m of the lane, lidar_ahead_m, limits, versions


RUN_COLUMNS = tuple(
    name for name, _ in (*_REQUIRED, *_OUTCOME)
)  # before those of factors and measures


def runs_schema(
    factors: Mapping[str, pa.DataType], measures: Sequence[str], about: Mapping[str, str]
) -> pa.Schema:
    """Returns the schema of runs.parquet; factors to their types in the file's order; `about` becomes its metadata."""
    return pa.schema(
        [
            *_REQUIRED,
            *((f"factor_{name}", kind) for name, kind in factors.items()),
            *_OUTCOME,
            *((name, pa.float64()) for name in measures),
        ],
        metadata={"ardee_tables": str(VERSION), **about},
    )


def factor_type(values: Sequence[Factor]) -> pa.DataType:
    """Returns the column type of a factor's values: truth values, numbers, or texts where they are mixed."""
    if all(isinstance(value, bool) for value in values):
        return pa.bool_()
    if all(isinstance(value, (int, float)) and not isinstance(value, bool) for value in values):
        return pa.float64()
    return pa.string()


def stored(values: Sequence[Factor]) -> List[Factor]:
    """Returns a factor's values as its column has them."""
    return _converted(values, factor_type(values))


def _converted(values: Sequence[Factor], kind: pa.DataType) -> List[Factor]:
    convert = str if kind == pa.string() else float if kind == pa.float64() else bool
    return [convert(value) for value in values]


def _flat(row: RunRow, schema: pa.Schema) -> Dict[str, Any]:
    """Returns the row with a column for each factor and measure; what it lacks is NaN, or null if it is a text."""
    flat = dict(vars(row))
    measures = flat.pop("measures")
    for name, value in flat.pop("factors").items():
        column = f"factor_{name}"
        (flat[column],) = _converted([value], schema.field(column).type)
    flat.update({name: float(value) for name, value in measures.items()})
    for field in schema:
        if field.type == pa.float64():
            flat.setdefault(field.name, math.nan)
    return flat


def _bytes(table: pa.Table) -> bytes:
    sink = pa.BufferOutputStream()
    pq.write_table(table, sink, compression=_COMPRESSION)
    return sink.getvalue().to_pybytes()


def write_runs(folder: Path, rows: Sequence[RunRow], schema: pa.Schema) -> Path:
    """Writes runs.parquet, sorted by run_id; returns its path."""
    ordered = sorted(rows, key=lambda row: row.run_id)
    table = pa.Table.from_pylist([_flat(row, schema) for row in ordered], schema=schema)
    write_file(folder / RUNS, _bytes(table))
    return folder / RUNS


def write_timings(folder: Path, timings: Sequence[Timing]) -> Path:
    """Writes timings.parquet, sorted by run_id; returns its path."""
    ordered = sorted(timings, key=lambda timing: timing.run_id)
    table = pa.Table.from_pylist([vars(timing) for timing in ordered], schema=TIMING_SCHEMA)
    write_file(folder / TIMINGS, _bytes(table))
    return folder / TIMINGS


def run_path(folder: Path, run_id: str) -> Path:
    """Returns the path of a run's own file."""
    return folder / FOLDER / f"{run_id}.parquet"


def write_run(folder: Path, run: RunFile) -> Path:
    """Writes a run's own file; its presence says that the run is done."""
    about = {
        "row": json.dumps(dataclasses.asdict(run.row)),
        "timing": json.dumps(dataclasses.asdict(run.timing)),
        "about": json.dumps(run.about),
    }
    table = run.samples.cast(RUN_FILE_SCHEMA).replace_schema_metadata(about)
    path = run_path(folder, run.row.run_id)
    write_file(path, _bytes(table))
    return path


@contextlib.contextmanager
def _readable(path: Path) -> Iterator[None]:
    """Turns any failure to read a table into one line."""
    try:
        yield
    except FileNotFoundError:
        raise GeneratorError(f"{path}: found no such file, expected a campaign's table") from None
    except (OSError, ValueError, KeyError, TypeError, pa.ArrowException) as error:
        what = " ".join(str(error).split())
        raise GeneratorError(f"{path}: not a campaign's table: {what}") from None


def read_run(folder: Path, run_id: str) -> RunFile:
    """Reads a run's own file."""
    path = run_path(folder, run_id)
    with _readable(path):
        with pq.ParquetFile(path) as file:
            samples = file.read()
        about = {key.decode(): json.loads(text) for key, text in _metadata(samples.schema).items()}
        row, timing = RunRow(**about["row"]), Timing(**about["timing"])
        return RunFile(row, timing, samples.replace_schema_metadata(None), about["about"])


def read_run_head(folder: Path, run_id: str) -> RunFile:
    """Reads row, timing and `about` of a run's own file; its samples are left out."""
    path = run_path(folder, run_id)
    with _readable(path):
        schema = pq.read_schema(path)
        about = {key.decode(): json.loads(text) for key, text in _metadata(schema).items()}
        row, timing = RunRow(**about["row"]), Timing(**about["timing"])
        return RunFile(row, timing, RUN_FILE_SCHEMA.empty_table(), about["about"])


def _metadata(schema: pa.Schema) -> Dict[bytes, bytes]:
    return {key: text for key, text in (schema.metadata or {}).items() if key != b"ARROW:schema"}


def finished(folder: Path) -> List[str]:
    """Returns the ids of the runs that have a file, sorted."""
    return sorted(path.stem for path in (folder / FOLDER).glob("[!.]*.parquet"))


def write_samples(folder: Path, run_ids: Sequence[str]) -> Path:
    """Writes samples.parquet from the runs' own files, one at a time, a row group each; returns its path."""
    path = folder / SAMPLES
    temporary = path.with_name(f".{path.name}.new")
    try:
        with pq.ParquetWriter(temporary, SAMPLE_SCHEMA, compression=_COMPRESSION) as writer:
            for run_id in sorted(run_ids):
                samples = read_run(folder, run_id).samples
                names = pa.array([run_id] * len(samples), pa.string())
                columns = [names, *(samples.column(name) for name, _ in SAMPLE_FIELDS)]
                writer.write_table(pa.Table.from_arrays(columns, schema=SAMPLE_SCHEMA))
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)
    return path


def read_runs(folder: Path) -> pa.Table:
    """Reads runs.parquet; factors are the columns factor_*, measures those after sim_s."""
    return read_table(folder / RUNS)


def read_table(path: Path) -> pa.Table:
    """Reads a table."""
    with _readable(path):
        return pq.read_table(path)


def factors_of(schema: pa.Schema) -> List[str]:
    """Returns the names of the factors of runs.parquet."""
    return [name[len("factor_") :] for name in schema.names if name.startswith("factor_")]


def scales_of(schema: pa.Schema) -> List[str]:
    """Returns the names of the factors of runs.parquet that have a low and a high value."""
    return (schema.metadata or {}).get(SCALES.encode(), b"").decode().split()


def measures_of(schema: pa.Schema) -> List[str]:
    """Returns the names of the measures of runs.parquet."""
    return schema.names[schema.get_field_index("sim_s") + 1 :]


def read_timings(folder: Path) -> pa.Table:
    """Reads timings.parquet."""
    return read_table(folder / TIMINGS)


def read_samples(
    folder: Path, run_ids: Optional[Sequence[str]] = None, columns: Optional[Sequence[str]] = None
) -> pa.Table:
    """Reads samples.parquet: of all runs, or of some; all columns, or some."""
    chosen = None if run_ids is None else [("run_id", "in", list(run_ids))]
    names = None if columns is None else list(columns)
    with _readable(folder / SAMPLES):
        return pq.read_table(folder / SAMPLES, columns=names, filters=chosen)
