# SPDX-License-Identifier: MIT
"""Layout to a plan view: planned places grey, plants green, as in thesis Figure 4.6."""

from PIL import Image, ImageDraw

from ardee_world.layout import Layout

_LARGEST_PX = 2000
_PX_PER_M = 60.0
_MARGIN_M = 0.5
_PLANNED = (190, 190, 190)
_PLANT = (40, 120, 40)


def draw_map(layout: Layout) -> Image.Image:
    """x to the right, y upwards; the origin is a red cross."""
    points = layout.planned.centres_m
    low = points.min(axis=0).clip(max=0.0) - _MARGIN_M
    high = points.max(axis=0).clip(min=0.0) + _MARGIN_M
    scale = min(_PX_PER_M, _LARGEST_PX / float((high - low).max()))
    width, height = (int(round(v)) + 1 for v in (high - low) * scale)
    image = Image.new("RGB", (width, height), (255, 255, 255))
    draw = ImageDraw.Draw(image)
    for xy, radius, colour in ((points, 0.02, _PLANNED), (layout.position_m[:, :2], 0.035, _PLANT)):
        r = max(radius * scale, 0.5)
        for x, y in ((xy - low) * scale).tolist():
            draw.ellipse((x - r, height - y - r, x + r, height - y + r), fill=colour)
    x0, y0 = -low[0] * scale, height + low[1] * scale
    draw.line((x0 - 6, y0, x0 + 6, y0), fill=(200, 0, 0), width=2)
    draw.line((x0, y0 - 6, x0, y0 + 6), fill=(200, 0, 0), width=2)
    return image
