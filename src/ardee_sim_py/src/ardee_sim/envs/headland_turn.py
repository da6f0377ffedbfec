# SPDX-License-Identifier: MIT
"""Task: turn at the end of a lane into the lane beside it."""

import math
from typing import Any, Dict, Tuple

import numpy as np
from ardee_sim.envs.fields import SownField
from ardee_sim.envs.observations import as_array, space_of
from ardee_sim.envs.task import Scene, has_left, near_lane
from ardee_sim.errors import ArdeeError
from ardee_sim.readings import LidarReading, OdometryReading
from gymnasium import spaces

from ardee_common.errors import GeneratorError
from ardee_world.row_truth import Lane, Pose, lane_of

BEFORE_END_M = 0.3  # of the lane: where the robot starts
INSIDE_M = 0.5  # of the next lane: where it has to come
START_SD = (0.03, 0.05)  # m aside, rad turned, as in RowFollow
FAR_M = 5.0  # from the goal: the robot is lost
REACH_M = 5.0  # odometry is cut off here


class HeadlandTurnTask:
    """Leaves a lane and enters its left or right neighbour."""

    def __init__(self, scan_topic: str = "ardee/hokuyo", odometry_topic: str = "odom") -> None:
        self._scan, self._odometry = self.topics = scan_topic, odometry_topic

    def start(self, sown: SownField, rng: np.random.Generator) -> Pose:
        """Returns a pose before the end of the world's start lane; chooses the side to turn to."""
        x, y, _ = sown.world.start["xyz_m"]
        lane = lane_of(sown.trial.field, Pose(x, y, sown.world.start["rpy_rad"][2]))
        side = 1 if rng.random() < 0.5 else -1
        for self._side in (side, -side):
            try:
                self._next = _lane_beside(sown, lane, self._side)
                break
            except GeneratorError:
                continue
        else:
            raise ArdeeError(f"{sown.trial.world}: found no lane beside the first, expected one")
        return near_lane(lane, lane.centre.length_m - BEFORE_END_M, rng, START_SD)

    def begin(self, scene: Scene) -> None:
        """Remembers where the turn begins."""
        scene.check_kinds(
            scan_topic=(self._scan, LidarReading),
            odometry_topic=(self._odometry, OdometryReading),
        )
        self._first = _plan(scene.reading(self._odometry))
        self._left_m = self._distance_m(scene)

    def _distance_m(self, scene: Scene) -> float:
        goal, here = self._next.centre.at(INSIDE_M), scene.pose()
        return math.hypot(goal.x_m - here.x_m, goal.y_m - here.y_m)

    def space(self, scene: Scene) -> spaces.Space:
        """Returns the space of scan, odometry and side."""
        made: Dict[str, spaces.Space] = {
            "hokuyo": space_of(as_array(scene.reading(self._scan))),
            "odom": spaces.Box(-1.0, 1.0, (4,), np.float32),
            "side": spaces.Box(-1.0, 1.0, (1,), np.float32),
        }
        return spaces.Dict(made)

    def observe(self, scene: Scene) -> Any:
        """Returns scan, way since the start by wheel odometry, and side."""
        here, first = _plan(scene.reading(self._odometry)), self._first
        dx, dy, turn = here.x_m - first.x_m, here.y_m - first.y_m, here.yaw_rad - first.yaw_rad
        c, s = math.cos(first.yaw_rad), math.sin(first.yaw_rad)
        way = np.clip(np.array([c * dx + s * dy, c * dy - s * dx]) / REACH_M, -1.0, 1.0)
        return {
            "hokuyo": as_array(scene.reading(self._scan)),
            "odom": np.array([*way, math.sin(turn), math.cos(turn)], dtype=np.float32),
            "side": np.array([self._side], dtype=np.float32),
        }

    def reward(self, scene: Scene) -> Dict[str, float]:
        """Returns by how much the straight line to the goal became shorter [m]."""
        before_m, self._left_m = self._left_m, self._distance_m(scene)
        return {"progress": before_m - self._left_m}

    def end(self, scene: Scene) -> Tuple[str, float]:
        """Ends in the next lane, at a touched plant, and far away."""
        here = self._next.deviation(scene.pose())
        if here.along_m > INSIDE_M and not has_left(here):
            return "in_lane", 1.0
        if scene.touches_plant():
            return "collision", -1.0
        return ("lost", -1.0) if self._left_m > FAR_M else ("", 0.0)


def _lane_beside(sown: SownField, lane: Lane, side: int) -> Lane:
    """Returns the lane on a side (1: left), in the other direction. Raises GeneratorError if there is none."""
    end = lane.centre.at(lane.centre.length_m)
    width_m = sum(lane.deviation(end)[3:5])
    x = end.x_m - side * width_m * math.sin(end.yaw_rad)
    y = end.y_m + side * width_m * math.cos(end.yaw_rad)
    return lane_of(sown.trial.field, Pose(x, y, end.yaw_rad + math.pi))


def _plan(odometry: OdometryReading) -> Pose:
    x, y, z, w = odometry.quat_xyzw
    yaw = math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
    return Pose(float(odometry.xyz_m[0]), float(odometry.xyz_m[1]), yaw)
