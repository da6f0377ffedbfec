# SPDX-License-Identifier: MIT
"""A picture of a terrain seen from above: hill shading, contours of height by colour, a scale."""

import numpy as np
from PIL import Image, ImageDraw

from ardee_models.terrain.height_map import Terrain

_SIDE_PX = 800
_SUN = np.array([-0.6, 0.6, 0.9])  # direction of the sun: north-west, as on maps
_LOW, _HIGH = np.array([96.0, 74.0, 54.0]), np.array([198.0, 176.0, 140.0])


def shaded(terrain: Terrain) -> Image.Image:
    """Shaded picture, x to the right, y upwards; slopes are exaggerated, but the roughest ground is not black."""
    axis = (np.arange(_SIDE_PX) + 0.5) / _SIDE_PX - 0.5
    x, y = np.meshgrid(axis * terrain.size_m, -axis * terrain.size_m)
    heights = terrain.height_at(x, y)
    step = terrain.size_m / _SIDE_PX
    down, right = np.gradient(heights, step)
    steep = float(np.quantile(np.hypot(down, right), 0.99))
    gain = 0.8 / steep if steep > 0.0 else 0.0
    normal = np.stack((-right * gain, down * gain, np.ones_like(heights)), axis=-1)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    light = (normal @ (_SUN / np.linalg.norm(_SUN))).clip(0.0, 1.0)
    low, high = float(heights.min()), float(heights.max())
    share = (heights - low) / (high - low) if high > low else np.zeros_like(heights)
    rgb = (_LOW + share[..., None] * (_HIGH - _LOW)) * (0.35 + 0.85 * light[..., None])
    image = Image.fromarray(np.clip(np.rint(rgb), 0, 255).astype(np.uint8))
    draw = ImageDraw.Draw(image)
    text = f"{terrain.size_m:g} m square, heights {low:.3f} to {high:.3f} m"
    draw.text((6, 4), text, fill=(255, 255, 255))
    middle = _SIDE_PX // 2
    draw.line((middle - 8, middle, middle + 8, middle), fill=(220, 0, 0), width=2)
    draw.line((middle, middle - 8, middle, middle + 8), fill=(220, 0, 0), width=2)
    return image
