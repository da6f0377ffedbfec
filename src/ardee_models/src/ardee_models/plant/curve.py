# SPDX-License-Identifier: MIT
"""Curves in a vertical plane: stalks, branches, peduncles."""

from dataclasses import dataclass

import numpy as np

_STEPS = 64  # integration steps of a whole curve


@dataclass(frozen=True)
class Curve:
    """A curve from `origin` for `length_m` along `azimuth`; its angle from the vertical goes from `start` to `end`.

    The angle is end + (start - end) exp(-s / bend_m), or linear in s where bend_m is 0.
    """

    origin: np.ndarray
    azimuth_rad: float
    start_rad: float
    end_rad: float
    length_m: float
    bend_m: float = 0.0

    def side(self) -> np.ndarray:
        """Unit vector normal to the curve's plane."""
        return np.array([-np.sin(self.azimuth_rad), np.cos(self.azimuth_rad), 0.0])

    def angle(self, s_m: np.ndarray) -> np.ndarray:
        """Angle from the vertical at arc length s."""
        if self.bend_m > 0.0:
            return self.end_rad + (self.start_rad - self.end_rad) * np.exp(-s_m / self.bend_m)
        return self.start_rad + (self.end_rad - self.start_rad) * s_m / self.length_m

    def direction(self, s_m: np.ndarray) -> np.ndarray:
        """Unit tangents at arc lengths s."""
        angle = self.angle(np.asarray(s_m, dtype=float))
        plan = np.sin(angle)
        return np.stack(
            (plan * np.cos(self.azimuth_rad), plan * np.sin(self.azimuth_rad), np.cos(angle)), -1
        )

    def points(self, s_m: np.ndarray) -> np.ndarray:
        """Points at arc lengths s, by the midpoint rule."""
        fine = np.linspace(0.0, self.length_m, _STEPS + 1)
        steps = self.direction((fine[1:] + fine[:-1]) / 2) * (self.length_m / _STEPS)
        path = np.concatenate((np.zeros((1, 3)), np.cumsum(steps, axis=0))) + self.origin
        return np.stack([np.interp(s_m, fine, path[:, k]) for k in range(3)], axis=-1)
