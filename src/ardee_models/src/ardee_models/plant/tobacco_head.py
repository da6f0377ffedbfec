# SPDX-License-Identifier: MIT
"""The flowering head of tobacco: branches with tubular flowers, later capsules."""

from typing import List

import numpy as np

from ardee_models.plant.curve import Curve
from ardee_models.plant.lathe import Lathe, spindle
from ardee_models.plant.organ_params import Flowers
from ardee_models.plant.shoot import Shoot

# Bands of the flowers' texture, from its lower edge
BRANCH_BAND, TUBE_BAND, LIMB_BAND, CAPSULE_BAND = (
    (0.0, 0.22),
    (0.27, 0.47),
    (0.52, 0.72),
    (0.78, 1.0),
)
_GOLDEN_RAD = np.radians(137.5)
_TWIG_RADIUS_M = 0.0022  # estimate
_CAPSULE_M = (0.020, 0.006)  # length and radius of a ripe capsule (estimate)


def _flower(
    origin: np.ndarray,
    azimuth: float,
    angle: float,
    shape: Flowers,
    growth: float,
    capsule: bool,
) -> List[Lathe]:
    if capsule:
        curve = Curve(origin, azimuth, angle, angle, _CAPSULE_M[0])
        return [spindle(curve, _CAPSULE_M[1], CAPSULE_BAND, 4, minor=True)]
    length = shape.corolla_length_m * (0.35 + 0.65 * growth)
    tube_radius = 0.11 * length
    curve = Curve(origin, azimuth, angle, angle, 0.86 * length)
    parts = [
        Lathe(
            curve,
            (0.0, 1.0),
            (0.5 * tube_radius, 1.2 * tube_radius),
            TUBE_BAND,
            sides=3,
            minor=True,
        )
    ]
    if growth > 0.5:  # open: the limb spreads from the mouth of the tube
        mouth = curve.points(np.array([curve.length_m]))[0]
        limb = Curve(mouth, azimuth, angle, angle, 0.14 * length)
        radii = (1.2 * tube_radius, 0.5 * shape.corolla_diameter_m * growth)
        parts.append(Lathe(limb, (0.0, 1.0), radii, LIMB_BAND, sides=5, minor=True))
    return parts


def flowers(
    shoot: Shoot, shape: Flowers, growth: float, maturity: float, rng: np.random.Generator
) -> List[Lathe]:
    """An axis that carries on the stalk, branches in a spiral, flowers at their ends."""
    stalk = shoot.stalk
    end = stalk.curve.length_m
    top = stalk.curve.points(np.array([end]))[0]
    lean = float(stalk.curve.angle(np.array([end]))[0])
    axis = Curve(top, stalk.curve.azimuth_rad, lean, lean, shape.axis_m * growth)
    radius = stalk.top_radius_m
    parts = [Lathe(axis, (0.0, 1.0), (radius, 0.4 * radius), BRANCH_BAND, sides=5)]
    turn = rng.uniform(0.0, 2.0 * np.pi)
    for k in range(shape.branches):
        turn += _GOLDEN_RAD + rng.normal(0.0, 0.15)
        along = 0.25 + 0.75 * k / max(shape.branches - 1, 1)
        reach = shape.branch_length_m * growth * (1.25 - 0.6 * along) * rng.normal(1.0, 0.1)
        start = axis.points(np.array([along * axis.length_m]))[0]
        opening = np.radians(rng.normal(48.0, 7.0)) * (1.3 - 0.6 * along)
        twig = Curve(start, turn, opening, 0.6 * opening, reach)
        parts.append(
            Lathe(twig, (0.0, 1.0), (1.4 * _TWIG_RADIUS_M, _TWIG_RADIUS_M), BRANCH_BAND, minor=True)
        )
        for j in range(shape.flowers_per_branch):
            where = 1.0 - 0.22 * j
            spread = turn + rng.normal(0.0, 0.4) + 2.1 * j
            angle = np.radians(rng.normal(52.0, 14.0))
            origin = twig.points(np.array([where * reach]))[0]
            capsule = rng.uniform() < maturity
            parts += _flower(origin, spread, angle, shape, growth, capsule)
    return parts
