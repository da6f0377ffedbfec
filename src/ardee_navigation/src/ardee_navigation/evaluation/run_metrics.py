# SPDX-License-Identifier: MIT
"""Numbers of a run and of several: errors against the truth, distance per intervention, contacts, pace."""
import math
from dataclasses import dataclass
from typing import Sequence

import numpy as np

from ardee_navigation.evaluation.record import Record

NEAR_M = 0.10  # the share of the way that lies within this of the centre line


@dataclass(frozen=True)
class Summary:
    """Numbers of a run, or of several together. Lengths count the way between the first and the last place of the rows.

    Without any such way, what is measured on it is nan.
    """

    way_m: float
    lateral_rms_m: float
    lateral_max_m: float
    share_near: float
    heading_rms_rad: float
    heading_max_rad: float
    width_m: float  # perceived, mean
    width_sd_m: float
    width_true_m: float
    left_error_m: float  # perceived minus true distance to the row, mean
    right_error_m: float
    interventions: int
    metres_per_intervention: float  # the whole way where there was none, as a lower bound
    collisions: int
    touched: int
    knocked: int
    completed: int  # runs that ended at the end of the row
    time_s: float
    real_time_factor: float


def in_row(record: Record) -> np.ndarray:
    """Returns which samples lie between the rows' first and last places."""
    along = record.column("along_m")
    return (along >= 0.0) & (along <= record.length_m)


def way_steps_m(record: Record) -> np.ndarray:
    """Way along the lane that each sample stands for; nothing where the robot was set back or carried on."""
    along = record.column("along_m")
    step = np.diff(along, prepend=along[:1])
    return np.where((step > 0.0) & (step < 0.2), step, 0.0)


def _mean(values: np.ndarray, weights: np.ndarray) -> float:
    return float(np.average(values, weights=weights)) if len(values) else math.nan


def _rms(values: np.ndarray, weights: np.ndarray) -> float:
    return math.sqrt(_mean(values**2, weights))


def _largest(values: np.ndarray) -> float:
    return float(np.abs(values).max()) if len(values) else math.nan


def summarize(records: Sequence[Record]) -> Summary:
    """Summarizes all samples of the runs together, each weighted by the way it stands for."""
    chosen = [in_row(record) & (way_steps_m(record) > 0.0) for record in records]

    def joined(name: str) -> np.ndarray:
        return np.concatenate([r.column(name)[c] for r, c in zip(records, chosen)])

    way = np.concatenate([way_steps_m(record)[c] for record, c in zip(records, chosen)])
    lateral, heading = joined("lateral_m"), joined("heading_rad")
    left, right = joined("left_seen_m"), joined("right_seen_m")
    width = left + right
    total_m, times = float(way.sum()), [record.column("time_s") for record in records]
    simulated_s = sum(float(time[-1] - time[0]) for time in times)
    interventions = sum(len(record.interventions) for record in records)
    mean_width = _mean(width, way)
    return Summary(
        way_m=total_m,
        lateral_rms_m=_rms(lateral, way),
        lateral_max_m=_largest(lateral),
        share_near=_mean(np.abs(lateral) <= NEAR_M, way),
        heading_rms_rad=_rms(heading, way),
        heading_max_rad=_largest(heading),
        width_m=mean_width,
        width_sd_m=_rms(width - mean_width, way),
        width_true_m=float(np.mean([record.width_m for record in records])),
        left_error_m=_mean(left - joined("left_true_m"), way),
        right_error_m=_mean(right - joined("right_true_m"), way),
        interventions=interventions,
        metres_per_intervention=total_m / max(interventions, 1),
        collisions=sum(record.collisions for record in records),
        touched=sum(record.touched for record in records),
        knocked=sum(record.knocked for record in records),
        completed=sum(record.end == "end of the row" for record in records),
        time_s=simulated_s,
        real_time_factor=simulated_s / max(sum(record.wall_s for record in records), 1e-9),
    )
