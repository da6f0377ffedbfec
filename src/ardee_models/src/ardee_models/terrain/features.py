# SPDX-License-Identifier: MIT
"""Heights of a recipe: each part of a recipe is a function of place, with random numbers of its own."""

import numpy as np
from scipy import stats

from ardee_models.smooth_noise import smooth_noise
from ardee_models.terrain.height_map import Terrain
from ardee_models.terrain.recipe import Clods, Ditch, Headland, Recipe, Ridges, Ruts, Slope

_BERM_HEIGHT = 0.35  # height of the earth pressed out beside a rut over the rut's depth (estimate)
_LUMP_LEVEL = 0.8  # level above which ground is a clod, in standard deviations
_CLEAR_M = 0.4  # half side of the spot round the origin where a robot is set down


def _frame(x: np.ndarray, y: np.ndarray, direction_deg: float) -> tuple:
    """Distance along a direction and to its left."""
    c, s = np.cos(np.radians(direction_deg)), np.sin(np.radians(direction_deg))
    return c * x + s * y, c * y - s * x


def _smooth_step(value: np.ndarray) -> np.ndarray:
    """Smooth step: 0 below 0, 1 above 1, with level ends."""
    t = np.clip(value, 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def ridges(x: np.ndarray, y: np.ndarray, shape: Ridges) -> np.ndarray:
    """Raised cosine over each crop row at spacing (k + 1/2) to the side, level between."""
    _, across = _frame(x, y, shape.direction_deg)
    distance = np.abs((across / shape.spacing_m) % 1.0 - 0.5) * shape.spacing_m
    inside = np.minimum(distance / shape.half_width_m, 1.0)
    return shape.height_m * np.cos(0.5 * np.pi * inside) ** 2


def ridged_share(x: np.ndarray, y: np.ndarray, shape: Headland, direction_deg: float) -> np.ndarray:
    """Share of the ridges' height: 1 in the field, 0 on the headland."""
    along, across = _frame(x, y, direction_deg)
    fade = max(shape.fade_m, 1e-9)
    inner = _smooth_step((shape.along_m - np.abs(along)) / fade + 1.0)
    return inner * _smooth_step((shape.across_m - np.abs(across)) / fade + 1.0)


def ruts(x: np.ndarray, y: np.ndarray, shape: Ruts) -> np.ndarray:
    """Tracks with rounded edges, berms beside them, marks of lugs across their bottom."""
    along, across = _frame(x, y, shape.direction_deg)
    total = np.zeros_like(x)
    for side in (-0.5, 0.5):
        distance = np.abs(across - shape.offset_m - side * shape.track_m) / (0.5 * shape.width_m)
        bottom = 1.0 - _smooth_step((distance - 0.7) / 0.4)
        berm = np.where(
            np.abs(distance - 1.45) < 0.4, np.cos((distance - 1.45) / 0.8 * np.pi) ** 2, 0
        )
        lugs = 0.5 + 0.5 * np.cos(2.0 * np.pi * along / shape.lug_spacing_m)
        total += shape.depth_m * (_BERM_HEIGHT * berm - bottom) - shape.lug_depth_m * lugs * bottom
    return total


def clods(shape: tuple, spacing_m: float, scale: Clods, rng: np.random.Generator) -> np.ndarray:
    """Gaussian heights of one correlation length; as lumps, only the part above _LUMP_LEVEL."""
    noise = smooth_noise(shape, scale.size_m / spacing_m, rng)
    if not scale.lumps:
        return scale.sd_m * noise
    lumps = np.maximum(noise - _LUMP_LEVEL, 0.0)
    a = _LUMP_LEVEL  # moments of a normal variable cut at a
    mean = stats.norm.pdf(a) - a * stats.norm.sf(a)
    square = (1.0 + a * a) * stats.norm.sf(a) - a * stats.norm.pdf(a)
    return scale.sd_m * lumps / np.sqrt(square - mean**2)


def slope(x: np.ndarray, y: np.ndarray, shape: Slope) -> np.ndarray:
    """A plane through the origin."""
    return 0.01 * shape.grade_percent * _frame(x, y, shape.direction_deg)[0]


def ditch(x: np.ndarray, y: np.ndarray, shape: Ditch) -> np.ndarray:
    """A level bottom between two smooth banks."""
    _, across = _frame(x, y, shape.direction_deg)
    beyond = np.abs(across - shape.offset_m) - 0.5 * shape.bottom_width_m
    return -shape.depth_m * (1.0 - _smooth_step(beyond / shape.bank_width_m))


def follow(recipe: Recipe) -> Terrain:
    """Heights of a recipe; zero is the highest point near the origin, so that nothing set down there is buried."""
    recipe.validate()
    axis = np.linspace(-0.5, 0.5, recipe.samples) * recipe.size_m
    x, y = np.meshgrid(axis, -axis)
    spacing = recipe.size_m / (recipe.samples - 1)
    heights = slope(x, y, recipe.slope)
    for part in recipe.ridges:
        share = 1.0
        for headland in recipe.headland:
            share = ridged_share(x, y, headland, part.direction_deg)
        heights += share * ridges(x, y, part)
    for part in recipe.ruts:
        heights += ruts(x, y, part)
    for part in recipe.ditches:
        heights += ditch(x, y, part)
    for k, scale in enumerate(recipe.clods):
        rng = np.random.default_rng(np.random.SeedSequence(recipe.seed, spawn_key=(k,)))
        heights += clods(heights.shape, spacing, scale, rng)
    spot = (np.abs(x) <= _CLEAR_M) & (np.abs(y) <= _CLEAR_M)
    if not spot.any():
        spot = np.hypot(x, y) <= np.hypot(x, y).min()
    return Terrain(heights - heights[spot].max(), recipe.size_m)
