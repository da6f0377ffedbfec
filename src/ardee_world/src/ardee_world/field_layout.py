# SPDX-License-Identifier: MIT
"""The realised field as plain data, and its random draw."""

from dataclasses import dataclass
from typing import Dict, Optional, Tuple

import numpy as np

from ardee_common.errors import GeneratorError
from ardee_models.lookup import CropModel
from ardee_models.terrain.height_map import Ground
from ardee_world import variation
from ardee_world.clutter import KINDS, Items, draw_items
from ardee_world.curves import left_of
from ardee_world.field_config import FAR_M, FieldConfig
from ardee_world.plots import Plan, plan_centres
from ardee_world.stand import Gap, Lean, draw_gaps, draw_lean, roll_pitch_yaw
from ardee_world.streams import Streams

DECIMALS = 4  # decimals of lengths and angles in files
Pools = Dict[str, Tuple[CropModel, ...]]


@dataclass(frozen=True)
class Layout:
    """Plants that emerged, in the field's frame; arrays run over plants. `planned` keeps all places."""

    config: FieldConfig
    seed: int
    pool: Tuple[CropModel, ...]
    planned: Plan
    gaps: Tuple[Gap, ...]
    number: np.ndarray  # place of the plant in the plan; for the second plant of a double, plus the number of places
    index: np.ndarray  # index into `planned`
    position_m: np.ndarray  # (n, 3)
    angles_rad: np.ndarray  # (n, 3) roll, pitch, yaw
    lean: Lean
    model: np.ndarray  # index into `pool`
    scale: np.ndarray
    height_m: np.ndarray
    clutter: Tuple[Tuple[Items, np.ndarray], ...]  # items, and their height on the ground [m]

    @property
    def yaw_rad(self) -> np.ndarray:
        """Turn of the plants about the vertical."""
        return self.angles_rad[:, 2]

    def count(self) -> int:
        """Number of plants that emerged."""
        return len(self.index)


@dataclass(frozen=True)
class _Draw:
    """Plants that emerged of one seed at each place; arrays run over plants, `index` into the plan."""

    index: np.ndarray
    xy_m: np.ndarray
    yaw_rad: np.ndarray
    lean: Lean
    model: np.ndarray
    scale: np.ndarray
    height_m: np.ndarray


def to_world(xy_m: np.ndarray, world_pose: Tuple[float, float, float]) -> np.ndarray:
    """Transforms from the field's frame to the frame of the world that includes the field at `world_pose`."""
    x, y, yaw = world_pose
    c, s = np.cos(yaw), np.sin(yaw)
    return xy_m @ np.array([[c, s], [-s, c]]) + np.array([x, y])


def ground_heights(xy_m: np.ndarray, config: FieldConfig, terrain: Optional[Ground]) -> np.ndarray:
    """Height of the ground below places of the field, rounded as in the files; zero without a terrain."""
    if terrain is None or len(xy_m) == 0:
        return np.zeros(len(xy_m))
    world = to_world(np.round(xy_m, DECIMALS), config.world_pose)
    return terrain.height_at(world[:, 0], world[:, 1])


def _draw_plants(
    config: FieldConfig,
    pool: tuple,
    sown: np.ndarray,
    centres_m: np.ndarray,
    streams: Streams,
    prefix: str = "",
) -> _Draw:
    """The plants that come of one seed at each place where one was sown."""
    total = len(sown)
    low, high = config.emergence_min, config.emergence_max
    up = variation.emerged(total, low, high, streams.of(prefix + "emergence"))
    index = np.flatnonzero(up & sown)
    model = streams.of(prefix + "model").integers(0, len(pool), total)
    yaw = streams.of(prefix + "yaw").uniform(-np.pi, np.pi, total)
    own = np.array([m.height_m for m in pool])[model]
    short, tall = config.stalk_height_min_m, config.stalk_height_max_m
    target = variation.target_heights(total, short, tall, streams.of(prefix + "height"))
    stand = config.stand
    size = variation.sizes(
        total, stand.size_cv, stand.late_emergence, stand.late_size, streams.of(prefix + "size")
    )
    height = (own if target is None else target) * size
    lean = draw_lean(total, stand, streams, prefix).at(index)
    return _Draw(
        index,
        centres_m[index],
        yaw[index],
        lean,
        model[index],
        (height / own)[index],
        height[index],
    )


