# SPDX-License-Identifier: MIT
"""Everything that one run leaves behind: samples, raw lidar returns beside the robot, interventions; as plain data."""
import dataclasses
from dataclasses import dataclass, field
from pathlib import Path
from typing import List, Tuple

import numpy as np


@dataclass(frozen=True)
class Sample:
    """After one scan. Poses in the world; lateral and heading from the lane's centre line, positive to the left."""

    time_s: float
    x_m: float
    y_m: float
    yaw_rad: float
    along_m: float
    lateral_m: float
    heading_rad: float
    left_true_m: float  # from the lidar to the ideal line of the row
    right_true_m: float
    left_seen_m: float  # perceived: to the line in use
    right_seen_m: float
    left_valid: int
    right_valid: int
    speed_m_s: float
    turn_rad_s: float
    state: str
    touching: int  # stalks in contact with the robot's outline


COLUMNS = tuple(f.name for f in dataclasses.fields(Sample))


@dataclass(frozen=True)
class Intervention:
    """An event in which a person had to step in."""

    time_s: float
    along_m: float
    why: str


@dataclass
class Record:
    """Complete record of a run."""

    scenario: str
    number: int
    seed: int
    length_m: float  # of the lane, first to last place of its rows
    width_m: float  # of the lane, ideal
    lidar_ahead_m: float = 0.0  # of the robot's middle
    samples: List[Sample] = field(default_factory=list)
    interventions: List[Intervention] = field(default_factory=list)
    raw: List[np.ndarray] = field(
        default_factory=list
    )  # (n, 2): along m, lateral distance from the lidar m
    collisions: int = 0
    touched: int = 0  # different stalks
    knocked: int = 0  # stalks pushed over, had they not been rigid
    end: str = ""
    wall_s: float = 0.0
    latency_ms: Tuple[float, ...] = ()  # with hardware in the loop
    unanswered: int = 0  # scans to which it sent no command

    @property
    def title(self) -> str:
        """Returns the name of the run."""
        return f"{self.scenario}, run {self.number}, seed {self.seed}"

    def column(self, name: str) -> np.ndarray:
        """Returns one value of all samples."""
        return np.array([getattr(sample, name) for sample in self.samples])


def _text(value: object) -> str:
    return f"{value:.6f}" if isinstance(value, float) else str(value)


def write_csv(record: Record, path: Path) -> None:
    """Writes one line per sample."""
    with path.open("w") as file:
        file.write(",".join(COLUMNS) + "\n")
        for sample in record.samples:
            file.write(",".join(_text(getattr(sample, name)) for name in COLUMNS) + "\n")
