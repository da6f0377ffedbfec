# SPDX-License-Identifier: MIT
"""Draws the plan view of a Layout: planned places grey, plants green, as in thesis Figure 4.6; gaps, clutter, plots."""

from typing import Tuple

import numpy as np
from PIL import Image, ImageDraw

from ardee_world.field_layout import Layout

_LARGEST_PX = 2000
_PX_PER_M = 60.0
_MARGIN_M = 0.6
_SMOOTH = 2  # factor by which the map is drawn larger, then reduced
_GRID = (232, 232, 232)
_ROW = (205, 200, 185)
_PLANNED = (190, 190, 190)
_PLANT = (40, 120, 40)
_FALLEN = (205, 130, 30)
_GAP = (230, 90, 90)
_ORIGIN = (200, 0, 0)
_CLUTTER = {"weed": (150, 60, 170), "stone": (90, 90, 100), "litter": (150, 105, 50)}
_TEXT = (60, 60, 60)


class _Canvas:
    """Maps the field's metres to pixels: x to the right, y upwards."""

    def __init__(self, low: np.ndarray, high: np.ndarray) -> None:
        self.low = low
        self.scale = min(_PX_PER_M, _LARGEST_PX / float((high - low).max())) * _SMOOTH
        width, height = (
            int(round(v)) // _SMOOTH * _SMOOTH + _SMOOTH for v in (high - low) * self.scale
        )
        self.high = low + np.array([width, height]) / self.scale
        self.image = Image.new("RGB", (width, height), (255, 255, 255))
        self.draw = ImageDraw.Draw(self.image)

    def pixels(self, xy: np.ndarray) -> np.ndarray:
        """Points as (column, row)."""
        up = (np.asarray(xy) - self.low) * self.scale
        return np.column_stack((up[:, 0], self.image.height - up[:, 1]))

    def line(self, xy: np.ndarray, colour: tuple, width: int) -> None:
        """Draws a polyline."""
        self.draw.line([tuple(p) for p in self.pixels(xy)], fill=colour, width=width)

    def dots(self, xy: np.ndarray, radius_m: float, colour: tuple) -> None:
        """Draws many discs at once, one pixel of the disc after the other."""
        if len(xy) == 0:
            return
        radius = max(radius_m * self.scale, 1.0)
        centre = np.floor(self.pixels(xy)).astype(int)
        pixels = np.array(self.image)
        reach = np.arange(-int(radius), int(radius) + 1)
        for dx in reach:
            for dy in reach[reach**2 + dx**2 <= radius**2]:
                column, row = centre[:, 0] + dx, centre[:, 1] + dy
                inside = (
                    (0 <= column)
                    & (column < pixels.shape[1])
                    & (0 <= row)
                    & (row < pixels.shape[0])
                )
                pixels[row[inside], column[inside]] = colour
        self.image = Image.fromarray(pixels)
        self.draw = ImageDraw.Draw(self.image)


def _grid(canvas: _Canvas) -> float:
    """Draws grid lines at a round distance, which it returns."""
    span = float((canvas.high - canvas.low).max())
    step = next(s for s in (1, 2, 5, 10, 20, 50, 100, 200, 500, 1e9) if span / s <= 40)
    for axis in (0, 1):
        for value in np.arange(np.ceil(canvas.low[axis] / step) * step, canvas.high[axis], step):
            ends = np.array([canvas.low, canvas.high])
            ends[:, axis] = value
            canvas.line(ends, _GRID, _SMOOTH // 2)
    return step


def _limits(layout: Layout) -> Tuple[np.ndarray, np.ndarray]:
    parts = [layout.planned.centres_m, layout.position_m[:, :2], np.zeros((1, 2))]
    points = np.concatenate(parts + [items.xy_m for items, _ in layout.clutter])
    return points.min(axis=0) - _MARGIN_M, points.max(axis=0) + _MARGIN_M


def draw_map(layout: Layout) -> Image.Image:
    """Draws the map, x to the right, y upwards; the origin is a red cross."""
    canvas = _Canvas(*_limits(layout))
    step = _grid(canvas)
    for row in layout.planned.rows:
        canvas.line(row.line_m, _ROW, _SMOOTH)
    plan = layout.planned.centres_m
    for items, _ in layout.clutter:
        canvas.dots(items.xy_m, 0.03, _CLUTTER[items.kind])
    canvas.dots(plan, 0.02, _PLANNED)
    for gap in layout.gaps:
        canvas.dots(plan[gap.places], 0.03, _GAP)
    fallen = layout.lean.tilt_rad > 0.0
    xy = layout.position_m[:, :2]
    canvas.dots(xy[~fallen], 0.035, _PLANT)
    canvas.dots(xy[fallen], 0.035, _FALLEN)
    tops = layout.height_m * np.sin(layout.lean.tilt_rad)
    towards = np.column_stack(
        (np.cos(layout.lean.direction_rad), np.sin(layout.lean.direction_rad))
    )
    for foot, top in zip(xy[fallen], (xy + tops[:, None] * towards)[fallen]):
        canvas.line(np.array([foot, top]), _FALLEN, _SMOOTH)
    arm = np.array([[-0.2, 0.0], [0.2, 0.0]])
    for cross in (arm, arm[:, ::-1]):
        canvas.line(cross, _ORIGIN, 2 * _SMOOTH)
    image = canvas.image.reduce(_SMOOTH)
    text = f"grid {step:g} m, {layout.count()} plants"
    ImageDraw.Draw(image).text((4, 2), text, fill=_TEXT)
    return image
