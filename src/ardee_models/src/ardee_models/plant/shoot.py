# SPDX-License-Identifier: MIT
"""One shoot, a main stem or a tiller, phytomer by phytomer: its stalk and blades."""

from dataclasses import dataclass
from typing import List, Tuple

import numpy as np

from ardee_models.plant.curve import Curve
from ardee_models.plant.leaf import MOST_DOWNWARD, Blade
from ardee_models.plant.leaf_sizes import full_sizes, young_fractions
from ardee_models.plant.species import Architecture
from ardee_models.plant.stages import Stage
from ardee_models.plant.stalk import StalkPlan, ligule_heights

STRIP_DRYNESS = (0.0, 0.0, 0.12, 0.45, 0.75, 1.0)  # dryness of the strips of a leaf texture
_BUCKLE_AT = (0.4, 0.6)  # part of the blade's length (Helios)
_FRESH_STRIPS = 2


@dataclass(frozen=True)
class ShootSize:
    """Parts of a shoot at its stage; lengths in metres."""

    number: int
    collared: int
    young: int
    lost: int
    dry: float
    maturity: float
    height_m: float
    base_radius_m: float
    top_radius_m: float
    leaf_scale: float = 1.0
    hanging: int = 0


@dataclass(frozen=True)
class Shoot:
    """A grown shoot."""

    stalk: StalkPlan
    blades: Tuple[Blade, ...]
    emerged: int


def main_size(shape: Architecture, stage: Stage, rng: np.random.Generator) -> ShootSize:
    """The main stem of one plant, which differs a little from the mean plant of its stage."""
    usual = shape.leaves.number
    number = max(3, int(round(usual + shape.leaves.number_sd * rng.normal())))
    complete = stage.collared_leaves == usual
    collared = number if complete else min(stage.collared_leaves, number)
    young = min(stage.young_leaves, number - collared)
    lost = min(stage.lost_leaves, collared - 1)
    diameter = float(np.exp(shape.stalk.diameter_cv * rng.normal()))
    return ShootSize(
        number=number,
        collared=collared,
        young=young,
        lost=lost,
        dry=stage.dry_leaves,
        maturity=stage.maturity,
        height_m=stage.stalk_height_m * float(np.exp(shape.stalk.height_cv * rng.normal())),
        base_radius_m=0.5 * stage.base_diameter_m * diameter,
        top_radius_m=0.5 * stage.top_diameter_m * diameter,
        leaf_scale=stage.leaf_scale,
        hanging=min(stage.hanging_leaves, lost),
    )


def dryness(size: ShootSize, index: np.ndarray) -> np.ndarray:
    """Dryness, 0 green to 1 dead, by leaf index from the foot: 0.5 at the `dry`-th leaf, less steep if more are dry."""
    width = 0.55 + 0.09 * size.dry
    front = 1.0 / (1.0 + np.exp((index + 0.5 - size.lost - size.dry) / width))
    return front * min(2.0 * size.dry, 1.0)


def _strip(dry: float, rng: np.random.Generator) -> int:
    pick = int(rng.integers(_FRESH_STRIPS))
    nearest = int(np.argmin(np.abs(np.array(STRIP_DRYNESS) - dry)))
    return pick if nearest < _FRESH_STRIPS else nearest


def _posture(shape: Architecture, size: ShootSize, i: int, dry: float) -> tuple:
    """Mean insertion, curvature and extra fold of leaf i in degrees."""
    leaves, young = shape.leaves, shape.young_leaves
    if i >= size.collared:
        part = (i - size.collared + 1) / max(size.young, 1)
        lowest = young.insertion_deg + 0.35 * (leaves.insertion_angle_top_deg - young.insertion_deg)
        insertion = lowest + (young.insertion_deg - lowest) * part
        return (
            insertion,
            leaves.curvature_top_deg * young.curvature_factor * (1.0 - 0.6 * part),
            young.fold_extra_deg,
        )
    if i < size.lost:
        return leaves.hanging_deg, leaves.curvature_deg, leaves.dry_fold_deg * dry
    age = i / max(size.number - 1, 1)
    insertion = leaves.insertion_angle_deg + age * (
        leaves.insertion_angle_top_deg - leaves.insertion_angle_deg
    )
    curvature = leaves.curvature_deg + age * (leaves.curvature_top_deg - leaves.curvature_deg)
    return insertion + leaves.dry_droop_deg * dry, curvature, leaves.dry_fold_deg * dry


