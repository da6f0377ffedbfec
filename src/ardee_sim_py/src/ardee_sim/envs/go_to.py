# SPDX-License-Identifier: MIT
"""Task: go to a place under the canopy by satellite position and IMU."""

import math
from typing import Any, Dict, Optional, Tuple

import numpy as np
from ardee_sim.envs.fields import SownField
from ardee_sim.envs.observations import as_array
from ardee_sim.envs.task import Scene, near_lane
from ardee_sim.readings import FixReading, GpsQualityReading, ImuReading
from gymnasium import spaces

from ardee_common.geodesy import to_metres
from ardee_world.row_truth import Pose, lane_of

BEFORE_M = 0.5  # of the lane's first stalks: where the robot starts
START_SD = (0.03, 0.05)  # m aside, rad turned, as in RowFollow
WITHIN_M = 0.3  # of the goal: it is reached
LOST_M = 2.0  # farther from the goal than at the start
REACH_M = 20.0  # offsets are cut off here


class GoToTask:
    """Goes to a place of the lane before which the robot starts."""

    def __init__(
        self,
        fix_topic: str = "ardee/gps",
        error_topic: Optional[str] = "ardee/gps/data",
        imu_topic: str = "ardee/imu/custom",
    ) -> None:
        self._fix, self._error, self._imu = fix_topic, error_topic, imu_topic
        self.topics = tuple(topic for topic in (fix_topic, error_topic, imu_topic) if topic)

    def start(self, sown: SownField, rng: np.random.Generator) -> Pose:
        """Returns a pose before the world's start lane; chooses the goal, in its middle."""
        x, y, _ = sown.world.start["xyz_m"]
        lane = lane_of(sown.trial.field, Pose(x, y, sown.world.start["rpy_rad"][2]))
        self._goal = lane.centre.at(float(rng.uniform(0.3, 0.9)) * lane.centre.length_m)
        return near_lane(lane, -BEFORE_M, rng, START_SD)

    def begin(self, scene: Scene) -> None:
        """Remembers the first fix and where it places the robot."""
        scene.check_kinds(fix_topic=(self._fix, FixReading), imu_topic=(self._imu, ImuReading))
        fix = scene.reading(self._fix)
        self._origin_deg = fix.latitude_deg, fix.longitude_deg
        self._origin_m = scene.state().xyz_m[:2]
        if self._error:
            scene.check_kinds(error_topic=(self._error, GpsQualityReading))
            self._origin_m = self._origin_m + scene.reading(self._error).error_m[:2]
        self._left_m = self._limit_m = self._distance_m(scene)
        self._limit_m += LOST_M

    def _distance_m(self, scene: Scene) -> float:
        here = scene.pose()
        return math.hypot(self._goal.x_m - here.x_m, self._goal.y_m - here.y_m)

    def space(self, scene: Scene) -> spaces.Space:
        """Returns the space of the goal's direction and the IMU's reading."""
        return spaces.Box(-1.0, 1.0, (7,), np.float32)

    def observe(self, scene: Scene) -> Any:
        """Returns the goal ahead and to the left / REACH_M, by fix and IMU, and the IMU's part."""
        fix, imu = scene.reading(self._fix), as_array(scene.reading(self._imu))
        here = self._origin_m + to_metres(fix.latitude_deg, fix.longitude_deg, self._origin_deg)
        dx, dy = self._goal.x_m - here[0], self._goal.y_m - here[1]
        s, c = imu[:2]
        offset = np.clip(np.array([c * dx + s * dy, c * dy - s * dx]) / REACH_M, -1.0, 1.0)
        return np.concatenate([offset, imu]).astype(np.float32)

    def reward(self, scene: Scene) -> Dict[str, float]:
        """Returns by how much the robot came nearer to the goal [m]."""
        before_m, self._left_m = self._left_m, self._distance_m(scene)
        return {"progress": before_m - self._left_m}

    def end(self, scene: Scene) -> Tuple[str, float]:
        """Ends at the goal, at a touched plant, and farther away than at the start."""
        if self._left_m < WITHIN_M:
            return "arrived", 1.0
        if scene.touches_plant():
            return "collision", -1.0
        return ("lost", -1.0) if self._left_m > self._limit_m else ("", 0.0)
