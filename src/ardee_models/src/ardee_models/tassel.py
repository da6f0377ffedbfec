# SPDX-License-Identifier: MIT
"""The tassel of corn: a central spike and lateral branches that droop."""

import numpy as np

from ardee_models.mesh import join, tube
from ardee_models.params import Architecture
from ardee_models.plant import Mesh

_SIDES = 3
_SPIKE_RADIUS_M = 0.004  # spikelets on the rachis (estimate)
_BRANCH_RADIUS_M = 0.003
_PEDUNCLE = 0.35  # bare part of the tassel's length


def _curve(origin: np.ndarray, azimuth: float, angles: np.ndarray, length_m: float) -> np.ndarray:
    step = length_m / len(angles)
    directions = np.stack(
        (np.sin(angles) * np.cos(azimuth), np.sin(angles) * np.sin(azimuth), np.cos(angles)), -1
    )
    return origin + np.concatenate((np.zeros((1, 3)), np.cumsum(directions * step, axis=0)))


def tassel_mesh(
    top: np.ndarray, stalk_radius_m: float, shape: Architecture, rng: np.random.Generator
) -> Mesh:
    """Tubes of three sides from the top of the stalk upwards."""
    length = shape.tassel_length_m * rng.normal(1.0, 0.05)
    heights = np.array([0.0, _PEDUNCLE, 0.7, 1.0]) * length
    spike = np.column_stack((np.zeros(4), np.zeros(4), heights)) + top
    radii = np.array([stalk_radius_m, _SPIKE_RADIUS_M, _SPIKE_RADIUS_M, 0.3 * _SPIKE_RADIUS_M])
    parts = [tube(spike, radii, np.array([0.0, 1.0, 0.0]), _SIDES)]
    azimuth = rng.uniform(0.0, 2.0 * np.pi)
    for branch in range(shape.tassel_branches):
        azimuth += np.radians(rng.normal(137.5, 15.0))
        where = _PEDUNCLE + 0.3 * branch / max(shape.tassel_branches, 1)
        origin = top + np.array([0.0, 0.0, where * length])
        first, last = np.radians(rng.normal(30.0, 6.0)), np.radians(rng.normal(95.0, 15.0))
        reach = shape.tassel_branch_length_m * rng.normal(1.0, 0.1)
        centres = _curve(origin, azimuth, np.linspace(first, last, 4), reach)
        radii = np.linspace(_BRANCH_RADIUS_M, 0.4 * _BRANCH_RADIUS_M, 5)
        side = np.array([-np.sin(azimuth), np.cos(azimuth), 0.0])
        parts.append(tube(centres, radii, side, _SIDES))
    return join(parts)
