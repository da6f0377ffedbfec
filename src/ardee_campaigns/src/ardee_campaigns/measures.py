# SPDX-License-Identifier: MIT
"""Measures: functions of a recorded run and the truth of its field, by name or as module:function.

A measure is called as `measure(run, truth)` and returns a number, NaN where there is none. `run` is a Recorded, `truth`
the ardee_world.trial.Trial of the run. Errors on the way are weighted by the way that each sample stands for.
"""
import math
from dataclasses import dataclass
from typing import Any, Callable, Dict, Mapping, Sequence

import numpy as np

from ardee_campaigns import tables
from ardee_campaigns.campaign_file import TaskKeys
from ardee_campaigns.controllers import load_function
from ardee_campaigns.outline import Contacts
from ardee_campaigns.task import END_OF_ROW
from ardee_common.errors import GeneratorError, known_names
from ardee_world.row_truth import Lane, Polyline
from ardee_world.trial import Trial

NEAR_M = 0.10  # the share of the way that lies within this of the centre line
_COVER_M = 0.25  # a place of a lane is driven over if the robot's middle comes as near
_WIDEST_LANE_M = 2.0
_HEADLAND_M = 2.0  # depth of the headland behind either end of the rows
_CELL_M = 0.25  # of the headland's grid


@dataclass(frozen=True)
class Recorded:
    """A run as measures see it: columns of its samples (tables.SAMPLE_FIELDS) by name."""

    columns: Mapping[str, np.ndarray]
    lane: Lane  # down which it went
    width_m: float  # of the lane, ideal
    contacts: Contacts
    task: TaskKeys
    end: str

    def __getitem__(self, name: str) -> np.ndarray:
        """Returns a column."""
        return self.columns[name]

    def way_m(self) -> np.ndarray:
        """Returns the way along the lane of each sample, 0 outside of it and where the robot was carried."""
        along = self["along_m"]
        step = np.diff(along, prepend=along[:1])
        is_in_row = (along >= 0.0) & (along <= self.lane.centre.length_m)
        return np.where((step > 0.0) & ~self.was_carried() & is_in_row, step, 0.0)

    def was_carried(self) -> np.ndarray:
        """Returns of each sample whether a person set the robot down between the one before and it."""
        stepped_in = self["event"] != ""
        return np.concatenate(([False], stepped_in[:-1]))

    def mean(self, values: np.ndarray) -> float:
        """Returns the mean of a column over the way."""
        way = self.way_m()
        good = (way > 0.0) & np.isfinite(values)
        return float(np.average(values[good], weights=way[good])) if good.any() else math.nan

    def rms(self, values: np.ndarray) -> float:
        """Returns the root mean square of a column over the way."""
        return math.sqrt(self.mean(values**2))

    def largest(self, values: np.ndarray) -> float:
        """Returns the largest amount of a column on the way."""
        chosen = np.abs(values[self.way_m() > 0.0])
        return float(chosen.max()) if len(chosen) else math.nan

    def perceived_width_m(self) -> np.ndarray:
        """Returns the width of the lane as the controller perceives it."""
        return self["left_seen_m"] + self["right_seen_m"]


def _interventions(run: Recorded, _truth: Trial) -> float:
    return float(np.count_nonzero(run["event"] != ""))


def _width_sd_m(run: Recorded, _truth: Trial) -> float:
    width = run.perceived_width_m()
    return run.rms(width - run.mean(width))


def _driven_m(run: Recorded) -> float:
    step = np.hypot(np.diff(run["x_m"]), np.diff(run["y_m"]))
    return float(step[~run.was_carried()[1:]].sum())


def _time_s(run: Recorded, _truth: Trial) -> float:
    time_ns = run["time_ns"]
    return float(time_ns[-1] - time_ns[0]) * 1e-9


def _near_path(points_m: np.ndarray, run: Recorded, near_m: float) -> np.ndarray:
    """Returns which of the points (n, 2) the robot's middle came near."""
    path = np.column_stack((run["x_m"], run["y_m"]))
    seen = np.zeros(len(points_m), dtype=bool)
    for first in range(0, len(path), 256):
        part = path[first : first + 256]
        apart = np.hypot(*np.moveaxis(points_m[:, None] - part[None], 2, 0))
        seen |= (apart <= near_m).any(axis=1)
    return seen


def _lane_places_m(truth: Trial) -> np.ndarray:
    """Returns places (n, 2) every quarter of a metre along the middle of all lanes between neighbouring rows."""
    places = []
    rows = [Polyline(row) for row in truth.field.rows]
    for one in rows:
        for along_m in np.arange(0.0, one.length_m, _COVER_M):
            here = one.at(along_m)
            across = np.array([-math.sin(here.yaw_rad), math.cos(here.yaw_rad)])
            feet = (
                other.at(other.project(*here[:2]).along_m) for other in rows if other is not one
            )
            steps = [np.array(foot[:2]) - here[:2] for foot in feet]
            apart = [np.hypot(*step) for step in steps if step @ across > 0.9 * np.hypot(*step)]
            if apart and 0.0 < min(apart) < _WIDEST_LANE_M:
                places.append(here[:2] + across * min(apart) / 2.0)
    return np.array(places).reshape(-1, 2)


def _row_coverage(run: Recorded, truth: Trial) -> float:
    places = _lane_places_m(truth)
    return float(_near_path(places, run, _COVER_M).mean()) if len(places) else math.nan


