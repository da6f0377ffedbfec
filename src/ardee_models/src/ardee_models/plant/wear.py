# SPDX-License-Identifier: MIT
"""Damage by wind and age: blades tear along their veins, shreds stand off, tips break."""

from dataclasses import replace
from typing import List, Tuple

import numpy as np

from ardee_models.plant.leaf import Blade, Shred
from ardee_models.plant.organ_params import Wear
from ardee_models.plant.shoot import Shoot
from ardee_models.plant.species import Architecture

MOST_TEARS = 3  # of a blade: each costs two more columns of vertices
_MOST_SDS = 2.0  # of a shred's angle


def _shreds(blade: Blade, age: float, wear: Wear, rng: np.random.Generator) -> Tuple[Shred, ...]:
    """Shreds of a blade from edge to edge; the one with the midrib, which is stiff, does not stand off.

    Age is 0 for the youngest leaf, and grows by 1 while a stem makes all its leaves.
    """
    mean = wear.tears_green * age * (1.0 - blade.dryness) + wear.tears_dead * blade.dryness
    tears = np.sort(rng.uniform(-1.0, 1.0, min(int(rng.poisson(mean)), MOST_TEARS)))
    apart_from = 1.0 - rng.uniform(0.0, min(2.0 * wear.tear_length, 1.0), len(tears))
    edges = (-1.0, *map(float, tears), 1.0)
    shreds: List[Shred] = []
    for i, (low, high) in enumerate(zip(edges, edges[1:])):
        bordering = apart_from[max(i - 1, 0) : i + 1]
        stiff = low <= 0.0 <= high
        angles = wear.stand_off_sd_deg * rng.normal(0.0, 1.0, 2).clip(-_MOST_SDS, _MOST_SDS)
        side, up = np.radians(angles) * (not stiff)
        lost = min(rng.exponential(wear.lost_tip * blade.dryness), 0.9)
        shreds.append(Shred(low, high, float(np.max(bordering, initial=0.0)), 1.0 - lost, side, up))
    return tuple(shreds)


def worn(shoot: Shoot, shape: Architecture, rng: np.random.Generator) -> Shoot:
    """The shoot as wind and age leave it; unchanged if its species has no parameters of wear."""
    wear = shape.wear
    if wear is None:
        return shoot
    blades = []
    for blade in shoot.blades:
        age = (shoot.emerged - blade.rank) / shape.leaves.number
        blades.append(replace(blade, shreds=_shreds(blade, age, wear, rng)))
    return replace(shoot, blades=tuple(blades))
