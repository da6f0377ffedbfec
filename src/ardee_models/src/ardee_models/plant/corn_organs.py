# SPDX-License-Identifier: MIT
"""Tassel, ears and brace roots of corn."""

from typing import List

import numpy as np

from ardee_models.plant.curve import Curve
from ardee_models.plant.lathe import Lathe
from ardee_models.plant.leaf import Blade
from ardee_models.plant.organ_params import BraceRoots, Ears, Tassel
from ardee_models.plant.shoot import Shoot

HUSK_BAND, SILK_BAND = (0.0, 0.72), (0.76, 1.0)  # bands of the ears' texture
_SPIKE_RADIUS_M = 0.0045  # spikelets on the rachis (estimate)
_BRANCH_RADIUS_M = 0.0035  # estimate
_PEDUNCLE = 0.32  # bare part of the tassel's length (estimate)
_BRANCH_ZONE = 0.26  # part of the length above the peduncle in which branches start (estimate)
_ROOT_TIP_M = 0.002  # radius (estimate)
_SILK_STRANDS = 5  # number of strands drawn
_SILK_RADIUS_M = 0.003  # radius of a drawn strand, which stands for a bundle


def tassel(shoot: Shoot, shape: Tassel, growth: float, rng: np.random.Generator) -> List[Lathe]:
    """A spike that carries on the stalk, and branches that open as it sheds pollen."""
    stalk = shoot.stalk
    end = stalk.curve.length_m
    top = stalk.curve.points(np.array([end]))[0]
    lean = float(stalk.curve.angle(np.array([end]))[0])
    length = shape.length_m * growth * rng.normal(1.0, 0.05)
    spike = Curve(top, stalk.curve.azimuth_rad, lean, lean, length)
    radii = (stalk.top_radius_m, 1.1 * _SPIKE_RADIUS_M, _SPIKE_RADIUS_M, 0.3 * _SPIKE_RADIUS_M)
    parts = [Lathe(spike, (0.0, _PEDUNCLE, 0.7, 1.0), radii, sides=4)]
    azimuth = rng.uniform(0.0, 2.0 * np.pi)
    count = max(shape.branches + int(rng.integers(-2, 3)), 1) if shape.branches else 0
    for branch in range(count):
        azimuth += np.radians(rng.normal(137.5, 15.0))
        height = _PEDUNCLE + _BRANCH_ZONE * branch / count
        first, last = np.radians(growth * np.array([rng.normal(28.0, 6.0), rng.normal(85.0, 15.0)]))
        reach = shape.branch_length_m * growth * rng.normal(1.0, 0.1) * (1.0 - 0.3 * branch / count)
        origin = spike.points(np.array([height * length]))[0]
        curve = Curve(origin, azimuth, max(first, 0.0), max(last, 0.0), reach)
        radii = tuple(_BRANCH_RADIUS_M * np.array([0.7, 1.0, 0.9, 0.4]))
        parts.append(Lathe(curve, (0.0, 0.3, 0.7, 1.0), radii, minor=True))
    return parts


def _ear(
    shoot: Shoot, blade: Blade, shape: Ears, growth: float, maturity: float, scale: float
) -> List[Lathe]:
    hang = (max(maturity - 0.5, 0.0) / 0.5) ** 2
    angle = np.radians(shape.angle_deg + (shape.angle_ripe_deg - shape.angle_deg) * hang)
    length = shape.length_m * scale * (0.35 + 0.65 * growth)
    radius = 0.5 * shape.diameter_m * scale * (0.3 + 0.7 * growth)
    index = min(blade.rank - 1, len(shoot.stalk.collars_m) - 1)
    node = shoot.stalk.collars_m[max(index - 1, 0)]
    outward = np.array([np.cos(blade.azimuth_rad), np.sin(blade.azimuth_rad), 0.0])
    origin = shoot.stalk.curve.points(np.array([node]))[0]
    origin = origin + 0.9 * float(shoot.stalk.radius_m(node)) * outward
    curve = Curve(origin, blade.azimuth_rad, 0.5 * angle, angle, length)
    relative = (0.0, 0.1, 0.3, 0.6, 0.85, 1.0)
    radii = tuple(radius * np.array([0.3, 0.62, 0.95, 1.0, 0.6, 0.16]))
    parts = [Lathe(curve, relative, radii, HUSK_BAND, sides=6)]
    tip = curve.points(np.array([length]))[0]
    silk = shape.silk_length_m * scale * min(growth / 0.55, 1.0) * (1.0 - 0.45 * maturity)
    for strand in range(_SILK_STRANDS):
        turn = blade.azimuth_rad + 2.0 * np.pi * strand / _SILK_STRANDS
        droop = Curve(tip, turn, 0.5 * angle, angle + np.radians(150.0), silk)
        parts.append(
            Lathe(
                droop,
                (0.0, 0.4, 1.0),
                (1.4 * _SILK_RADIUS_M, _SILK_RADIUS_M, 0.2 * _SILK_RADIUS_M),
                SILK_BAND,
                minor=True,
            )
        )
    return parts


def ears(
    shoot: Shoot, shape: Ears, growth: float, maturity: float, rng: np.random.Generator
) -> List[Lathe]:
    """Husked ears with silk in the axils of leaves: one, on some plants a smaller one below it."""
    second = rng.uniform() < shape.second_probability
    rank = int(round(shape.relative_rank * shoot.emerged))
    by_rank = {blade.rank: blade for blade in shoot.blades}
    parts: List[Lathe] = []
    for below, scale in ((0, 1.0), (1, 0.7)) if second else ((0, 1.0),):
        if rank - below in by_rank:
            scale *= rng.normal(1.0, 0.05)
            parts += _ear(shoot, by_rank[rank - below], shape, growth, maturity, scale)
    return parts


def brace_roots(shoot: Shoot, shape: BraceRoots, rng: np.random.Generator) -> List[Lathe]:
    """Two whorls of roots that run from the lowest nodes out to the ground."""
    parts = []
    for k in range(shape.count):
        azimuth = 2.0 * np.pi * k / shape.count + rng.normal(0.0, 0.15)
        upper = k % 2
        height = shape.height_m * (0.6 + 0.4 * upper) * rng.normal(1.0, 0.06)
        reach = shape.spread_m * (0.7 + 0.3 * upper) * rng.normal(1.0, 0.08)
        foot = shoot.stalk.curve.points(np.array([height]))[0]
        outward = np.array([np.cos(azimuth), np.sin(azimuth), 0.0])
        angle = np.pi - np.arctan2(reach, height)
        curve = Curve(
            foot + 0.8 * shoot.stalk.base_radius_m * outward,
            azimuth,
            angle,
            angle,
            float(np.hypot(reach, height))
            * (1.0 - 2.0 * _ROOT_TIP_M / height),  # ends on the ground
        )
        parts.append(Lathe(curve, (0.0, 1.0), (0.003, _ROOT_TIP_M), minor=True))
    return parts
