# SPDX-License-Identifier: MIT
"""The line that rows follow: maps arc length s and offset d to its left to the field's frame."""

from typing import Optional, Tuple

import numpy as np

from ardee_common.errors import GeneratorError
from ardee_world.expression import parse_expression
from ardee_world.field_config import RowShape

_LARGEST_STEP_M = 0.02
_MOST_SAMPLES = 100_000
_STEEPEST = 20.0  # largest slope of y(x) at which rows make sense
_FOLDED = (
    "rows {d:.2f} m to the {side} of the line, where its radius of curvature is {radius:.2f} m"
)


def direction(angle_deg: float) -> np.ndarray:
    """Unit vector of an angle, exact at quarter turns."""
    angle = np.radians(angle_deg)
    vector = np.array([np.cos(angle), np.sin(angle)])
    return np.where(np.abs(vector) < 1e-15, 0.0, vector)


def left_of(tangent: np.ndarray) -> np.ndarray:
    """Unit vectors a quarter turn to the left."""
    return np.stack((-tangent[..., 1], tangent[..., 0]), axis=-1)


class Line:
    """The middle line, continued straight beyond its ends."""

    def __init__(self, shape: RowShape, length_m: float) -> None:
        self.shape, self.length_m = shape, length_m
        self.forward = direction(shape.row_direction_deg)
        self.straight = shape.row_shape == "straight" and shape.island_radius_m == 0.0
        self._samples = (
            None
        )  # type: Optional[Tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]]
        if shape.row_shape in ("sine", "expression"):
            self._samples = self._sample()

    def _offsets(self, u: np.ndarray) -> np.ndarray:
        if self.shape.row_shape == "expression":
            bent = parse_expression(self.shape.row_expression)
            return bent(u) - bent(np.zeros(1))  # the line begins in the lane of the start pose
        turns = 2.0 * np.pi * u / self.shape.sine_wavelength_m
        return self.shape.sine_amplitude_m * np.sin(turns)

    def _sample(self) -> tuple:
        """Arc length, position along and across, slope angle and curvature at places along the line."""
        count = int(np.clip(self.length_m / _LARGEST_STEP_M, 200, _MOST_SAMPLES))
        u = np.linspace(0.0, self.length_m, count + 1)
        across = self._offsets(u)
        slope = np.gradient(across, u) if self.length_m > 0.0 else np.zeros_like(u)
        if np.abs(slope).max() > _STEEPEST:
            at = u[np.abs(slope).argmax()]
            raise GeneratorError(
                f"row shape: found a slope of {np.abs(slope).max():.0f} at x = {at:g} m, expected at most {_STEEPEST:g}"
            )
        s = np.concatenate(([0.0], np.cumsum(np.hypot(np.diff(u), np.diff(across)))))
        angle = np.arctan(slope)
        curvature = np.gradient(angle, s) if self.length_m > 0.0 else np.zeros_like(s)
        return s, np.column_stack((u, across)), angle, curvature

    def _middle(self, s: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
        """Position (along, across) and heading, in a frame whose first axis is the first direction of the rows."""
        inside = np.clip(s, 0.0, self.length_m)
        if self._samples is not None:
            at, place, angle, _ = self._samples
            along, across = np.interp(inside, at, place[:, 0]), np.interp(inside, at, place[:, 1])
            heading = np.interp(inside, at, angle)
        elif self.shape.row_shape == "curved":
            radius = self.shape.curve_radius_m
            heading = inside / radius
            along, across = radius * np.sin(heading), radius * (1.0 - np.cos(heading))
        else:
            along, across, heading = inside, np.zeros_like(inside), np.zeros_like(inside)
        beyond = s - inside
        along, across = along + beyond * np.cos(heading), across + beyond * np.sin(heading)
        return np.column_stack((along, across)), heading

    def bent_aside(self, s: np.ndarray, d: np.ndarray) -> np.ndarray:
        """Offsets of rows that bend around the island, which stays free; lanes keep 3/4 of their width."""
        radius = self.shape.island_radius_m
        if radius == 0.0:
            return d
        beside = d - self.shape.island_offset_m
        reach = np.clip(np.abs(s - self.shape.island_distance_m) / (4.0 * radius), 0.0, 1.0)
        push = radius * np.exp(-np.abs(beside) / (4.0 * radius)) * np.cos(0.5 * np.pi * reach) ** 2
        return d + np.where(beside >= 0.0, push, -push)

    def points(self, s: np.ndarray, d: np.ndarray) -> np.ndarray:
        """Points (n, 2) in the field's frame."""
        middle, heading = self._middle(s)
        d = self.bent_aside(s, d)
        local = middle + d[:, None] * np.column_stack((-np.sin(heading), np.cos(heading)))
        return local[:, :1] * self.forward + local[:, 1:] * left_of(self.forward)

    def tangents(self, s: np.ndarray) -> np.ndarray:
        """Unit vectors along the line."""
        _, heading = self._middle(s)
        c, w = np.cos(heading)[:, None], np.sin(heading)[:, None]
        return c * self.forward + w * left_of(self.forward)

    def check_offsets(self, low_m: float, high_m: float) -> None:
        """Raises GeneratorError if rows beside the line would fold or close on themselves."""
        if self.shape.row_shape == "curved":
            radius = self.shape.curve_radius_m
            if self.length_m >= 2.0 * np.pi * abs(radius):
                raise GeneratorError(
                    f"curve radius: found {radius} m for {self.length_m:g} m of rows, which is more than a circle"
                )
            curvature = np.array([1.0 / radius])
        elif self._samples is not None:
            curvature = self._samples[3]
        else:
            return
        for d, worst in ((high_m, curvature.max()), (low_m, curvature.min())):
            if d * worst >= 0.99:
                side = "left" if d > 0.0 else "right"
                found = _FOLDED.format(d=abs(d), side=side, radius=abs(1.0 / worst))
                raise GeneratorError(f"row shape: found {found}, expected a larger radius")
