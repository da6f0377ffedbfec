# SPDX-License-Identifier: MIT
"""Records a run: a sample after each observation, as the columns of tables.SAMPLE_FIELDS."""
import math
from typing import Any, Dict, List, Optional, Tuple

import ardee_sim
import numpy as np
import pyarrow as pa

from ardee_campaigns import tables
from ardee_campaigns.outline import Contacts
from ardee_campaigns.robot import Observation, Robot
from ardee_world.row_truth import Deviation, Lane, Pose

BESIDE_M = 0.05  # half width of the strip abeam of the lidar whose returns are kept
RAW_WITHIN_M = 1.0


class Recorder:
    """Columns of the samples so far."""

    def __init__(self, lane: Lane, robot: Robot, contacts: Contacts) -> None:
        self._lane, self._robot, self.contacts = lane, robot, contacts
        names = [name for name, _ in (*tables.SAMPLE_FIELDS, *tables.RAW_FIELDS)]
        self._columns: Dict[str, List[Any]] = {name: [] for name in names}
        self._energy_j: float = math.nan

    def take(
        self,
        time_ns: int,
        pose: Pose,
        here: Deviation,
        command: Tuple[float, float],
        seen: Tuple[float, float],
        observation: Observation,
    ) -> None:
        """Takes a sample."""
        at_sensor = self._lane.deviation(self._sensor(pose))
        battery = observation.get("battery")
        charge_a_h, energy_j = self._battery(time_ns, battery)
        raw_along, raw_lateral = self._raw(observation.get(self._robot.pace), here)
        values = (
            time_ns,
            *pose,
            *command,
            here.along_m,
            here.lateral_m,
            here.heading_rad,
            at_sensor.left_m,
            at_sensor.right_m,
            *seen,
            self.contacts.update(pose),
            charge_a_h,
            energy_j,
            "",
            raw_along,
            raw_lateral,
        )
        for column, value in zip(self._columns.values(), values):
            column.append(value)

    def note_event(self, why: str) -> None:
        """Notes why a person stepped in after the last sample."""
        self._columns["event"][-1] = why

    def last(self, name: str) -> Any:
        """Returns a column's value of the last sample."""
        return self._columns[name][-1]

    def time_s(self) -> float:
        """Returns the simulated time from the first to the last sample, NaN before the first."""
        times = self._columns["time_ns"]
        return (times[-1] - times[0]) * 1e-9 if times else math.nan

    def table(self) -> pa.Table:
        """Returns the samples."""
        return pa.table(self._columns, schema=tables.RUN_FILE_SCHEMA)

    def columns(self) -> Dict[str, np.ndarray]:
        """Returns the samples' columns for measures."""
        names = [name for name, _ in tables.SAMPLE_FIELDS]
        return {name: np.array(self._columns[name]) for name in names}

    def _sensor(self, pose: Pose) -> Pose:
        ahead, left = (float(value) for value in self._robot.sensor_xyz_m[:2])
        c, s = math.cos(pose.yaw_rad), math.sin(pose.yaw_rad)
        return Pose(pose.x_m + ahead * c - left * s, pose.y_m + ahead * s + left * c, pose.yaw_rad)

    def _battery(self, time_ns: int, battery: Optional[ardee_sim.Reading]) -> Tuple[float, float]:
        """Returns charge left and energy taken so far."""
        if not isinstance(battery, ardee_sim.BatteryStateReading):
            return math.nan, math.nan
        times = self._columns["time_ns"]
        dt_s = (time_ns - times[-1]) * 1e-9 if times else 0.0
        before = 0.0 if math.isnan(self._energy_j) else self._energy_j
        self._energy_j = before - battery.voltage_v * battery.current_a * dt_s
        return battery.charge_a_h, self._energy_j

    def _raw(self, reading: Optional[ardee_sim.Reading], here: Deviation) -> Tuple[Any, Any]:
        """Returns the lidar's returns abeam: each one's place along the row, and its distance to the left."""
        if not isinstance(reading, ardee_sim.LidarReading):
            return [], []
        angles = reading.angle_min_rad + reading.angle_increment_rad * np.arange(
            len(reading.ranges_m)
        )
        good = np.isfinite(reading.ranges_m)
        ranges, angles = reading.ranges_m[good], angles[good]
        ahead, lateral = ranges * np.cos(angles), ranges * np.sin(angles)
        beside = (np.abs(ahead) < BESIDE_M) & (np.abs(lateral) < RAW_WITHIN_M)
        ahead = ahead[beside] + self._robot.sensor_xyz_m[0]  # of the robot
        lateral = lateral[beside]
        along = ahead * math.cos(here.heading_rad) - lateral * math.sin(here.heading_rad)
        return (here.along_m + along).astype(np.float32), lateral.astype(np.float32)
