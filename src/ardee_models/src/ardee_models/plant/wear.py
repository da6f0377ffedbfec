# SPDX-License-Identifier: MIT
"""Wear of a grown plant: dead blades that roll up and lose their tips, sheaths that peel, green blades that break."""

from dataclasses import replace
from typing import List

import numpy as np

from ardee_models.plant.leaf import MOST_DOWNWARD, Blade
from ardee_models.plant.organ_params import Wear
from ardee_models.plant.plan import Plan
from ardee_models.plant.shoot import Shoot
from ardee_models.plant.species import CropParams, Leaves

_DEAD = 0.6  # a blade drier than this
_WITHERED = 0.9  # and a sheath whose blade is drier than this
_LOWEST = 4  # green leaves that break: those that the wind in a lane and what drives there reach (estimate)
_PEELED_WIDTH = 0.5  # width of a peeled sheath, half open, over the stalk's girth (estimate)
_PEELED_FOLD = np.radians(35.0)  # elevation of its halves, besides a blade's own (estimate)
_SHEATH_KEPT = (
    0.8  # of a blade's outline, which a sheath has up to where it is narrower than a sheath
)


def _shrivelled(blade: Blade, shape: Wear, leaves: Leaves, draws: np.ndarray) -> Blade:
    """A dead blade: narrower, rolled along its midrib, perhaps without its tip."""
    dead = (blade.dryness - _DEAD) / (1.0 - _DEAD)
    roll = np.radians(shape.roll_deg + shape.roll_sd_deg * draws[0]) * dead
    most = np.radians(85.0 - leaves.fold_blade_deg)
    lost = draws[1] < shape.tip_loss
    return replace(
        blade,
        shrunk=1.0 - (1.0 - shape.dead_width) * dead,
        fold_extra_rad=float(np.clip(roll, blade.fold_extra_rad, most)),
        kept=1.0 - (1.0 - shape.kept_min) * draws[2] if lost else 1.0,
    )


def _broken(blade: Blade, shape: Wear, leaves: Leaves, draws: np.ndarray) -> Blade:
    """A green blade whose midrib has broken: what is beyond hangs."""
    at = shape.break_at_min + (shape.break_at_max - shape.break_at_min) * draws[2]
    before = blade.insertion_rad + blade.curvature_rad * at**leaves.curvature_power
    hangs = min(np.radians(leaves.hanging_deg + leaves.hanging_sd_deg * draws[0]), MOST_DOWNWARD)
    return replace(blade, buckle_at=at, buckle_rad=max(hangs - before, blade.buckle_rad))


def _peeled(shoot: Shoot, blade: Blade, shape: Wear, turn_rad: float) -> tuple:
    """A sheath turned away from its node by an angle, and its blade, which hangs from the sheath's end."""
    collars, index = shoot.stalk.collars_m, blade.rank - 1
    node_m = collars[index - 1] if index else 0.0
    length_m = collars[index] - node_m
    foot = shoot.stalk.curve.points(np.array([node_m]))[0]
    outward = np.array([np.cos(blade.azimuth_rad), np.sin(blade.azimuth_rad), 0.0])
    radius_m = float(shoot.stalk.radius_m(node_m))
    sheath = replace(
        blade,
        origin=foot + radius_m * outward,
        azimuth_drift_rad=0.0,
        insertion_rad=turn_rad,
        curvature_rad=0.0,
        buckle_rad=0.0,
        twist_rad=0.0,
        fold_extra_rad=_PEELED_FOLD,
        length_m=length_m / _SHEATH_KEPT,
        width_m=_PEELED_WIDTH * 2.0 * np.pi * radius_m,
        kept=_SHEATH_KEPT,
        shrunk=1.0,
    )
    end = sheath.origin + length_m * (
        np.sin(turn_rad) * outward + np.array([0.0, 0.0, np.cos(turn_rad)])
    )
    return sheath, replace(blade, origin=end)


def _worn(params: CropParams, shape: Wear, shoot: Shoot, rng: np.random.Generator) -> Shoot:
    leaves, grown = params.architecture.leaves, len(shoot.stalk.collars_m)
    green = [b.rank for b in shoot.blades if b.dryness <= _DEAD and b.rank <= grown]
    breakable, sheathed = set(green[:_LOWEST]), list(shoot.stalk.sheathed)
    blades: List[Blade] = []
    sheaths: List[Blade] = []
    for blade in shoot.blades:
        draws = np.concatenate((rng.normal(size=1), rng.random(4), rng.normal(size=1)))
        if blade.dryness > _DEAD:
            blade = _shrivelled(blade, shape, leaves, draws)
        elif blade.rank in breakable and draws[1] < params.stage.broken_leaves / _LOWEST:
            blade = _broken(blade, shape, leaves, draws)
        if blade.dryness > _WITHERED and blade.rank <= grown and draws[3] < shape.peel:
            turn_rad = np.radians(shape.peel_deg) * abs(draws[5])
            sheath, blade = _peeled(shoot, blade, shape, min(turn_rad, 0.5 * np.pi))
            sheaths.append(sheath)
            sheathed[blade.rank - 1] = False
        blades.append(blade)
    stalk = replace(shoot.stalk, sheathed=tuple(sheathed))
    return replace(shoot, stalk=stalk, blades=tuple(blades), sheaths=tuple(sheaths))


def wear(params: CropParams, plan: Plan, rng: np.random.Generator) -> Plan:
    """Wears a plant's leaves; those of a species without wear stay as they are."""
    shape = params.architecture.wear
    if shape is None:
        return plan
    main, *tillers = (_worn(params, shape, shoot, rng) for shoot in (plan.main, *plan.tillers))
    return replace(plan, main=main, tillers=tuple(tillers))
