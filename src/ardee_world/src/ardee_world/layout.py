# SPDX-License-Identifier: MIT
"""The realised field as plain data, and how it is drawn."""

from dataclasses import dataclass
from typing import Optional, Tuple

import numpy as np

from ardee_models.errors import GeneratorError
from ardee_models.lookup import CropModel
from ardee_models.terrain import Terrain
from ardee_world import noise
from ardee_world.config import FieldConfig
from ardee_world.plots import Plan, plan_centres


@dataclass(frozen=True)
class Layout:
    """Plants that emerged, in the field's frame; arrays run over plants. `planned` keeps all places."""

    config: FieldConfig
    seed: int
    pool: Tuple[CropModel, ...]
    planned: Plan
    index: np.ndarray  # into `planned`
    position_m: np.ndarray  # (n, 3)
    yaw_rad: np.ndarray
    model: np.ndarray  # into `pool`
    scale: np.ndarray
    height_m: np.ndarray

    def count(self) -> int:
        """Plants that emerged."""
        return len(self.index)


def to_world(xy_m: np.ndarray, world_pose: Tuple[float, float, float]) -> np.ndarray:
    """Field frame to the frame of the world that includes the field at `world_pose`."""
    x, y, yaw = world_pose
    c, s = np.cos(yaw), np.sin(yaw)
    return xy_m @ np.array([[c, s], [-s, c]]) + np.array([x, y])


def generate(
    config: FieldConfig,
    pool: Tuple[CropModel, ...],
    seed: int,
    terrain: Optional[Terrain] = None,
    centres: Optional[Plan] = None,
) -> Layout:
    """Draw a field. Streams: placement, emergence, model, yaw, height, so that changing one leaves the others."""
    config.validate()
    if not pool:
        raise GeneratorError("model pool: found none, expected at least one crop model")
    streams = [np.random.default_rng(s) for s in np.random.SeedSequence(seed).spawn(5)]
    plan = centres or plan_centres(config.plots)
    total = len(plan.centres_m)
    centre = plan.centres_m + noise.placement_offsets(total, config.covariance(), streams[0])
    index = np.flatnonzero(
        noise.emerged(total, config.emergence_min, config.emergence_max, streams[1])
    )
    model = streams[2].integers(0, len(pool), total)
    yaw = streams[3].uniform(-np.pi, np.pi, total)
    own = np.array([m.height_m for m in pool])[model]
    target = noise.target_heights(
        total, config.stalk_height_min_m, config.stalk_height_max_m, streams[4]
    )
    height = own if target is None else target
    xy = centre[index]
    z = np.zeros(len(index))
    if terrain is not None:
        world = to_world(xy, config.world_pose)
        z = terrain.height_at(world[:, 0], world[:, 1])
    return Layout(
        config=config,
        seed=seed,
        pool=pool,
        planned=plan,
        index=index,
        position_m=np.column_stack((xy, z)),
        yaw_rad=yaw[index],
        model=model[index],
        scale=(height / own)[index],
        height_m=height[index],
    )
