# SPDX-License-Identifier: MIT
"""Writes a Layout's ground truth: truth.csv (plants), clutter.csv, truth.json (these, configuration, rows, gaps)."""

import csv
import dataclasses
import io
import json
from typing import Dict, Iterator, List, Tuple

import numpy as np

from ardee_common.geodesy import to_degrees
from ardee_world.field_layout import Layout, to_world

Columns = Dict[str, list]


def _of_models(pool: tuple, attribute: str, model: np.ndarray) -> np.ndarray:
    return np.array([getattr(m, attribute) for m in pool])[model]


def _listed(columns: Dict[str, np.ndarray]) -> Columns:
    """Columns as lists, rounded as in the model file: 0.1 mm and 1e-4 rad."""
    return {
        name: (np.round(values, 4) + 0.0 if values.dtype.kind == "f" else values).tolist()
        for name, values in columns.items()
    }


def degrees(world: np.ndarray, origin_deg: Tuple[float, float]) -> Columns:
    """Columns of latitudes and longitudes of places in a world whose origin lies there."""
    found = np.round(to_degrees(world[:, 0], world[:, 1], origin_deg), 9)
    return {"latitude_deg": found[:, 0].tolist(), "longitude_deg": found[:, 1].tolist()}


def _degrees(layout: Layout, world: np.ndarray) -> Columns:
    config = layout.config
    if config.origin_latitude_deg is None:
        return {}
    return degrees(world, (config.origin_latitude_deg, config.origin_longitude_deg))


def plant_columns(layout: Layout) -> Columns:
    """Values by column name for the plants that emerged, in the field's frame and in the world."""
    world = to_world(layout.position_m[:, :2], layout.config.world_pose)
    plan, index, pool, model = layout.planned, layout.index, layout.pool, layout.model
    columns = {
        "id": layout.number,
        "plot": plan.plot[index],
        "row": plan.row[index],
        "place": plan.place[index],
        "species": _of_models(pool, "species", model),
        "stage": _of_models(pool, "stage", model),
        "model": _of_models(pool, "name", model),
        "label": _of_models(pool, "label", model),
        "x_m": layout.position_m[:, 0],
        "y_m": layout.position_m[:, 1],
        "z_m": layout.position_m[:, 2],
        "roll_rad": layout.angles_rad[:, 0],
        "pitch_rad": layout.angles_rad[:, 1],
        "yaw_rad": layout.angles_rad[:, 2],
        "tilt_rad": layout.lean.tilt_rad,
        "tilt_direction_rad": layout.lean.direction_rad,
        "scale": layout.scale,
        "height_m": layout.height_m,
        "stalk_diameter_m": 2.0 * _of_models(pool, "stalk_radius_m", model) * layout.scale,
        "world_x_m": world[:, 0],
        "world_y_m": world[:, 1],
    }
    return {**_listed(columns), **_degrees(layout, world)}


def clutter_columns(layout: Layout) -> Columns:
    """Values by column name for weeds, stones and litter; empty if there are none."""
    parts = []
    for items, heights in layout.clutter:
        world = to_world(items.xy_m, layout.config.world_pose)
        parts.append(
            {
                "kind": np.repeat(items.kind, len(heights)),
                "id": np.arange(len(heights)),
                "model": _of_models(items.pool, "name", items.model),
                "label": _of_models(items.pool, "label", items.model),
                "x_m": items.xy_m[:, 0],
                "y_m": items.xy_m[:, 1],
                "z_m": heights,
                "yaw_rad": items.yaw_rad,
                "scale": items.scale,
                "height_m": _of_models(items.pool, "height_m", items.model) * items.scale,
                "world_x_m": world[:, 0],
                "world_y_m": world[:, 1],
            }
        )
    return _listed({n: np.concatenate([p[n] for p in parts]) for n in parts[0]}) if parts else {}


def csv_text(columns: Columns) -> Iterator[str]:
    """Lines of a CSV file; texts with a comma stand in quotes."""
    yield ",".join(columns) + "\n"
    for values in zip(*columns.values()):
        line = io.StringIO()
        csv.writer(line, lineterminator="\n").writerow(values)
        yield line.getvalue()


def _rows(layout: Layout) -> List[dict]:
    """Ideal row lines, from the first place to the end of the row."""
    made = []
    for row in layout.planned.rows:
        line = (np.round(row.line_m, 4) + 0.0).tolist()
        world = np.round(to_world(row.line_m, layout.config.world_pose), 4) + 0.0
        made.append(
            {
                "plot": row.plot,
                "row": row.row,
                "start_m": line[0],
                "end_m": line[-1],
                "line_m": line,
                "world_line_m": world.tolist(),
            }
        )
    return made


def _gaps(layout: Layout) -> List[dict]:
    plan = layout.planned
    return [
        {
            "plot": int(plan.plot[gap.places[0]]),
            "row": int(plan.row[gap.places[0]]),
            "first_place": int(plan.place[gap.places[0]]),
            "places": len(gap.places),
        }
        for gap in layout.gaps
    ]


def json_text(layout: Layout, columns: Columns, clutter: Columns, name: str) -> str:
    """Text of truth.json."""
    truth = {
        "name": name,
        "seed": layout.seed,
        "frame": "field; positions of rows and plants, angles about its axes; world_*: where the world has them",
        "config": dataclasses.asdict(layout.config),
        "models": [dataclasses.asdict(model) for model in layout.pool],
        "planned": len(layout.planned.centres_m),
        "emerged": layout.count(),
        "rows": _rows(layout),
        "gaps": _gaps(layout),
        "plants": columns,
        "clutter": clutter,
    }
    return json.dumps(truth) + "\n"