def _blade(
    shape: Architecture,
    size: ShootSize,
    stalk: StalkPlan,
    i: int,
    azimuth: float,
    dry: float,
    extent: tuple,
    rng: np.random.Generator,
) -> Blade:
    leaves = shape.leaves
    tilt, bend, drift, roll, turn = rng.normal(0.0, 1.0, 5)
    buckled, buckle_at = rng.uniform() < leaves.buckle_probability, rng.uniform(*_BUCKLE_AT)
    azimuth += np.radians(leaves.azimuth_sd_deg) * turn
    phase, strip = rng.uniform(0.0, 2.0 * np.pi), _strip(dry, rng)
    insertion, curvature, fold = _posture(shape, size, i, dry)
    tilt_sd = leaves.hanging_sd_deg if i < size.lost else leaves.insertion_sd_deg
    s = stalk.collars_m[min(i, size.collared - 1)]
    clasp = 0.25 if i >= size.collared else 0.8  # young leaves stand inside the whorl
    origin = stalk.curve.points(np.array([s]))[0]
    outward = np.array([np.cos(azimuth), np.sin(azimuth), 0.0])
    insertion_rad = np.radians(max(insertion + tilt_sd * tilt, 1.0))
    # the leaf leans with the stalk it stands on
    insertion_rad += float(stalk.curve.direction(np.array([s]))[0] @ outward)
    insertion_rad = float(np.clip(insertion_rad, 0.01, MOST_DOWNWARD))
    curvature_rad = np.radians(max(curvature + leaves.curvature_sd_deg * bend, 0.0))
    length, width = extent
    return Blade(
        rank=i + 1,
        origin=origin + clasp * float(stalk.radius_m(s)) * outward,
        azimuth_rad=azimuth,
        azimuth_drift_rad=np.radians(leaves.azimuth_drift_sd_deg) * drift,
        insertion_rad=insertion_rad,
        curvature_rad=min(curvature_rad, MOST_DOWNWARD - insertion_rad),
        buckle_rad=np.radians(leaves.buckle_deg) if buckled and i < size.collared else 0.0,
        buckle_at=buckle_at,
        twist_rad=np.radians(leaves.twist_sd_deg) * roll,
        fold_extra_rad=np.radians(min(fold, 85.0 - leaves.fold_blade_deg)),
        length_m=length,
        width_m=width,
        wave_phase_rad=phase,
        dryness=dry,
        strip=strip,
        strips=len(STRIP_DRYNESS),
    )


def grow_shoot(
    shape: Architecture, size: ShootSize, curve: Curve, rng: np.random.Generator
) -> Shoot:
    """Grows a stalk along `curve` and its blades, from the foot upwards."""
    collars = ligule_heights(size.collared, shape.stalk.ligule_ratio, curve.length_m)
    stalk = StalkPlan(
        curve,
        tuple(collars),
        tuple(i >= size.lost - size.hanging for i in range(size.collared)),
        size.base_radius_m,
        size.top_radius_m,
        shape.stalk.node_swelling,
        shape.stalk.sheath_m,
    )
    emerged = size.collared + size.young
    lengths, widths = full_sizes(emerged, size.number, shape.leaves, rng)
    grown = np.concatenate(
        (np.ones(size.collared), young_fractions(size.young, shape.young_leaves))
    )
    dry = dryness(size, np.arange(emerged))
    azimuth = rng.uniform(0.0, 2.0 * np.pi)
    blades: List[Blade] = []
    for i in range(emerged):
        azimuth += np.radians(rng.normal(shape.phyllotaxy.mean_deg, shape.phyllotaxy.sd_deg))
        length = size.leaf_scale * lengths[i] * grown[i]
        width = size.leaf_scale * widths[i] * (0.35 + 0.65 * grown[i])
        blade = _blade(shape, size, stalk, i, azimuth, float(dry[i]), (length, width), rng)
        if i >= size.lost - size.hanging:
            blades.append(blade)
    return Shoot(stalk, tuple(blades), emerged)
