# SPDX-License-Identifier: MIT
"""The truth of crop rows: a line through the stalks of each."""

from typing import Dict, List, Tuple

import numpy as np
from ardee_sim.world import Plant, World

_ABOVE_M = 0.05
_COLORS = np.array([[255, 220, 0], [0, 200, 255]], np.uint8)  # of odd and even rows


def row_lines(world: World) -> Tuple[np.ndarray, np.ndarray]:
    """Returns segments from stalk to stalk, float[n, 2, 3], and their colours, uint8[n, 2, 3]."""
    rows: Dict[Tuple[str, int, int], List[Plant]] = {}
    for plant in world.plants():
        if plant.row is not None and plant.plot is not None:
            field = plant.name.rpartition("plant_")[0]
            rows.setdefault((field, plant.plot, plant.row), []).append(plant)
    segments, colors = [np.zeros((0, 2, 3))], [np.zeros((0, 2, 3), np.uint8)]
    for (_, _, row), plants in rows.items():
        ordered = sorted(plants, key=lambda plant: plant.place or 0)
        points = np.array([plant.xyz_m for plant in ordered]) + [0, 0, _ABOVE_M]
        segments.append(np.stack([points[:-1], points[1:]], axis=1))
        colors.append(np.broadcast_to(_COLORS[row % 2], segments[-1].shape))
    return np.concatenate(segments), np.concatenate(colors)
