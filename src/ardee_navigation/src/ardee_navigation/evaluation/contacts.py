# SPDX-License-Identifier: MIT
"""Stalks that the robot's outline touches.

Plants are static scenery to the simulator: they stop a robot but never fall, and it publishes no contacts. So
contacts are counted by geometry, from the robot's outline on the ground plan and the stalks of the truth file.
"""
from dataclasses import dataclass
from typing import List, Set

import numpy as np

from ardee_world.row_truth import Pose, Stalks

LENGTH_M, WIDTH_M = (
    0.508,
    0.4702,
)  # chassis; outer faces of the wheels: separation 0.4318 and depth 0.03838 (tsv1_config)
TOUCH_M = 0.01  # a rigid stalk is not entered: what is nearer than this is touched
KNOCKED_M = 0.02  # a stalk as deep as this below the outline would have been pushed over
_NEAR_M = 1.0


def depths_m(pose: Pose, stalks: Stalks, near: np.ndarray) -> np.ndarray:
    """Returns how far the stalks of the given numbers reach into the outline, negative where they stay outside."""
    offset = stalks.xy_m[near] - np.array([pose.x_m, pose.y_m])
    c, s = np.cos(pose.yaw_rad), np.sin(pose.yaw_rad)
    ahead = np.abs(c * offset[:, 0] + s * offset[:, 1]) - LENGTH_M / 2
    aside = np.abs(-s * offset[:, 0] + c * offset[:, 1]) - WIDTH_M / 2
    outside = np.hypot(np.maximum(ahead, 0.0), np.maximum(aside, 0.0))
    inside = np.minimum(np.maximum(ahead, aside), 0.0)
    return stalks.radius_m[near] - outside - inside


@dataclass
class Contacts:
    """Counter of contacts over the poses of a run."""

    stalks: Stalks
    collisions: int = 0  # times that contact began

    def __post_init__(self) -> None:
        order = np.argsort(self.stalks.xy_m[:, 0], kind="stable")
        self._order, self._x_m = order, self.stalks.xy_m[order, 0]
        self.touched: Set[int] = set()
        self.knocked: Set[int] = set()
        self._in_contact: Set[int] = set()

    def _near(self, pose: Pose) -> np.ndarray:
        low, high = np.searchsorted(self._x_m, [pose.x_m - _NEAR_M, pose.x_m + _NEAR_M])
        return self._order[low:high]

    def update(self, pose: Pose) -> List[int]:
        """Stalks touched at this pose; a contact that was not there before is a collision."""
        near = self._near(pose)
        depth = depths_m(pose, self.stalks, near)
        now = set(near[depth > -TOUCH_M].tolist())
        self.collisions += len(now - self._in_contact)
        self.touched |= now
        self.knocked |= set(near[depth > KNOCKED_M].tolist())
        self._in_contact = now
        return sorted(now)
