# SPDX-License-Identifier: MIT
"""Judges a run while it goes: where in the lane, when a person steps in, when it is over."""
import math
from collections import deque
from typing import Deque, Optional, Tuple

from ardee_campaigns.campaign_file import TaskKeys
from ardee_world.row_truth import Deviation, Lane, Pose

_SPARE_S = 30.0  # to come to the row
GIVEN_UP, OUT_OF_TIME = "given up", "out of time"
OFF_THE_LANE = "off the lane"
END_OF_ROW, WENT_ON, FINISHED = "end of the row", "went on after the row", "controller finished"


def set_down(keys: TaskKeys, lane: Lane, why: str, along_m: float) -> Pose:
    """Returns where a person who steps in sets the robot down."""
    ahead_m = 0.0 if why == OFF_THE_LANE else keys.set_ahead_m
    return lane.centre.at(along_m + ahead_m)


class Judge:
    """Decides after each observation; `end` says why the run is over, or is empty."""

    def __init__(self, keys: TaskKeys, lane: Lane, limit_s: float) -> None:
        self._keys, self._lane, self._limit_s = keys, lane, limit_s
        if keys.slowest_m_s:
            way_m = lane.centre.length_m + keys.overrun_m
            self._limit_s = min(limit_s, _SPARE_S + way_m / keys.slowest_m_s)
        self._track: Deque[Tuple[float, Pose]] = deque()
        self._interventions = 0
        self.end = ""

    def look(
        self, time_s: float, pose: Pose, here: Deviation, is_finished: bool
    ) -> Tuple[str, Optional[Pose]]:
        """Returns why a person steps in, or nothing, and where the robot is set down; time from the start [s].

        Near the row's end a robot that stands has ended, whether or not its controller says so.
        """
        if self._keys.kind == "free":
            self.end = FINISHED if is_finished else OUT_OF_TIME if time_s > self._limit_s else ""
            return "", None
        stands = self._stands(time_s, pose)
        why = self._why_step_in(here, stands, is_finished)
        self._note_end(time_s, here, is_finished or (stands and here.along_m > 0.0), why)
        if not why or self.end:
            return "", None
        self._interventions += 1
        self._track.clear()
        return why, set_down(self._keys, self._lane, why, here.along_m)

    def _why_step_in(self, here: Deviation, stands: bool, is_finished: bool) -> str:
        if here.along_m > self._lane.centre.length_m - self._keys.row_end_m:
            return ""
        if abs(here.lateral_m) > self._keys.largest_offset_m:
            return OFF_THE_LANE
        if stands:
            return "stuck"
        return "stopped in the row" if is_finished else ""

    def _stands(self, time_s: float, pose: Pose) -> bool:
        """Returns whether the robot has not moved for a while."""
        self._track.append((time_s, pose))
        # the oldest is the last that is old enough, at whatever period samples come
        while (
            len(self._track) > 1 and time_s - self._track[1][0] >= self._keys.stuck_after_s - 1e-6
        ):
            self._track.popleft()
        since_s, then = self._track[0]
        moved = math.hypot(pose.x_m - then.x_m, pose.y_m - then.y_m)
        has_stood = time_s - since_s >= self._keys.stuck_after_s - 1e-6
        return has_stood and moved < self._keys.stuck_within_m

    def _note_end(self, time_s: float, here: Deviation, has_stopped: bool, why: str) -> None:
        if not why and has_stopped:
            self.end = END_OF_ROW
        elif here.along_m > self._lane.centre.length_m + self._keys.overrun_m:
            self.end = WENT_ON
        elif time_s > self._limit_s:
            self.end = OUT_OF_TIME
        elif self._interventions >= self._keys.most_interventions:
            self.end = GIVEN_UP
