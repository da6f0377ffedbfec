# SPDX-License-Identifier: MIT
"""The panicle of sorghum on its peduncle."""

from typing import List

import numpy as np

from ardee_models.plant.curve import Curve
from ardee_models.plant.lathe import Lathe, spindle
from ardee_models.plant.organ_params import Panicle
from ardee_models.plant.shoot import Shoot

PEDUNCLE_BAND, GRAIN_BAND = (0.0, 0.2), (0.25, 1.0)  # bands of the panicle's texture
_GOLDEN_RAD = np.radians(137.5)
_RELATIVE = np.array([0.0, 0.12, 0.35, 0.65, 0.88, 1.0])
# relative radii of a semi-compact head (estimate)
_OUTLINE = np.array([0.25, 0.70, 1.0, 0.9, 0.55, 0.12])


def panicle(
    shoot: Shoot, shape: Panicle, growth: float, scale: float, rng: np.random.Generator
) -> List[Lathe]:
    """Peduncle, core, and grain-bearing branches on a spiral over an egg-shaped head."""
    stalk = shoot.stalk
    end = stalk.curve.length_m
    top = stalk.curve.points(np.array([end]))[0]
    lean = float(stalk.curve.angle(np.array([end]))[0])
    azimuth = stalk.curve.azimuth_rad
    peduncle = Curve(top, azimuth, lean, lean, shape.peduncle_m * scale * growth)
    radius = stalk.top_radius_m
    parts = [Lathe(peduncle, (0.0, 1.0), (radius, 0.75 * radius), PEDUNCLE_BAND, sides=5)]
    length = shape.length_m * scale * growth * rng.normal(1.0, 0.06)
    half = 0.5 * shape.diameter_m * scale * growth * rng.normal(1.0, 0.06)
    head = Curve(peduncle.points(np.array([peduncle.length_m]))[0], azimuth, lean, lean, length)
    core = tuple(0.72 * half * _OUTLINE)
    parts.append(Lathe(head, tuple(_RELATIVE), core, GRAIN_BAND, sides=6))
    turn = rng.uniform(0.0, 2.0 * np.pi)
    for k in range(shape.clusters):
        turn += _GOLDEN_RAD
        along = (k + 0.5) / shape.clusters * 0.9
        reach = half * float(np.interp(along, _RELATIVE, _OUTLINE)) * rng.normal(0.8, 0.07)
        start = head.points(np.array([along * length]))[0]
        outward = np.array([np.cos(turn), np.sin(turn), 0.0])
        angle = np.radians(rng.normal(32.0, 6.0))
        size = 0.17 * length * (1.0 - 0.3 * along) * rng.normal(1.0, 0.1)
        curve = Curve(start + 0.55 * reach * outward, turn, angle, 0.6 * angle, size)
        parts.append(spindle(curve, 0.30 * half, GRAIN_BAND, 3, minor=True))
    return parts
