# SPDX-License-Identifier: MIT
"""Makes terrain of a user's grey image, thesis Figure 4.9: black is the lowest ground, white the highest."""

from pathlib import Path
from typing import Callable, Optional

import numpy as np
from scipy.ndimage import map_coordinates

from ardee_common.errors import GeneratorError
from ardee_models.terrain.grey_image import read_grey
from ardee_models.terrain.height_map import Terrain
from ardee_models.terrain.recipe import SAMPLES

Say = Callable[[str], None]


def fitting_samples(side_px: int, wanted: Optional[int] = None) -> int:
    """Number of samples a side: `wanted`, else the smallest allowed number that loses no detail."""
    if wanted is None:
        return next((n for n in SAMPLES if n >= side_px), SAMPLES[-1])
    if wanted not in SAMPLES:
        known = ", ".join(map(str, SAMPLES))
        raise GeneratorError(f"terrain samples: found {wanted}, expected one of {known}")
    return wanted


def resample(heights_m: np.ndarray, samples: int) -> np.ndarray:
    """Resamples a square grid to another number of samples; its corners stay in place."""
    if heights_m.shape == (samples, samples):
        return heights_m
    rows, columns = heights_m.shape
    place = np.meshgrid(
        np.linspace(0, rows - 1, samples), np.linspace(0, columns - 1, samples), indexing="ij"
    )
    return map_coordinates(heights_m, place, order=1, mode="nearest")


def level_at_origin(heights_m: np.ndarray, size_m: float) -> Terrain:
    """Shifts heights so that the ground at the origin is zero."""
    terrain = Terrain(heights_m, size_m)
    here = float(terrain.height_at(np.zeros(1), np.zeros(1))[0])
    return Terrain(heights_m - here, size_m)


def image_terrain(
    path: Path, size_m: float, height_m: float, samples: Optional[int], say: Say
) -> Terrain:
    """Terrain of an image, `height_m` high between black and white; `say` gets a warning of the steps of 8 bits."""
    if not (np.isfinite(height_m) and 0.0 <= height_m <= 10_000.0):
        raise GeneratorError(f"image height: found {height_m} m, expected 0 to 10000 m")
    image = read_grey(path)
    rows, columns = image.pixels.shape
    if rows != columns or rows < 2:
        raise GeneratorError(
            f"{path}: found {columns} x {rows} pixels, expected a square image of at least 2 x 2"
        )
    levels = len(np.unique(image.pixels))
    if image.white < 65535 and levels > 1:
        step_mm = 1000.0 * height_m / image.white
        say(
            f"{path}: has {image.white + 1} levels of grey, so the ground is quantised into steps of {step_mm:.3g} mm;"
            " a 16-bit image has finer ones"
        )
    heights = image.pixels / image.white * height_m
    return level_at_origin(resample(heights, fitting_samples(rows, samples)), size_m)
