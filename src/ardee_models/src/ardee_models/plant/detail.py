# SPDX-License-Identifier: MIT
"""Levels of detail: how many triangles a plant may have and where they go."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Detail:
    """Limits of one level; blades get the triangles that stalks and other bodies leave."""

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
    torn: bool


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
    torn=True,
)
LOD1 = Detail(  # level for hundreds of plants, seen from some metres
    suffix="_lod1",
    triangles=110,
    stalk_sides=3,
    stalk_rings=3,
    tiller_sides=3,
    body_sides=3,
    body_rings=3,
    minor_every=8,
    segments_min=2,
    segments_max=4,
    torn=False,
)
LEVELS = (FULL, LOD1)
