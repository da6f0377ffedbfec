# SPDX-License-Identifier: MIT
"""Fit of a lane between two crop rows to a vegetation index.

For each place where the rows may meet, the index is averaged along lines from there: a profile across the lane, in
lane widths. It is low in the lane and high beside it, for plants hide the ground behind them, never the lane before
them. The place whose profile shows that best is taken. On its profile the lane's middle is where two ramps meet, each
with a height of its own, because the crop row that is nearer looks denser.
"""
from typing import Tuple

import numpy as np

from ardee_navigation.vision.camera import Camera
from ardee_navigation.vision.rows import RowModel

_HORIZONS_RAD = np.arange(-0.12, 0.121, 0.024)  # of the ground ahead, to the level: rough ground
_LARGEST_HEADING, _HEADINGS = 0.6, 41  # tangent
_LEAST_WIDTH = 0.05  # of the picture: picture rows in which the lane is narrower are left out
_BINS, _REACH, _CENTRE = 20, 2.0, 0.5  # of a profile: to a lane's width, lanes' widths
_GREEN_INSIDE, _GREEN_BESIDE = -2.4, 1.1  # log likelihood: 3 % green inside, half beside
_INSIDE, _BESIDE = 0.3, (0.4, 0.7)  # from the middle
_RAMP, _RAMP_END = (0.2, 0.6), 1.4
_NEAR = 0.15  # of both estimates of the middle


class LaneFitter:
    """Finds the lane before a camera in the vegetation indices of its pictures."""

    def __init__(self, camera: Camera, lane_width_m: float) -> None:
        self._spacing = camera.spacing(lane_width_m)
        self._horizons_px = camera.horizon_px + camera.focal_px * _HORIZONS_RAD
        tangents = np.linspace(-_LARGEST_HEADING, _LARGEST_HEADING, _HEADINGS)
        self._headings_px = camera.focal_px * tangents
        self._across = (np.arange(round(2 * _REACH * _BINS)) + 0.5) / _BINS - _REACH
        self._pixels = self._pixels_of(camera)
        outside = camera.width_px * camera.height_px
        self._counts = (self._pixels < outside).sum(axis=2).astype(np.float32)
        self._make_templates()

    def _pixels_of(self, camera: Camera) -> np.ndarray:
        """Returns the pixels to be averaged, int32[horizon, heading, v, across]; one past the last is none."""
        width_px, height_px = camera.width_px, camera.height_px
        v = np.arange(height_px)[:, None]
        lane_px = self._spacing * (v + 0.5 - self._horizons_px[:, None, None, None])
        u = width_px / 2.0 + self._headings_px[:, None, None] + lane_px * self._across
        u = np.floor(u).astype(np.int32)
        good = (u >= 0) & (u < width_px) & (lane_px >= _LEAST_WIDTH * width_px)
        pixels = np.where(good, v * width_px + u, width_px * height_px)
        return pixels[:, :, good.any(axis=(0, 1, 3))].astype(np.int32)

    def _make_templates(self) -> None:
        """Makes what profiles are compared with, [middle, across]."""
        self._middles = np.arange(-_CENTRE * _BINS, _CENTRE * _BINS + 1) / _BINS
        away = self._across - self._middles[:, None]
        distance = np.abs(away)
        self._inside = (distance < _INSIDE).astype(np.float32)
        self._beside = ((distance >= _BESIDE[0]) & (distance < _BESIDE[1])).astype(np.float32)
        self._near = (distance < _RAMP_END).astype(np.float32)
        bins = np.arange(len(self._across))
        mirrored = np.round(2.0 * _BINS * self._middles[:, None]).astype(int) + bins[::-1]
        self._mirrored = np.where((mirrored < 0) | (mirrored >= len(bins)), len(bins), mirrored)
        ramp = np.clip((distance - _RAMP[0]) / (_RAMP[1] - _RAMP[0]), 0.0, 1.0)
        self._ramps = [(ramp * side).astype(np.float32) for side in (away < 0.0, away > 0.0)]

    def fit(self, index: np.ndarray) -> Tuple[RowModel, float]:
        """Returns the lane's rows in an index of 0 (bare) to 1 (green), and the contrast of lane and rows, 0 to 1."""
        padded = np.append(index.ravel(), np.float32(0.0))
        sums = padded[self._pixels].sum(axis=2)
        inside, beside = (
            (sums @ part.T) / np.maximum(self._counts @ part.T, 1.0)
            for part in (self._inside, self._beside)
        )
        scores = _GREEN_INSIDE * inside + _GREEN_BESIDE * beside
        horizon, heading, middle = np.unravel_index(np.argmax(scores), scores.shape)
        step = _vertex(scores[horizon, :, middle], heading)
        tangent_px = self._headings_px[1] - self._headings_px[0]
        rows = RowModel(
            float(self._horizons_px[horizon]),
            self._spacing,
            self._middle(sums[horizon, heading], self._counts[horizon, heading], middle) - 0.5,
            float(self._headings_px[heading] + step * tangent_px),
        )
        low, high = inside[horizon, heading, middle], beside[horizon, heading, middle]
        return rows, float(np.clip((high - low) / max(high + low, 0.1), 0.0, 1.0))

    def _middle(self, sums: np.ndarray, counts: np.ndarray, about: int) -> float:
        """Returns the lane's middle on a profile, by least squares of two ramps, near another estimate of it."""
        profile = sums / np.maximum(counts, 1.0)
        padded = np.append(counts, 0.0)
        weights = self._near * np.minimum(counts, padded[self._mirrored])
        left = weights @ profile**2
        for ramp in self._ramps:
            part = weights * ramp
            left = left - (part @ profile) ** 2 / np.maximum((part * ramp).sum(axis=1), 1e-6)
        left = -left / np.maximum(weights.sum(axis=1), 1.0)
        first = max(about - round(_NEAR * _BINS), 0)
        best = first + int(np.argmax(left[first : about + round(_NEAR * _BINS) + 1]))
        return float(self._middles[best] + _vertex(left, best) / _BINS)


def _vertex(values: np.ndarray, top: int) -> float:
    """Returns how far from a largest value the top of the parabola through its neighbours lies, -0.5 to 0.5."""
    if not 0 < top < len(values) - 1:
        return 0.0
    before, at, after = (float(value) for value in values[top - 1 : top + 2])
    bend = before - 2.0 * at + after
    is_top = at >= max(before, after) and bend < 0.0
    return 0.5 * (before - after) / bend if is_top else 0.0
