# SPDX-License-Identifier: MIT
"""Texture images drawn by the program: blades, stalk, tassel; soil and grass. RGB uint8 arrays, row 0 on top."""

from typing import Dict

import numpy as np

from ardee_models.noise import layered_noise, smooth_noise

_LEAF_SHAPE = (256, 128)
_SOIL_SHAPE = (256, 256)
_GREEN = np.array([78.0, 122.0, 42.0])
_PALE = np.array([168.0, 190.0, 116.0])
_STRAW = np.array([186.0, 162.0, 92.0])
_VEINS = 26  # parallel veins drawn across a blade


def _image(rgb: np.ndarray) -> np.ndarray:
    return np.clip(np.rint(rgb), 0, 255).astype(np.uint8)


def blade(senescence: float, rng: np.random.Generator) -> np.ndarray:
    """A grass blade: base at the lower edge, midrib in the middle, parallel veins, dry tip and edges."""
    rows, columns = _LEAF_SHAPE
    v = (1.0 - np.linspace(0.0, 1.0, rows))[:, None]
    u = np.linspace(-1.0, 1.0, columns)[None, :]
    tone = 1.0 + rng.normal(0.0, 0.05)
    shade = (
        tone
        + 0.05 * np.cos(np.pi * _VEINS * u)
        + 0.06 * layered_noise(_LEAF_SHAPE, (3.0, 12.0), rng)
    )
    rgb = _GREEN * shade[..., None]
    midrib = np.exp(-((u / (0.10 - 0.07 * v)) ** 2))[..., None]
    rgb = rgb * (1.0 - 0.8 * midrib) + _PALE * 0.8 * midrib
    patches = 0.5 * smooth_noise(_LEAF_SHAPE, 14.0, rng)
    dryness = 1.0 / (
        1.0
        + np.exp(-10.0 * (0.5 * v**4 + 0.3 * u**4 + 1.3 * senescence + 0.25 * patches - 1.0))
    )
    return _image(rgb * (1.0 - dryness[..., None]) + _STRAW * dryness[..., None])


def stem(senescence: float, rng: np.random.Generator) -> np.ndarray:
    """The stalk in its sheaths: purple-brown foot, pale green above, fine lengthwise fibres."""
    rows, columns = _LEAF_SHAPE
    v = (1.0 - np.linspace(0.0, 1.0, rows))[:, None]
    fibres = smooth_noise((1, columns), 1.5, rng)
    shade = 1.0 + 0.06 * fibres + 0.05 * layered_noise(_LEAF_SHAPE, (4.0, 16.0), rng)
    green = np.array([120.0, 148.0, 72.0]) * (1.0 - 0.4 * senescence) + _STRAW * 0.4 * senescence
    foot = np.exp(-v / 0.06)[..., None]
    colour = green * (1.0 - 0.5 * foot) + np.array([110.0, 70.0, 60.0]) * 0.5 * foot
    return _image(colour * shade[..., None])


def tassel(senescence: float, rng: np.random.Generator) -> np.ndarray:
    """Spikelets: straw-yellow with darker flecks."""
    shade = 1.0 + 0.12 * smooth_noise((64, 32), 1.5, rng)
    colour = np.array([198.0, 178.0, 104.0]) * (1.0 - 0.15 * senescence)
    return _image(colour * shade[..., None])


def plant_textures(senescence: float, rng: np.random.Generator) -> Dict[str, np.ndarray]:
    """Images by organ texture name; leaves dry from the ground up."""
    return {
        "stem": stem(senescence, rng),
        "leavesb": blade(senescence, rng),
        "leavesm": blade(0.4 * senescence, rng),
        "leavest": blade(0.2 * senescence, rng),
        "tassel": tassel(senescence, rng),
    }


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