def _join(draws: Tuple[_Draw, ...], name: str) -> np.ndarray:
    return np.concatenate([getattr(draw, name) for draw in draws])


def _draw_clutter(
    config: FieldConfig, pools: Pools, plan: Plan, streams: Streams, terrain: Optional[Ground]
) -> tuple:
    drawn = [draw_items(k, config.clutter, pools.get(k, ()), plan, streams) for k in KINDS]
    return tuple((i, ground_heights(i.xy_m, config, terrain)) for i in drawn if i is not None)


def _check_within(places_m: np.ndarray) -> None:
    """Raises GeneratorError if a place of a plant is farther away than a world holds."""
    farthest = float(np.abs(places_m).max())
    if not farthest <= FAR_M:
        raise GeneratorError(
            f"plants: found one {farthest:g} m from the field's origin, expected at most {FAR_M:g} m"
        )


def check_plan(config: FieldConfig, seed: int, terrain: Ground) -> None:
    """Raises GeneratorError for a plan that generate() refuses, or of which plants stand beside the terrain."""
    plan = plan_centres(config.plots, config.shape)
    _check_within(plan.centres_m)
    draw_gaps(plan, config.stand, Streams(seed).of("gaps"))
    low, high = terrain.bounds_m()
    world = to_world(plan.centres_m, config.world_pose)[:, :2]
    beside = ((world < low) | (world > high)).any(axis=1)
    if beside.any():
        extent = f"x {low[0]:g} to {high[0]:g} m, y {low[1]:g} to {high[1]:g} m"
        raise GeneratorError(
            f"found {beside.sum()} of {len(world)} plants beside the terrain ({extent}), expected all on it"
        )


def generate(
    config: FieldConfig,
    pool: Tuple[CropModel, ...],
    seed: int,
    terrain: Optional[Ground] = None,
    centres: Optional[Plan] = None,
    clutter_pools: Optional[Pools] = None,
) -> Layout:
    """Draws a field. Each source of variation has its own stream, so that a change of one leaves the others alone."""
    config.validate()
    if not pool:
        raise GeneratorError("model pool: found none, expected at least one crop model")
    streams, stand = Streams(seed), config.stand
    plan = centres or plan_centres(config.plots, config.shape)
    total = len(plan.centres_m)
    offsets = variation.placement_offsets(total, config.covariance(), streams.of("placement"))
    centre = plan.centres_m + offsets[:, :1] * left_of(plan.along) - offsets[:, 1:] * plan.along
    gaps = draw_gaps(plan, stand, streams.of("gaps"))
    sown = np.ones(total, bool)
    for gap in gaps:
        sown[gap.places] = False
    draws = [_draw_plants(config, pool, sown, centre, streams)]
    if stand.doubles > 0.0:
        twice = sown & (streams.of("doubles").random(total) < stand.doubles)
        beside = centre + stand.double_spacing_m * plan.along
        draws.append(_draw_plants(config, pool, twice, beside, streams, "double_"))
    xy = _join(draws, "xy_m")
    _check_within(np.concatenate((plan.centres_m, xy)))
    lean = Lean(
        *(np.concatenate([getattr(d.lean, n) for d in draws]) for n in Lean.__annotations__)
    )
    return Layout(
        config=config,
        seed=seed,
        pool=pool,
        planned=plan,
        gaps=gaps,
        number=np.concatenate([draw.index + k * total for k, draw in enumerate(draws)]),
        index=_join(draws, "index"),
        position_m=np.column_stack((xy, ground_heights(xy, config, terrain))),
        angles_rad=roll_pitch_yaw(_join(draws, "yaw_rad"), lean),
        lean=lean,
        model=_join(draws, "model"),
        scale=_join(draws, "scale"),
        height_m=_join(draws, "height_m"),
        clutter=_draw_clutter(config, clutter_pools or {}, plan, streams, terrain),
    )
