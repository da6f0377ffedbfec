# SPDX-License-Identifier: MIT
"""Layout to ground truth: truth.csv (plants), truth.json (configuration, rows, plants)."""

import dataclasses
import json
from typing import Dict, Iterator, List

import numpy as np

from ardee_world.geodesy import to_degrees
from ardee_world.layout import Layout, to_world
from ardee_world.plots import row_positions, row_starts


def plant_columns(layout: Layout) -> Dict[str, list]:
    """Column name to values: what became of each plant, in the field's frame and in the world."""
    world = to_world(layout.position_m[:, :2], layout.config.world_pose)
    plan, index = layout.planned, layout.index
    columns: Dict[str, np.ndarray] = {
        "id": index,
        "plot": plan.plot[index],
        "row": plan.row[index],
        "place": plan.place[index],
        "model": np.array([m.name for m in layout.pool])[layout.model],
        "x_m": np.round(layout.position_m[:, 0], 4),
        "y_m": np.round(layout.position_m[:, 1], 4),
        "z_m": np.round(layout.position_m[:, 2], 4),
        "yaw_rad": np.round(layout.yaw_rad, 4),
        "scale": np.round(layout.scale, 4),
        "height_m": np.round(layout.height_m, 4),
        "stalk_radius_m": np.round(
            np.array([m.stalk_radius_m for m in layout.pool])[layout.model] * layout.scale, 5
        ),
        "world_x_m": np.round(world[:, 0], 4),
        "world_y_m": np.round(world[:, 1], 4),
    }
    config = layout.config
    if config.origin_latitude_deg is not None:
        degrees = to_degrees(
            world[:, 0], world[:, 1], (config.origin_latitude_deg, config.origin_longitude_deg)
        )
        columns["latitude_deg"] = np.round(degrees[:, 0], 9)
        columns["longitude_deg"] = np.round(degrees[:, 1], 9)
    return {name: values.tolist() for name, values in columns.items()}


def csv_text(columns: Dict[str, list]) -> Iterator[str]:
    """Lines of truth.csv."""
    yield ",".join(columns) + "\n"
    for values in zip(*columns.values()):
        yield ",".join(map(str, values)) + "\n"


def _rows(layout: Layout) -> List[dict]:
    """Ideal row lines, from the first place to the end of the row."""
    plots = layout.config.plots
    starts, positions = row_starts(plots), row_positions(plots)
    return [
        {
            "plot": j * plots.plots_x + i,
            "row": row,
            "start_m": [round(float(x), 4), round(float(y), 4)],
            "end_m": [round(float(x), 4), round(float(y) - plots.row_length_m, 4)],
        }
        for j, y in enumerate(starts)
        for i in range(plots.plots_x)
        for row, x in enumerate(positions[i])
    ]


def json_text(layout: Layout, columns: Dict[str, list], name: str, from_file: bool) -> str:
    """Text of truth.json. The rows of a planting strategy of the user's own are not known: an empty list."""
    return (
        json.dumps(
            {
                "name": name,
                "seed": layout.seed,
                "frame": "field; rows run along -y, x across them",
                "config": dataclasses.asdict(layout.config),
                "models": [dataclasses.asdict(model) for model in layout.pool],
                "planned": len(layout.planned.centres_m),
                "emerged": layout.count(),
                "rows": [] if from_file else _rows(layout),
                "plants": columns,
            }
        )
        + "\n"
    )
