# SPDX-License-Identifier: MIT
"""Reads the logs of a real TerraSentia's run, as github.com/Hlwy/terra_data_utils has them.

`lidar_log.csv`: a scan a line, first the time [ms], then the UST-10LX's ranges [mm] from -135 degrees in steps of
0.25, counter-clockwise; 0, and 65000 and more, is no return. Of another lidar after a line
`angle_min_rad,NUMBER,increment_rad,NUMBER`, where 0 alone is no return, and -1 (any negative number) a return nearer
than the lidar measures. `perception_lidar_log.csv`: settings (name, value, ...), names of columns, LBIRNT's outputs.
"""
import csv
import math
from pathlib import Path
from typing import Dict, List, NamedTuple, Tuple

import numpy as np

from ardee_campaigns.lane.scans import Perceived, Scans
from ardee_common.errors import GeneratorError

LIDAR_LOG, PERCEPTION_LOG = "lidar_log.csv", "perception_lidar_log.csv"
BEAMS = (1080, 1081)  # the UST-10LX's 270 degrees, without and with the last beam
ANGLE_MIN_RAD, INCREMENT_RAD = math.radians(-135.0), math.radians(0.25)
NO_RETURN_MM = 65_000.0  # as much and more; 0 too
_LARGEST_BYTES = 1 << 30
_COLUMNS = ("lidar_ts_ms", "distance_left", "distance_right", "heading")


class RealRun(NamedTuple):
    """A real run: its scans, what its own follower perceived, and the lane's width which that was told."""

    scans: Scans
    perceived: Perceived
    lane_width_m: float


def _lines(path: Path) -> List[List[str]]:
    """Returns the cells of each line."""
    try:
        if path.stat().st_size > _LARGEST_BYTES:
            raise GeneratorError(f"{path}: found more than {_LARGEST_BYTES} bytes, expected fewer")
        with path.open(newline="") as file:
            return [line for line in csv.reader(file)]
    except OSError as error:
        raise GeneratorError(f"{path}: cannot be read: {error.strerror}") from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise GeneratorError(f"{path}: not a CSV file: {error}") from error


def _number(text: str, where: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise GeneratorError(f"{where}: found {text!r}, expected a number")
    return value


def _check_times(times: np.ndarray, path: Path, first_line: int) -> np.ndarray:
    """Returns the times [s] of a log's lines; they must grow."""
    if len(times) < 2:
        raise GeneratorError(f"{path}: found {len(times)} lines of data, expected 2 or more")
    backwards = np.flatnonzero(np.diff(times) <= 0.0)
    if len(backwards):
        line = first_line + int(backwards[0]) + 1
        raise GeneratorError(
            f"{path}:{line}: found a time not later than the line's before, expected a later one"
        )
    return times / 1e3


def _angles(line: List[str], where: str) -> Tuple[float, float]:
    """Returns first angle and increment [rad] of a header."""
    if line[2::2] != ["increment_rad"] or len(line) != 4:
        found = ",".join(line)[:60]
        raise GeneratorError(
            f"{where}: found {found!r}, expected angle_min_rad,NUMBER,increment_rad,NUMBER"
        )
    first, increment = (_number(line[place], where) for place in (1, 3))
    if increment <= 0.0:
        raise GeneratorError(f"{where}: increment_rad: found {increment}, expected more than 0")
    return first, increment


def read_scans(path: Path) -> Scans:
    """Reads a lidar_log.csv."""
    lines, rows, first_line = _lines(path), [], 1
    angles, beams, most_mm = (ANGLE_MIN_RAD, INCREMENT_RAD), BEAMS, NO_RETURN_MM
    has_head = bool(lines) and lines[0][:1] == ["angle_min_rad"]
    if has_head:
        angles, first_line = _angles(lines.pop(0), f"{path}:1"), 2
        beams, most_mm = ((len(lines[0]) - 1,) if lines else BEAMS), math.inf
    for number, line in enumerate(lines, first_line):
        if len(line) - 1 not in beams or rows and len(line) != len(rows[0]):
            known = str(len(rows[0]) - 1) if rows else f"a time and {BEAMS[0]} or {BEAMS[1]} ranges"
            raise GeneratorError(f"{path}:{number}: found {len(line) - 1} ranges, expected {known}")
        rows.append([_number(cell, f"{path}:{number}") for cell in line])
    time_s = _check_times(np.array([row[0] for row in rows]), path, first_line)
    ranges_mm = np.array(rows)[:, 1:]
    seen = (ranges_mm > 0.0) & (ranges_mm < most_mm)
    near = has_head & (ranges_mm < 0.0)
    return Scans(time_s, np.where(near, 0.0, np.where(seen, ranges_mm / 1e3, np.inf)), *angles)


def write_scans(scans: Scans, path: Path) -> None:
    """Writes scans as a lidar_log.csv, times and ranges to a thousandth of their units."""
    with path.open("w") as file:
        first, increment = float(scans.angle_min_rad), float(scans.increment_rad)
        file.write(f"angle_min_rad,{first!r},increment_rad,{increment!r}\n")
        for time_s, ranges_m in zip(scans.time_s, scans.ranges_m):
            numbers = np.where(ranges_m > 0.0, 1e3 * ranges_m, -1.0)
            cells = (f"{value:.3f}" if np.isfinite(value) else "0" for value in numbers)
            file.write(f"{1e3 * time_s:.3f},{','.join(cells)}\n")


def _read_perceived(path: Path) -> Tuple[Perceived, float]:
    lines = _lines(path)
    settings, names = (lines + [[], []])[:2]
    values = dict(zip(settings[::2], settings[1::2]))
    if "LANE_WIDTH" not in values:
        raise GeneratorError(f"{path}:1: found no LANE_WIDTH, expected it among the settings")
    missing = [name for name in _COLUMNS if name not in names]
    if missing:
        raise GeneratorError(f"{path}:2: found no column {missing[0]!r}, expected its name")
    places = [names.index(name) for name in _COLUMNS]
    columns: Dict[str, List[float]] = {name: [] for name in _COLUMNS}
    for number, line in enumerate(lines[2:], 3):
        if len(line) <= max(places):  # columns after those that are read may be missing
            found = f"found {len(line)} columns, expected at least {max(places) + 1}"
            raise GeneratorError(f"{path}:{number}: {found}")
        for name, place in zip(_COLUMNS, places):
            columns[name].append(_number(line[place], f"{path}:{number}: {name}"))
    time_ms, left, right, heading = (np.array(columns[name]) for name in _COLUMNS)
    time_s = _check_times(time_ms, path, 3)
    nothing = np.full((len(time_s), 2), np.nan)  # it does not log the points' spread
    width_m = _number(values["LANE_WIDTH"], f"{path}:1: LANE_WIDTH")
    return Perceived(time_s, left, right, heading, nothing), width_m


def read_real_run(folder: Path) -> RealRun:
    """Reads the two logs of a run's folder."""
    scans = read_scans(folder / LIDAR_LOG)
    return RealRun(scans, *_read_perceived(folder / PERCEPTION_LOG))
