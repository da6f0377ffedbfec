# SPDX-License-Identifier: MIT
"""Texture images of the ground, drawn by the program: soil and grass. RGB uint8 arrays, row 0 on top."""

from typing import Dict

import numpy as np

from ardee_models.smooth_noise import layered_noise, smooth_noise

_SOIL_SHAPE = (256, 256)


def _image(rgb: np.ndarray) -> np.ndarray:
    return np.clip(np.rint(rgb), 0, 255).astype(np.uint8)


def _ground(colour: tuple, octaves: tuple, contrast: float, rng: np.random.Generator) -> np.ndarray:
    shade = 1.0 + contrast * layered_noise(_SOIL_SHAPE, octaves, rng)
    tint = 0.03 * layered_noise(_SOIL_SHAPE, (20.0,), rng)
    rgb = np.array(colour) * shade[..., None]
    return _image(rgb * np.stack((1.0 + tint, np.ones_like(tint), 1.0 - tint), axis=-1))


def dirt(rng: np.random.Generator) -> np.ndarray:
    """Tilled soil: brown, with clods of several sizes."""
    return _ground((121.0, 92.0, 66.0), (0.7, 2.0, 6.0, 18.0), 0.16, rng)


def grass(rng: np.random.Generator) -> np.ndarray:
    """Short grass: green, with fine upright streaks."""
    base = _ground((84.0, 116.0, 48.0), (0.7, 5.0, 24.0), 0.14, rng).astype(float)
    fine = smooth_noise(_SOIL_SHAPE, 0.6, rng)
    streaks = np.mean([np.roll(fine, shift, axis=0) for shift in range(7)], axis=0)
    return _image(base * (1.0 + 0.35 * streaks[..., None]))


def fungus(rng: np.random.Generator) -> np.ndarray:
    """Rotting plant matter on soil: dark olive patches."""
    soil = dirt(rng).astype(float)
    patch = 1.0 / (1.0 + np.exp(-4.0 * layered_noise(_SOIL_SHAPE, (4.0, 16.0), rng)))
    return _image(
        soil * (1.0 - 0.6 * patch[..., None])
        + np.array([92.0, 96.0, 56.0]) * 0.6 * patch[..., None]
    )


def media_textures(rng: np.random.Generator) -> Dict[str, np.ndarray]:
    """The images that terrain models name, by file stem."""
    flat_normal = np.empty((16, 16, 3), dtype=np.uint8)
    flat_normal[:] = (128, 128, 255)
    return {
        "dirt_diffusespecular": dirt(rng),
        "grass_diffusespecular": grass(rng),
        "fungus_diffusespecular": fungus(rng),
        "flat_normal": flat_normal,
    }
