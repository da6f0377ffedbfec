# SPDX-License-Identifier: MIT
"""Levels of detail: how many triangles a plant may have and where they go."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Detail:
    """Limits of one level; blades take what stalks and other bodies leave of the budget."""

    suffix: str
    triangles: int
    stalk_sides: int
    stalk_rings: int
    tiller_sides: int
    body_sides: int
    body_rings: int
    minor_every: int
    segments_min: int
    segments_max: int


FULL = Detail(
    suffix="",
    triangles=1800,
    stalk_sides=6,
    stalk_rings=1000,
    tiller_sides=4,
    body_sides=6,
    body_rings=6,
    minor_every=1,
    segments_min=6,
    segments_max=22,
)
LOD1 = Detail(
    suffix="_lod1",
    triangles=330,
    stalk_sides=4,
    stalk_rings=4,
    tiller_sides=3,
    body_sides=4,
    body_rings=4,
    minor_every=6,
    segments_min=3,
    segments_max=12,
)
LEVELS = (FULL, LOD1)
