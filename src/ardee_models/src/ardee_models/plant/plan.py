# SPDX-License-Identifier: MIT
"""A plant before it is meshed: shoots and organs as curves and sizes, the same for every level of detail."""

from dataclasses import dataclass
from typing import Dict, List, Tuple

import numpy as np

from ardee_models.plant import corn_organs, sorghum_head, tobacco_head
from ardee_models.plant.curve import Curve
from ardee_models.plant.lathe import Lathe
from ardee_models.plant.shoot import Shoot, ShootSize, grow_shoot, main_size
from ardee_models.plant.species import Architecture, CropParams
from ardee_models.plant.wear import worn

_HEAD_FROM = 0.1  # an inflorescence less grown than this is hidden in the whorl


@dataclass(frozen=True)
class Plan:
    """The main stem, its tillers, and the organs that are bodies of revolution, by name."""

    main: Shoot
    tillers: Tuple[Shoot, ...]
    bodies: Dict[str, Tuple[Lathe, ...]]


def _main_curve(shape: Architecture, height_m: float, rng: np.random.Generator) -> Curve:
    lean = abs(np.radians(shape.stalk.lean_sd_deg) * rng.normal())
    return Curve(np.zeros(3), rng.uniform(0.0, 2.0 * np.pi), lean, lean, height_m)


def _tillers(
    params: CropParams, main: ShootSize, rng: np.random.Generator
) -> List[Tuple[Shoot, float]]:
    """Tillers, each with its size over the main stem's."""
    shape, habit = params.architecture, params.architecture.tillers
    if habit is None or params.stage.tillers <= 0.0:
        return []
    count = int(np.floor(params.stage.tillers + rng.uniform()))
    turn = rng.uniform(0.0, 2.0 * np.pi)
    grown = []
    for _ in range(count):
        turn += np.radians(rng.normal(137.5, 20.0))
        scale = float(np.clip(rng.normal(habit.size_mean, habit.size_sd), 0.3, 1.0))
        collared = max(main.collared - habit.fewer_leaves, 1)
        lost = min(max(main.lost - 2, 0), collared - 1)
        size = ShootSize(
            number=max(main.number - habit.fewer_leaves, collared + main.young),
            collared=collared,
            young=main.young,
            lost=lost,
            dry=main.dry,
            maturity=main.maturity,
            height_m=main.height_m * scale,
            base_radius_m=main.base_radius_m * 0.75 * scale,
            top_radius_m=main.top_radius_m * scale,
            leaf_scale=scale * main.leaf_scale,
            hanging=min(main.hanging, lost),
        )
        outward = np.array([np.cos(turn), np.sin(turn), 0.0])
        curve = Curve(
            1.1 * main.base_radius_m * outward,
            turn,
            np.radians(habit.angle_deg),
            np.radians(habit.angle_top_deg),
            size.height_m,
            bend_m=0.3 * size.height_m,
        )
        grown.append((grow_shoot(shape, size, curve, rng), scale))
    return grown


def _bodies(
    params: CropParams, main: Shoot, tillers: list, rng: np.random.Generator
) -> Dict[str, Tuple[Lathe, ...]]:
    shape, stage = params.architecture, params.stage
    growth, maturity = stage.inflorescence, stage.maturity
    bodies: Dict[str, List[Lathe]] = {}
    if shape.tassel and growth > _HEAD_FROM:
        bodies["Tassel"] = corn_organs.tassel(main, shape.tassel, growth, rng)
    if shape.ears and stage.ears > 0.0:
        bodies["Ears"] = corn_organs.ears(main, shape.ears, stage.ears, maturity, rng)
    if shape.panicle and growth > _HEAD_FROM:
        bodies["Panicle"] = sorghum_head.panicle(main, shape.panicle, growth, 1.0, rng)
        for shoot, scale in tillers:
            bodies["Panicle"] += sorghum_head.panicle(shoot, shape.panicle, growth, scale, rng)
    if shape.flowers and growth > _HEAD_FROM:
        bodies["Flowers"] = tobacco_head.flowers(main, shape.flowers, growth, maturity, rng)
    if shape.brace_roots and main.stalk.curve.length_m > 1.0:
        bodies["Roots"] = corn_organs.brace_roots(main, shape.brace_roots, rng)
    return {name: tuple(parts) for name, parts in bodies.items() if parts}


def grow(params: CropParams, rng: np.random.Generator) -> Plan:
    """Grows one plant with its foot at the origin."""
    shape = params.architecture
    size = main_size(shape, params.stage, rng)
    main = grow_shoot(shape, size, _main_curve(shape, size.height_m, rng), rng)
    tillers = _tillers(params, size, rng)
    bodies = _bodies(params, main, tillers, rng)
    # wear comes last, so that it changes nothing else of a plant
    main, *others = (worn(s, shape, rng) for s in (main, *(shoot for shoot, _ in tillers)))
    return Plan(main, tuple(others), bodies)
