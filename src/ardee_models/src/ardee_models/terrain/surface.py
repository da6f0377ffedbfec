# SPDX-License-Identifier: MIT
"""The ground of a mesh: the highest of its triangles above each place."""

from dataclasses import dataclass
from typing import Tuple

import numpy as np
from scipy.spatial import cKDTree

_CELLS_A_TRIANGLE = 1.0
_MOST_CELLS = 4_000_000
_TOLERANCE = 1e-9


@dataclass(frozen=True)
class MeshGround:
    """Vertices (n, 3) [m] and triangles (m, 3), z upwards, in the terrain's frame."""

    vertices_m: np.ndarray
    triangles: np.ndarray

    def _cells(self) -> tuple:
        """Lower corner, side and number of square cells that hold about one triangle each."""
        low, high = self.bounds_m()
        wanted = np.clip(len(self.triangles) * _CELLS_A_TRIANGLE, 1, _MOST_CELLS)
        side = max(float(np.sqrt(np.prod(np.maximum(high - low, 1e-6)) / wanted)), 1e-6)
        return low, side, np.floor((high - low) / side).astype(int) + 1

    def _entries(self, low: np.ndarray, side: float, shape: np.ndarray) -> tuple:
        """Pairs (cell, triangle) for each cell that the bounds of a triangle touch, by cell."""
        corners = self.vertices_m[self.triangles][:, :, :2]
        first = np.floor((corners.min(axis=1) - low) / side).astype(int).clip(0, shape - 1)
        last = np.floor((corners.max(axis=1) - low) / side).astype(int).clip(0, shape - 1)
        span = last - first + 1
        counts = span.prod(axis=1)
        triangle = np.repeat(np.arange(len(span)), counts)
        within = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
        column = first[triangle, 0] + within % span[triangle, 0]
        row = first[triangle, 1] + within // span[triangle, 0]
        cell = row * shape[0] + column
        order = np.argsort(cell, kind="stable")
        return cell[order], triangle[order]

    def _heights_on(self, triangle: np.ndarray, xy: np.ndarray) -> np.ndarray:
        """Height of the triangle's plane above places, or -inf where they lie outside it."""
        a, b, c = (self.vertices_m[self.triangles[triangle, k]] for k in range(3))
        ab, ac, ap = b[:, :2] - a[:, :2], c[:, :2] - a[:, :2], xy - a[:, :2]
        area = ab[:, 0] * ac[:, 1] - ab[:, 1] * ac[:, 0]
        flat = np.abs(area) < 1e-18
        area = np.where(flat, 1.0, area)
        v = (ap[:, 0] * ac[:, 1] - ap[:, 1] * ac[:, 0]) / area
        w = (ab[:, 0] * ap[:, 1] - ab[:, 1] * ap[:, 0]) / area
        inside = ~flat & (v >= -_TOLERANCE) & (w >= -_TOLERANCE) & (v + w <= 1.0 + _TOLERANCE)
        height = a[:, 2] + v * (b[:, 2] - a[:, 2]) + w * (c[:, 2] - a[:, 2])
        return np.where(inside, height, -np.inf)

    def bounds_m(self) -> Tuple[np.ndarray, np.ndarray]:
        """Corners of the rectangle around the mesh."""
        return self.vertices_m[:, :2].min(axis=0), self.vertices_m[:, :2].max(axis=0)

    def height_at(self, x_m: np.ndarray, y_m: np.ndarray) -> np.ndarray:
        """Height of the highest triangle; beside the mesh, the height of its nearest vertex."""
        xy = np.column_stack((np.ravel(x_m), np.ravel(y_m))).astype(float)
        low, side, shape = self._cells()
        cells, triangles = self._entries(low, side, shape)
        place = np.floor((xy - low) / side).astype(int)
        known = ((place >= 0) & (place < shape)).all(axis=1)
        cell = np.where(known, place[:, 1] * shape[0] + place[:, 0], -1)
        begin, end = np.searchsorted(cells, cell, "left"), np.searchsorted(cells, cell, "right")
        height = np.full(len(xy), -np.inf)
        for k in range(int((end - begin).max(initial=0))):
            more = np.flatnonzero(begin + k < end)
            found = self._heights_on(triangles[begin[more] + k], xy[more])
            height[more] = np.maximum(height[more], found)
        beside = np.flatnonzero(np.isinf(height))
        if len(beside):
            nearest = cKDTree(self.vertices_m[:, :2]).query(xy[beside])[1]
            height[beside] = self.vertices_m[nearest, 2]
        return height.reshape(np.shape(x_m))
