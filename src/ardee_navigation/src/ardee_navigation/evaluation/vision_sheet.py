# SPDX-License-Identifier: MIT
"""A sheet of pictures with the crop rows that were found in them, and the true ones."""
from dataclasses import dataclass
from typing import Callable, Dict, List, Tuple

import cv2
import numpy as np

from ardee_navigation.vision.field_fit import FieldRows

Ways = Dict[str, Callable[[np.ndarray], np.ndarray]]
_TRUE, _FOUND, _TEXT = (255, 255, 255), (255, 60, 30), (255, 240, 60)
_TILE_PX = 320, 240  # width, height
_ACROSS = 3  # pictures, each with a tile for each way


@dataclass(frozen=True)
class Judged:
    """A picture uint8[h, w, 3] with its true rows, and by way those found in it and their mark."""

    name: str
    rgb: np.ndarray
    true: FieldRows
    found: Dict[str, FieldRows]
    marks: Dict[str, float]


def sheet(results: List[Judged]) -> np.ndarray:
    """Returns the pictures uint8[h, w, 3], for each way the true rows white and those that it found red."""
    pairs = [np.hstack([_tile(one, way) for way in one.found]) for one in results]
    pairs += [np.zeros_like(pairs[0])] * (-len(pairs) % _ACROSS)
    return np.vstack([np.hstack(pairs[i : i + _ACROSS]) for i in range(0, len(pairs), _ACROSS)])


def _tile(one: Judged, way: str) -> np.ndarray:
    height_px, width_px = one.rgb.shape[:2]
    scale = np.array(_TILE_PX) / (width_px, height_px)
    tile = cv2.resize(one.rgb, _TILE_PX, interpolation=cv2.INTER_AREA)
    for rows, colour in ((one.true, _TRUE), (one.found[way], _FOUND)):
        _draw(tile, rows, scale, width_px, colour)
    text = f"{one.name} {way} {one.marks[way]:.2f}"
    for shade, thickness in (((0, 0, 0), 3), (_TEXT, 1)):
        cv2.putText(
            tile, text, (4, 14), cv2.FONT_HERSHEY_SIMPLEX, 0.45, shade, thickness, cv2.LINE_AA
        )
    return tile


def _draw(
    tile: np.ndarray,
    rows: FieldRows,
    scale: np.ndarray,
    width_px: int,
    colour: Tuple[int, int, int],
) -> None:
    v = np.flatnonzero(np.isfinite(rows.period_px))
    period_px = rows.period_px[v]
    offset_px = np.unwrap(rows.offset_px[v] / period_px, period=1.0) * period_px
    first, last = ((side * width_px / 2.0 - offset_px) / period_px for side in (-1, 1))
    for row in range(int(np.ceil(first.min())), int(np.floor(last.max())) + 1):
        u = width_px / 2.0 + offset_px + row * period_px
        line = np.column_stack((u, v + 0.5)) * scale
        cv2.polylines(tile, [np.round(line).astype(np.int32)], False, colour, 1, cv2.LINE_AA)
