# SPDX-License-Identifier: MIT
"""Reference for a row follower: rows and stalks of a field's truth file, and the lane between two rows."""
import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import List, NamedTuple, Tuple

import numpy as np

from ardee_common.errors import GeneratorError

_LARGEST_BYTES = 1 << 30
_LANE_VERTEX_M = 0.25
_SAME_WAY_RAD = math.pi / 2


class Pose(NamedTuple):
    """A pose on the ground plan, in the world frame."""

    x_m: float
    y_m: float
    yaw_rad: float


@dataclass(frozen=True)
class Stalks:
    """Every plant's stalk in the world."""

    xy_m: np.ndarray  # (n, 2)
    radius_m: np.ndarray


@dataclass(frozen=True)
class Field:
    """Rows as polylines (n, 2) and stalks, in the world."""

    rows: Tuple[np.ndarray, ...]
    stalks: Stalks


def read_field(path: Path) -> Field:
    """Reads a generator's truth.json."""
    try:
        if path.stat().st_size > _LARGEST_BYTES:
            raise GeneratorError(f"{path}: found more than {_LARGEST_BYTES} bytes, expected fewer")
        truth = json.loads(path.read_text())
        rows = tuple(np.array(row["world_line_m"], dtype=float) for row in truth["rows"])
        plants = truth["plants"]
        xy = np.column_stack((plants["world_x_m"], plants["world_y_m"])).astype(float)
        radius = np.array(plants["stalk_diameter_m"], dtype=float) / 2.0
    except OSError as error:
        raise GeneratorError(f"{path}: cannot be read: {error.strerror}") from error
    except (ValueError, KeyError, TypeError) as error:
        raise GeneratorError(f"{path}: not a field's truth file: {error!r}") from error
    if any(row.ndim != 2 or row.shape[1] != 2 or not np.isfinite(row).all() for row in rows):
        raise GeneratorError(f"{path}: rows: found one that is no polyline, expected lists of x, y")
    # a row of a single plant has no direction: its stalk stays, but no lane runs along it
    return Field(tuple(row for row in rows if len(distinct(row)) > 1), Stalks(xy, radius))


def distinct(line_m: np.ndarray) -> np.ndarray:
    """Returns the points of a line without those that repeat the one before: they have no direction."""
    is_new = np.concatenate(([True], np.diff(line_m, axis=0).any(axis=1)))
    return line_m[is_new]


def _arc_m(line_m: np.ndarray) -> np.ndarray:
    return np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(line_m, axis=0).T))))


def _resampled(line_m: np.ndarray, fractions: np.ndarray) -> np.ndarray:
    arc = _arc_m(line_m)
    return np.column_stack([np.interp(fractions * arc[-1], arc, column) for column in line_m.T])


class Projection(NamedTuple):
    """Nearest point of a polyline to a place: how far along, how far to its left the place is, its direction there."""

    along_m: float
    left_m: float
    direction_rad: float


class Polyline:
    """A line of straight pieces; its first and last piece go on beyond its ends."""

    def __init__(self, points_m: np.ndarray) -> None:
        points_m = distinct(points_m)
        self.points_m = points_m
        step = np.diff(points_m, axis=0)
        self._length_m = np.hypot(*step.T)
        self._unit = step / self._length_m[:, None]
        self._low_m, self._high_m = np.zeros(len(step)), self._length_m.copy()
        self._low_m[:1], self._high_m[-1:] = -np.inf, np.inf
        self._arc_m = _arc_m(points_m)

    @property
    def length_m(self) -> float:
        """Length from the first to the last point."""
        return float(self._arc_m[-1])

    def project(self, x_m: float, y_m: float) -> Projection:
        """Returns the projection onto the nearest point."""
        offset = np.array([x_m, y_m]) - self.points_m[:-1]
        unit = self._unit
        on = np.minimum(np.maximum((offset * unit).sum(axis=1), self._low_m), self._high_m)
        away = offset - on[:, None] * unit
        i = int(np.argmin((away * away).sum(axis=1)))
        left = unit[i, 0] * offset[i, 1] - unit[i, 1] * offset[i, 0]
        beyond = math.hypot(*away[i])
        direction = math.atan2(unit[i, 1], unit[i, 0])
        return Projection(
            float(self._arc_m[i] + on[i]), math.copysign(beyond, left), float(direction)
        )

    def at(self, along_m: float) -> Pose:
        """Returns the point and the direction at a distance along the line."""
        i = int(np.clip(np.searchsorted(self._arc_m, along_m) - 1, 0, len(self._unit) - 1))
        unit = self._unit[i]
        x, y = self.points_m[i] + (along_m - self._arc_m[i]) * unit
        return Pose(float(x), float(y), math.atan2(unit[1], unit[0]))


class Deviation(NamedTuple):
    """Position and heading of a robot relative to its lane."""

    along_m: float  # on the centre line, from the row's first place
    lateral_m: float  # positive: left of the centre line
    heading_rad: float  # positive: turned left of it
    left_m: float  # to the left row
    right_m: float  # to the right row


@dataclass(frozen=True)
class Lane:
    """The lane between two neighbouring rows, seen in the direction of travel."""

    left: Polyline
    right: Polyline
    centre: Polyline

    def deviation(self, pose: Pose) -> Deviation:
        """Returns a pose's deviation from the centre line and its distances to the rows' ideal lines."""
        x, y, yaw = pose
        centre = self.centre.project(x, y)
        left, right = self.left.project(x, y), self.right.project(x, y)
        heading = math.remainder(yaw - centre.direction_rad, math.tau)
        return Deviation(centre.along_m, centre.left_m, heading, -left.left_m, right.left_m)


def _towards(row: np.ndarray, yaw_rad: float) -> np.ndarray:
    """The row's points in the order in which a robot of that heading passes them."""
    step = row[1] - row[0]
    turn = math.remainder(math.atan2(step[1], step[0]) - yaw_rad, math.tau)
    return row if abs(turn) < _SAME_WAY_RAD else row[::-1]


def lane_of(field: Field, start: Pose) -> Lane:
    """The lane before which a robot starts: between the nearest row on its left and the nearest on its right."""
    left: List[Tuple[float, Polyline]] = []
    right: List[Tuple[float, Polyline]] = []
    for row in field.rows:
        line = Polyline(_towards(row, start.yaw_rad))
        seen = line.project(start.x_m, start.y_m)
        if abs(math.remainder(seen.direction_rad - start.yaw_rad, math.tau)) > math.pi / 4:
            continue  # a row across the headland
        (right if seen.left_m > 0 else left).append((abs(seen.left_m), line))
    if not left or not right:
        raise GeneratorError(
            f"start pose {start.x_m:.2f} {start.y_m:.2f}: found {len(left)} rows on its left and {len(right)} on its"
            " right, expected some on both"
        )
    one, other = (min(rows, key=lambda row: row[0])[1] for rows in (left, right))
    count = max(int(one.length_m / _LANE_VERTEX_M), 1) + 1
    fractions = np.linspace(0.0, 1.0, count)
    middle = (_resampled(one.points_m, fractions) + _resampled(other.points_m, fractions)) / 2.0
    return Lane(one, other, Polyline(middle))