def _headland_coverage(run: Recorded, truth: Trial) -> float:
    """Returns the share of the headlands, 2 m deep at both ends of the rows, that the robot's middle came near."""
    ends = np.concatenate([row[[0, -1]] for row in truth.field.rows])
    yaw = run.lane.centre.at(0.0).yaw_rad
    ahead, left = np.array([math.cos(yaw), math.sin(yaw)]), np.array(
        [-math.sin(yaw), math.cos(yaw)]
    )
    u, v = ends @ ahead, ends @ left
    across = np.arange(v.min(), v.max() + _CELL_M, _CELL_M)
    deep = np.arange(_CELL_M / 2, _HEADLAND_M, _CELL_M)
    along = np.concatenate((u.min() - deep, u.max() + deep))
    grid = np.array(np.meshgrid(along, across)).reshape(2, -1).T
    places = grid[:, :1] * ahead + grid[:, 1:] * left
    return float(_near_path(places, run, _COVER_M).mean())


def _fre_score_m(run: Recorded, _truth: Trial) -> float:
    """Returns the metres in rows less a penalty for each touched plant, in the form of the Field Robot Event's score.

    No rule of the event is the source of this number: a penalty of 1 m is assumed unless the campaign's file has
    another `damage_penalty_m` of `task`. Each touched stalk counts once, whether it would have fallen or not.
    """
    damaged = len(run.contacts.touched)
    return float(run.way_m().sum()) - run.task.damage_penalty_m * damaged


def _energy_j(run: Recorded, _truth: Trial) -> float:
    return float(run["energy_j"][-1])


# Name to function and its meaning
MEASURES: Dict[str, Any] = {
    "way_m": (
        lambda run, truth: run.way_m().sum(),
        "way along the lane, between the rows' ends; again where the robot backed up",
    ),
    "distance_m": (lambda run, truth: _driven_m(run), "length of the robot's path"),
    "lateral_rms_m": (
        lambda run, truth: run.rms(run["lateral_m"]),
        "offset from the lane's centre line, root mean square over the way",
    ),
    "lateral_max_m": (lambda run, truth: run.largest(run["lateral_m"]), "largest offset"),
    "share_near": (
        lambda run, truth: run.mean((np.abs(run["lateral_m"]) <= NEAR_M).astype(float)),
        "share of the way within 0.1 m of the centre line",
    ),
    "heading_rms_rad": (
        lambda run, truth: run.rms(run["heading_rad"]),
        "heading from the centre line's direction, root mean square over the way",
    ),
    "heading_max_rad": (lambda run, truth: run.largest(run["heading_rad"]), "largest heading"),
    "row_width_m": (
        lambda run, truth: run.mean(run.perceived_width_m()),
        "width of the lane as the controller perceives it, mean over the way",
    ),
    "row_width_sd_m": (_width_sd_m, "standard deviation of that width"),
    "row_width_error_m": (
        lambda run, truth: run.mean(run.perceived_width_m()) - run.width_m,
        "perceived width less the true one",
    ),
    "left_error_m": (
        lambda run, truth: run.mean(run["left_seen_m"] - run["left_true_m"]),
        "perceived distance to the left row less the true one, mean over the way",
    ),
    "right_error_m": (
        lambda run, truth: run.mean(run["right_seen_m"] - run["right_true_m"]),
        "the same of the right row",
    ),
    "interventions": (_interventions, "times that a person stepped in"),
    "metres_per_intervention": (
        lambda run, truth: run.way_m().sum() / max(_interventions(run, truth), 1.0),
        "way per intervention; the whole way, a lower bound, where there was none",
    ),
    "collisions": (
        lambda run, truth: run.contacts.collisions,
        "times that a stalk came into contact with the robot's outline",
    ),
    "plants_touched": (lambda run, truth: len(run.contacts.touched), "different stalks touched"),
    "plants_knocked": (
        lambda run, truth: len(run.contacts.knocked),
        "stalks entered by 2 cm, which would have been pushed over",
    ),
    "completed": (lambda run, truth: run.end == END_OF_ROW, "1 if it ended at the row's end"),
    "time_s": (_time_s, "simulated time of driving"),
    "energy_j": (_energy_j, "energy taken from the battery model; NaN without use `battery`"),
    "row_coverage": (_row_coverage, "share of all lanes' middles driven over"),
    "headland_coverage": (
        _headland_coverage,
        "share of the headlands, 2 m behind the rows' ends, driven over",
    ),
    "fre_score_m": (
        _fre_score_m,
        "way less `damage_penalty_m` (1 m is assumed) a touched plant, in the form of the Field Robot Event's score",
    ),
}


def check(names: Sequence[str], factors: Sequence[str]) -> None:
    """Raises GeneratorError unless all measures are there, each with a column of its own."""
    taken = {*tables.RUN_COLUMNS, *(f"factor_{name}" for name in factors)}
    for name in names:
        find(name)
        if column(name) in taken:
            found = f"measures: found {name!r}, whose column {column(name)} is there already"
            raise GeneratorError(f"{found}, expected another name")
        taken.add(column(name))


def find(name: str) -> Callable[[Recorded, Trial], Any]:
    """Returns a measure by its name or as module:function."""
    if ":" in name:
        return load_function(name, "measures")
    if name not in MEASURES:
        raise GeneratorError(f"measures: found {name!r}, {known_names(name, MEASURES)}")
    return MEASURES[name][0]


def measured(name: str, run: Recorded, truth: Trial) -> float:
    """Returns what a measure says of a run. Raises GeneratorError if that is no number."""
    value = find(name)(run, truth)
    try:
        return float(value)
    except (TypeError, ValueError):
        found = f"found {type(value).__name__}"
        raise GeneratorError(f"measure {name}: {found}, expected a number") from None


def column(name: str) -> str:
    """Returns the column of a measure in runs.parquet: its name, or its function's."""
    return name.rpartition(":")[2]
