# SPDX-License-Identifier: MIT
"""Field terrain as a square grid of heights: ridges along the crop rows and smooth bumps."""

from dataclasses import dataclass
from typing import Protocol, Tuple

import numpy as np

from ardee_common.errors import GeneratorError
from ardee_models.smooth_noise import smooth_noise

_CLEAR_HALF_X_M = 0.4  # half size of the spot round the origin where a robot is set down
_CLEAR_HALF_Y_M = 0.2


@dataclass(frozen=True)
class TerrainParams:
    """Shape of the ground. Rows run along x; the middle of a lane lies on y = 0."""

    size_m: float = 30.0
    samples: int = 257  # 2^n + 1, as OGRE's terrain requires
    row_spacing_m: float = 0.762  # 30 inches, usual for corn
    ridge_height_m: float = 0.05
    ridge_half_width_m: float = 0.25
    bump_sd_m: float = 0.008
    bump_length_m: float = 0.4
    friction_mu: float = 0.8  # friction coefficient of rubber on firm soil

    def validate(self) -> None:
        """Raises GeneratorError for a value out of range."""
        checks = (
            (1.0 <= self.size_m <= 2000.0, "size", self.size_m, "1 to 2000 m"),
            (
                self.samples in {2**n + 1 for n in range(4, 13)},
                "samples",
                self.samples,
                "2^n + 1, 17 to 4097",
            ),
            (0.1 <= self.row_spacing_m <= 10.0, "row spacing", self.row_spacing_m, "0.1 to 10 m"),
            (0.0 <= self.ridge_height_m <= 1.0, "ridge height", self.ridge_height_m, "0 to 1 m"),
            (
                0.01 <= self.ridge_half_width_m <= 5.0,
                "ridge half width",
                self.ridge_half_width_m,
                "0.01 to 5 m",
            ),
            (0.0 <= self.bump_sd_m <= 0.5, "bump SD", self.bump_sd_m, "0 to 0.5 m"),
            (
                0.05 <= self.bump_length_m <= 100.0,
                "bump length",
                self.bump_length_m,
                "0.05 to 100 m",
            ),
            (0.0 < self.friction_mu <= 100.0, "friction", self.friction_mu, "above 0, at most 100"),
        )
        for good, what, found, expected in checks:
            if not good:
                raise GeneratorError(f"terrain {what}: found {found}, expected {expected}")


class Ground(Protocol):
    """Anything that has a height at each place."""

    def height_at(self, x_m: np.ndarray, y_m: np.ndarray) -> np.ndarray:
        """Height [m] of the ground at places of its frame."""

    def bounds_m(self) -> Tuple[np.ndarray, np.ndarray]:
        """Least and greatest x and y [m] of the ground."""


@dataclass(frozen=True)
class Terrain:
    """Heights [m] on a square grid that spans exactly size_m; row 0 at +y, column 0 at -x, centred on the origin."""

    heights_m: np.ndarray
    size_m: float

    def height_at(self, x_m: np.ndarray, y_m: np.ndarray) -> np.ndarray:
        """Height on the two triangles of each cell, which the diagonal from -x -y to +x +y divides as in the simulator;
        outside the grid, the height of its edge."""
        last = len(self.heights_m) - 1
        column = np.clip((np.asarray(x_m) / self.size_m + 0.5) * last, 0.0, last)
        row = np.clip((0.5 - np.asarray(y_m) / self.size_m) * last, 0.0, last)
        c, r = np.minimum(column.astype(int), last - 1), np.minimum(row.astype(int), last - 1)
        u, v = column - c, 1.0 - (row - r)  # place in the cell, from its corner at -x -y
        h = self.heights_m
        near, far = h[r + 1, c], h[r, c + 1]
        beside = np.where(u >= v, h[r + 1, c + 1], h[r, c])
        first, second = np.maximum(u, v), np.minimum(u, v)
        return near + first * (beside - near) + second * (far - beside)

    def bounds_m(self) -> Tuple[np.ndarray, np.ndarray]:
        """Corners of the grid."""
        half_m = np.full(2, self.size_m / 2.0)
        return -half_m, half_m


def ridge_profile(y_m: np.ndarray, params: TerrainParams) -> np.ndarray:
    """Raised cosine over each crop row at y = spacing (k + 1/2), flat between."""
    distance = np.abs((y_m / params.row_spacing_m) % 1.0 - 0.5) * params.row_spacing_m
    half_width_m = min(params.ridge_half_width_m, 0.5 * params.row_spacing_m)
    inside = np.minimum(distance / half_width_m, 1.0)
    return params.ridge_height_m * np.cos(0.5 * np.pi * inside) ** 2


def generate_terrain(params: TerrainParams, rng: np.random.Generator) -> Terrain:
    """Generates ridges and bumps. Zero is the highest point near the origin, so that a robot there is not buried."""
    params.validate()
    axis = np.linspace(-0.5, 0.5, params.samples) * params.size_m
    spacing_m = params.size_m / (params.samples - 1)
    heights = np.repeat(ridge_profile(-axis, params)[:, None], params.samples, axis=1)
    if params.bump_sd_m > 0.0:
        noise = smooth_noise(heights.shape, params.bump_length_m / spacing_m, rng)
        heights = heights + params.bump_sd_m * noise
    spot = (np.abs(axis[None, :]) <= _CLEAR_HALF_X_M) & (np.abs(axis[:, None]) <= _CLEAR_HALF_Y_M)
    return Terrain(heights - heights[spot].max(), params.size_m)
