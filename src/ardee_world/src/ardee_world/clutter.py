# SPDX-License-Identifier: MIT
"""Weeds, stones and litter: Poisson scattered over the field's bounds, evenly or by an image."""

from dataclasses import dataclass
from pathlib import Path
from typing import Optional, Tuple

import numpy as np

from ardee_common.errors import GeneratorError
from ardee_models.lookup import CropModel
from ardee_models.plant.mesh import unit
from ardee_models.terrain.grey_image import read_grey
from ardee_world.curves import left_of
from ardee_world.field_config import Clutter
from ardee_world.plots import Plan
from ardee_world.streams import Streams

KINDS = ("weed", "stone", "litter")
# SD of the logarithm of an item's size over its model's (estimate); cut at two deviations.
_SIZE_LOG_SD = 0.25
MAX_ITEMS = 5_000_000
_TINY = 1e-9  # gives rows that run in a circle a direction


@dataclass(frozen=True)
class Items:
    """Items of one kind in the field's frame."""

    kind: str
    pool: Tuple[CropModel, ...]
    xy_m: np.ndarray
    yaw_rad: np.ndarray
    model: np.ndarray
    scale: np.ndarray


@dataclass(frozen=True)
class Bounds:
    """A rectangle in the field's frame."""

    low_m: np.ndarray
    high_m: np.ndarray

    def area_m2(self) -> float:
        """Area of the rectangle."""
        return float(np.prod(self.high_m - self.low_m))


def bounds_of(points_m: np.ndarray, margin_m: float) -> Bounds:
    """The rectangle round the planned centres."""
    return Bounds(points_m.min(axis=0) - margin_m, points_m.max(axis=0) + margin_m)


def _brightness(path: Optional[str]) -> Optional[np.ndarray]:
    """Brightness of an image's pixels: row 0 at the lower edge, 0 black to 1 white."""
    if path is None:
        return None
    image = read_grey(Path(path))
    share = image.pixels[::-1].astype(float) / image.white
    if not share.any():
        raise GeneratorError(f"{path}: found a black image, expected a brighter pixel somewhere")
    return share


def _scatter(
    count: int, bounds: Bounds, share: Optional[np.ndarray], streams: Streams, kind: str
) -> np.ndarray:
    """Draws places: uniform over the bounds, or in proportion to the brightness of the pixels."""
    spot = streams.of(kind, 1).random((count, 2))
    if share is not None:
        cumulative = np.cumsum(share.ravel())
        drawn = streams.of(kind, 2).random(count) * cumulative[-1]
        pixel = np.searchsorted(cumulative, drawn, side="right").clip(max=share.size - 1)
        corner = np.column_stack((pixel % share.shape[1], pixel // share.shape[1]))
        spot = (corner + spot) / np.array([share.shape[1], share.shape[0]])
    return bounds.low_m + spot * (bounds.high_m - bounds.low_m)


def _poisson(density: float, area_m2: float, what: str, rng: np.random.Generator) -> int:
    """Draws a number of items."""
    if density * area_m2 > MAX_ITEMS:
        raise GeneratorError(
            f"{what} density: found {density:g} 1/m^2 on {area_m2:.0f} m^2, expected at most {MAX_ITEMS} items"
        )
    return int(rng.poisson(density * area_m2))


def _beside_rows(config: Clutter, plan: Plan, streams: Streams) -> np.ndarray:
    """Draws places of the edges' weeds: in strips beside the outer rows; machines turn before the rows' ends."""
    against = plan.along @ plan.along[0] < 0.0  # a row may be listed from its other end
    along = np.where(against[:, None], -plan.along, plan.along)
    forwards = unit(along.sum(axis=0) + (0.0, _TINY))
    axes = np.stack((forwards, left_of(forwards)))
    rows = bounds_of(plan.centres_m @ axes.T, 0.0)
    (back, right), (front, left) = rows.low_m, rows.high_m
    area_m2 = 2.0 * config.clutter_margin_m * (front - back)
    rng = streams.of("edge_weed")
    spot = rng.random((_poisson(config.edge_weed_density_per_m2, area_m2, "edge weed", rng), 3))
    beyond = config.clutter_margin_m * spot[:, 1]
    across = np.where(spot[:, 2] < 0.5, right - beyond, left + beyond)
    return np.stack((back + (front - back) * spot[:, 0], across), axis=-1) @ axes


def has_items(kind: str, config: Clutter) -> bool:
    """Tells whether a field has items of a kind."""
    edge = config.edge_weed_density_per_m2 if kind == "weed" else 0.0
    return getattr(config, f"{kind}_density_per_m2") + edge > 0.0


def draw_items(
    kind: str, config: Clutter, pool: Tuple[CropModel, ...], plan: Plan, streams: Streams
) -> Optional[Items]:
    """Draws items of a kind; None if there are none. A higher density leaves the first items in place."""
    if not has_items(kind, config):
        return None
    density = getattr(config, f"{kind}_density_per_m2")
    bounds = bounds_of(plan.centres_m, config.clutter_margin_m)
    share = _brightness(getattr(config, f"{kind}_image"))
    area_m2 = bounds.area_m2() * (1.0 if share is None else float(share.mean()))
    inside = _poisson(density, area_m2, kind, streams.of(kind, 0))
    xy = _scatter(inside, bounds, share, streams, kind)
    if kind == "weed" and config.edge_weed_density_per_m2 > 0.0:
        xy = np.concatenate((xy, _beside_rows(config, plan, streams)))
    count = len(xy)
    sizes = streams.of(kind, 5).standard_normal(count).clip(-2.0, 2.0)
    return Items(
        kind=kind,
        pool=pool,
        xy_m=xy,
        yaw_rad=streams.of(kind, 3).uniform(-np.pi, np.pi, count),
        model=streams.of(kind, 4).integers(0, len(pool), count),
        scale=np.exp(_SIZE_LOG_SD * sizes),
    )
