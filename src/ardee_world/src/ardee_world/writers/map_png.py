# SPDX-License-Identifier: MIT
"""Draws the plan view of a Layout: planned places green, plants red (thesis Figure 4.6); gaps, clutter, a legend."""

from typing import List, Tuple

import numpy as np
from PIL import Image, ImageDraw

from ardee_world.field_layout import Layout

_LARGEST_PX = 2000
_PX_PER_M = 120.0
_MARGIN_M = 0.6
_SMOOTH = 2  # factor by which the map is drawn larger, then reduced
_GRID = (232, 232, 232)
_ROW = (205, 200, 185)
_PLANNED = (110, 200, 110)
_PLANT = (200, 20, 20)
_FALLEN = (225, 140, 20)
_GAP = (60, 110, 220)
_ORIGIN = (0, 0, 0)
_CLUTTER = {"weed": (150, 60, 170), "stone": (90, 90, 100), "litter": (150, 105, 50)}
_CLUTTER_NAME = {"weed": "weeds", "stone": "stones", "litter": "pieces of litter"}
_PLANNED_RADIUS_M = (
    0.03  # larger than a plant's, so that a place shows below a plant that stands on it
)
_PLANT_RADIUS_M = 0.015
_CLUTTER_RADIUS_M = 0.03
_LEGEND_WIDTH_PX = 170
_LEGEND_LINE_PX = 16
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
        radius = max(radius_m * self.scale, float(_SMOOTH))
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


def _draw_plants(canvas: _Canvas, layout: Layout) -> None:
    """Draws each place of the plan, and each plant joined to its place."""
    plan, xy = layout.planned.centres_m, layout.position_m[:, :2]
    canvas.dots(plan, _PLANNED_RADIUS_M, _PLANNED)
    for gap in layout.gaps:
        canvas.dots(plan[gap.places], _PLANNED_RADIUS_M, _GAP)
    fallen = layout.lean.tilt_rad > 0.0
    tops = layout.height_m * np.sin(layout.lean.tilt_rad)
    towards = np.column_stack(
        (np.cos(layout.lean.direction_rad), np.sin(layout.lean.direction_rad))
    )
    for foot, top in zip(xy[fallen], (xy + tops[:, None] * towards)[fallen]):
        canvas.line(np.array([foot, top]), _FALLEN, _SMOOTH)
    for place, foot in zip(plan[layout.index], xy):
        canvas.line(np.array([place, foot]), _PLANT, _SMOOTH // 2)
    canvas.dots(xy[~fallen], _PLANT_RADIUS_M, _PLANT)
    canvas.dots(xy[fallen], _PLANT_RADIUS_M, _FALLEN)


def _legend_entries(layout: Layout) -> List[Tuple[tuple, str]]:
    """Colours and texts of the things that the map shows."""
    fallen = int((layout.lean.tilt_rad > 0.0).sum())
    entries = [
        (_PLANNED, len(layout.planned.centres_m), "planned places"),
        (_PLANT, layout.count() - fallen, "plants"),
        (_FALLEN, fallen, "leaning plants"),
        (_GAP, sum(len(gap.places) for gap in layout.gaps), "places in gaps"),
    ]
    entries += [(_CLUTTER[i.kind], len(i.xy_m), _CLUTTER_NAME[i.kind]) for i, _ in layout.clutter]
    return [(colour, f"{count} {text}") for colour, count, text in entries if count]


def _with_legend(image: Image.Image, layout: Layout, grid_step_m: float) -> Image.Image:
    """Returns the map with a legend at its right."""
    entries = _legend_entries(layout) + [
        (_ORIGIN, "the field's origin"),
        (_ROW, "rows as planned"),
        (_GRID, f"grid of {grid_step_m:g} m"),
    ]
    needed_px = _LEGEND_LINE_PX * (len(entries) + 1)
    size = (image.width + _LEGEND_WIDTH_PX, max(image.height, needed_px))
    whole = Image.new("RGB", size, (255, 255, 255))
    whole.paste(image, (0, 0))
    draw = ImageDraw.Draw(whole)
    for line, (colour, text) in enumerate(entries):
        x, y = image.width + 8, (line + 0.5) * _LEGEND_LINE_PX
        draw.rectangle((x, y + 1, x + 9, y + 10), fill=colour)
        draw.text((x + 16, y), text, fill=_TEXT)
    return whole


def draw_map(layout: Layout) -> Image.Image:
    """Draws the map, x to the right, y upwards; the origin is a black cross."""
    canvas = _Canvas(*_limits(layout))
    step = _grid(canvas)
    for row in layout.planned.rows:
        canvas.line(row.line_m, _ROW, _SMOOTH)
    for items, _ in layout.clutter:
        canvas.dots(items.xy_m, _CLUTTER_RADIUS_M, _CLUTTER[items.kind])
    _draw_plants(canvas, layout)
    arm = np.array([[-0.2, 0.0], [0.2, 0.0]])
    for cross in (arm, arm[:, ::-1]):
        canvas.line(cross, _ORIGIN, 2 * _SMOOTH)
    return _with_legend(canvas.image.reduce(_SMOOTH), layout, step)
