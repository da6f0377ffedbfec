# SPDX-License-Identifier: MIT
"""Dust and drops on the lens: what they do to pictures."""

from dataclasses import dataclass
from typing import Any, Dict, List, Tuple

import numpy as np
from PIL import Image

from ardee_common.errors import GeneratorError
from ardee_common.options import option

_SOFT = 0.5  # share of a spot's radius over which its edge fades, far out of focus (nominal)
_HAZE = 0.3  # share of the light that dust takes which it scatters all over the picture (nominal)
_BLURRED_PX = 16  # width to which a drop reduces the whole picture, out of focus (nominal)
_Range = Tuple[float, float]


@dataclass(frozen=True)
class LensKeys:
    """Dust and drops on a camera's lens, drawn for each field and the same in all its pictures, from [least, most].

    Numbers and sizes depend on camera and weather; the defaults are nominal, without a source.
    """

    dust: Tuple[int, int] = option((0, 0), "number of spots of dust", (0, 1000))
    dust_diameter: _Range = option((0.01, 0.05), "of a spot, share of the picture's width", (0, 1))
    dust_opacity: _Range = option((0.1, 0.5), "share of the light that a spot takes", (0, 1))
    drops: Tuple[int, int] = option((0, 0), "number of drops of water", (0, 1000))
    drop_diameter: _Range = option((0.03, 0.12), "of a drop, share of the picture's width", (0, 1))

    def __post_init__(self) -> None:
        for key, (low, high) in vars(self).items():
            if low > high:
                raise GeneratorError(f"{key}: found [{low}, {high}], expected [least, most]")

    def draw(self, rng: np.random.Generator, size: Tuple[int, int]) -> "Lens":
        """Returns a lens before pictures of width and height `size` in pixels."""
        spots = []
        for kind, count, diameter in (
            ("dust", self.dust, self.dust_diameter),
            ("drop", self.drops, self.drop_diameter),
        ):
            for _ in range(int(rng.integers(count[0], count[1] + 1))):
                u, v = rng.uniform((0, 0), size)
                across = rng.uniform(*diameter) * size[0]
                opacity = rng.uniform(*self.dust_opacity) if kind == "dust" else 1.0
                numbers = (round(float(value), 3) for value in (u, v, across, opacity))
                spots.append(Spot(kind, *numbers))
        return Lens(tuple(spots))


@dataclass(frozen=True)
class Spot:
    """A spot of dust or a drop before a picture, whose upper left corner is 0 0."""

    kind: str
    u_px: float
    v_px: float
    diameter_px: float
    opacity: float

    def cover(self, height: int, width: int) -> np.ndarray:
        """Returns the share of light that it takes in each pixel, float64[h, w]."""
        v, u = np.mgrid[0.5:height, 0.5:width]
        radius = self.diameter_px / 2
        inside = 1.0 - np.hypot(u - self.u_px, v - self.v_px) / max(radius, 1e-9)
        return self.opacity * np.clip(inside / _SOFT, 0.0, 1.0)


@dataclass(frozen=True)
class Lens:
    """A lens with what lies on it."""

    spots: Tuple[Spot, ...] = ()

    def applied(self, rgb: np.ndarray) -> np.ndarray:
        """Returns a picture, uint8[h, w, 3], as this lens lets it through.

        Dust takes a share of the light and scatters some of the picture's mean (Gu, Ramamoorthi, Belhumeur and Nayar,
        ACM Transactions on Graphics 28(5), 2009). A drop, itself a lens, shows the whole picture small, upside down and
        out of focus.
        """
        if not self.spots:
            return rgb
        made = rgb.astype(float)
        height, width = rgb.shape[:2]
        haze = _HAZE * rgb.reshape(-1, 3).mean(axis=0)
        for spot in self.spots:
            cover = spot.cover(height, width)[..., None]
            behind = haze if spot.kind == "dust" else _through_drop(rgb, spot)
            made += cover * (behind - made)
        return np.rint(made).astype(np.uint8)

    def description(self) -> List[Dict[str, Any]]:
        """Returns the entry of a sample."""
        return [dict(vars(spot)) for spot in self.spots]


def _through_drop(rgb: np.ndarray, spot: Spot) -> np.ndarray:
    """Returns float64[h, w, 3]: about the drop the whole picture, out of focus and turned upside down."""
    height, width = rgb.shape[:2]
    across = max(round(spot.diameter_px), 1)
    blurred = Image.fromarray(rgb).resize((_BLURRED_PX, _BLURRED_PX), Image.Resampling.BOX)
    small = np.asarray(blurred.resize((across, across), Image.Resampling.BILINEAR), float)[
        ::-1, ::-1
    ]
    left, upper = round(spot.u_px - across / 2), round(spot.v_px - across / 2)
    columns = np.clip(np.arange(width) - left, 0, across - 1)
    rows = np.clip(np.arange(height) - upper, 0, across - 1)
    return small[rows[:, None], columns[None, :]]
