# SPDX-License-Identifier: MIT
"""Judges a run while it goes: deviation from the lane, contacts, when a person has to step in, when it is over."""
import math
from collections import deque
from dataclasses import dataclass
from typing import Deque, Optional, Tuple

import numpy as np

from ardee_navigation.evaluation.contacts import Contacts
from ardee_navigation.evaluation.record import Intervention, Record, Sample
from ardee_navigation.evaluation.scan import Scan
from ardee_navigation.lbirnt.preprocess import to_cartesian
from ardee_world.row_truth import Deviation, Lane, Pose, lane_of
from ardee_world.trial import Trial

LARGEST_OFFSET_M = 0.38  # half a 30 in lane: the robot is in the row (criterion of the UIUC group)
STUCK_AFTER_S, STUCK_WITHIN_M = 2.0, 0.05  # commanded motion without motion
ROW_END_M = 0.5  # a stop nearer than this to the row's end is its end
SET_AHEAD_M = 0.5  # where a robot that stood still is set down again
OVERRUN_M = 5.0
MOST_INTERVENTIONS = 100
SLOWEST_M_S = 0.1  # mean speed below which a run is given up
BESIDE_M = 0.05  # half width of the strip abeam of the lidar whose returns are kept for the figures
RAW_WITHIN_M = 1.0


@dataclass(frozen=True)
class Seen:
    """Answer of the row follower to one scan."""

    left_m: float
    right_m: float
    valid: Tuple[bool, bool]
    state: str


class Judge:
    """Fills a record. `look` once a scan; it answers where the robot is to be set down, if a person steps in."""

    def __init__(
        self, trial: Trial, scenario: str, number: int, seed: int, lidar_ahead_m: float
    ) -> None:
        self.lane: Lane = lane_of(trial.field, trial.start)
        middle = self.lane.centre.at(self.lane.centre.length_m / 2)
        across = self.lane.deviation(middle)
        width_m = across.left_m + across.right_m
        self.record = Record(
            scenario, number, seed, self.lane.centre.length_m, width_m, lidar_ahead_m
        )
        self._contacts = Contacts(trial.field.stalks)
        self._track = deque()  # type: Deque[Tuple[float, Pose]]
        self._began_s = None  # type: Optional[float]

    def look(
        self, time_s: float, pose: Pose, command: Tuple[float, float], seen: Seen
    ) -> Optional[Pose]:
        """Records a sample."""
        if self._began_s is None:
            self._began_s = time_s
        here = self.lane.deviation(pose)
        at_lidar = self.lane.deviation(self._lidar(pose))
        touching = self._contacts.update(pose)
        self.record.samples.append(
            Sample(
                time_s,
                *pose,
                here.along_m,
                here.lateral_m,
                here.heading_rad,
                at_lidar.left_m,
                at_lidar.right_m,
                seen.left_m,
                seen.right_m,
                int(seen.valid[0]),
                int(seen.valid[1]),
                *command,
                seen.state,
                len(touching),
            )
        )
        why = self._why_step_in(time_s, pose, here, seen)
        self._note_end(time_s, here, seen, why)
        if why is None or self.record.end:
            return None
        self.record.interventions.append(Intervention(time_s, here.along_m, why))
        self._track.clear()
        return self.lane.centre.at(here.along_m + (0.0 if why == "off the lane" else SET_AHEAD_M))

    def _lidar(self, pose: Pose) -> Pose:
        x = pose.x_m + self.record.lidar_ahead_m * math.cos(pose.yaw_rad)
        y = pose.y_m + self.record.lidar_ahead_m * math.sin(pose.yaw_rad)
        return Pose(x, y, pose.yaw_rad)

    def keep_scan(self, scan: Scan) -> None:
        """Returns abeam of the lidar, each at its own place along the row, for the figures; call after `look`."""
        points = to_cartesian(scan.ranges_m, scan.angle_min_rad, scan.increment_rad)
        beside = (np.abs(points[:, 0]) < BESIDE_M) & (np.abs(points[:, 1]) < RAW_WITHIN_M)
        ahead, lateral = points[beside].T
        here = self.record.samples[-1]
        ahead = (
            ahead + self.record.lidar_ahead_m
        )  # of the robot; along the lane, which bends little there:
        along = ahead * math.cos(here.heading_rad) - lateral * math.sin(here.heading_rad)
        self.record.raw.append(np.column_stack((here.along_m + along, lateral)))

    def _why_step_in(
        self,
        time_s: float,
        pose: Pose,
        here: Deviation,
        seen: Seen,
    ) -> Optional[str]:
        if here.along_m > self.lane.centre.length_m - ROW_END_M:
            return None
        if abs(here.lateral_m) > LARGEST_OFFSET_M:
            return "off the lane"
        if self._stands(time_s, pose):
            return "stuck"
        return "stopped in the row" if seen.state == "finished" else None

    def _stands(self, time_s: float, pose: Pose) -> bool:
        """Returns whether the robot stands despite a motion command, or waits for a row that it ought to see."""
        self._track.append((time_s, pose))
        while time_s - self._track[0][0] > STUCK_AFTER_S + 1e-9:
            self._track.popleft()
        since_s, then = self._track[0]
        moved = math.hypot(pose.x_m - then.x_m, pose.y_m - then.y_m)
        return time_s - since_s >= STUCK_AFTER_S - 1e-6 and moved < STUCK_WITHIN_M

    def _note_end(self, time_s: float, here: Deviation, seen: Seen, why: Optional[str]) -> None:
        length_m = self.lane.centre.length_m
        limit_s = 30.0 + (length_m + OVERRUN_M) / SLOWEST_M_S
        if why is None and seen.state == "finished":
            self.record.end = "end of the row"
        elif here.along_m > length_m + OVERRUN_M:
            self.record.end = "went on after the row"
        elif time_s - self._began_s > limit_s:
            self.record.end = "out of time"
        elif len(self.record.interventions) >= MOST_INTERVENTIONS:
            self.record.end = "given up"

    def finish(self, wall_s: float) -> Record:
        """Returns the complete record."""
        self.record.collisions = self._contacts.collisions
        self.record.touched = len(self._contacts.touched)
        self.record.knocked = len(self._contacts.knocked)
        self.record.wall_s = wall_s
        return self.record
