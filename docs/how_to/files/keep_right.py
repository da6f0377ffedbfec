# SPDX-License-Identifier: MIT
"""A controller that steers by the nearest returns of the lidar on both sides."""
import numpy as np


class KeepRight:
    """Keeps right of the middle by an offset [m]."""

    def __init__(self, offset_m: float = 0.0, speed_m_s: float = 0.4) -> None:
        self.offset_m, self.speed_m_s = offset_m, speed_m_s

    def reset(self) -> None:
        """Forgets what was perceived."""
        self.seen = None

    def step(self, observation, time_s):
        """Returns speed and turn rate for the present scan."""
        scan = observation["scan"]
        angles = scan.angle_min_rad + scan.angle_increment_rad * np.arange(len(scan.ranges_m))
        ranges_m = np.where(np.isfinite(scan.ranges_m), scan.ranges_m, 0.0)  # 0 is on neither side
        lateral_m = ranges_m * np.sin(angles)
        ahead_m = ranges_m * np.cos(angles)
        near = (ahead_m > 0.0) & (ahead_m < 1.0)
        left = lateral_m[near & (lateral_m > 0.1)]
        right = -lateral_m[near & (lateral_m < -0.1)]
        if not len(left) or not len(right):
            return self.speed_m_s, 0.0
        self.seen = np.percentile(left, 10), np.percentile(right, 10)
        error_m = (self.seen[0] - self.seen[1]) / 2.0 - self.offset_m
        return self.speed_m_s, float(np.clip(2.0 * error_m, -0.5, 0.5))


def make(params, robot, seed):
    """Returns the controller of a campaign; params: offset_m, speed_m_s."""
    return KeepRight(**params)
