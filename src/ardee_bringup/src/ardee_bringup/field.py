# SPDX-License-Identifier: MIT
"""Generates the demo's field, which replaces the one in farm.world, and finds the robot's start in it."""
import json
import math
import os
import pathlib
from dataclasses import dataclass
from typing import Any, Callable, Dict, List

import numpy as np

from ardee_common.ros_graph import RosGraph
from ardee_models.lookup import search_path, terrain_model

MODEL = "small-corn-stalk-plot"  # name of the field's model in farm.world
TERRAIN = "heightmap_ground"
ROWS, STALKS_PER_ROW = 4, 50
SHORTEST_M, TALLEST_M = 0.35, 1.1  # seedlings would be scaled up to the field's mean
BEFORE_THE_ROW_M = 0.8
RIDE_HEIGHT_M = 0.175  # base_footprint above the ground
HALF_TRACK_M = 0.22  # greatest distance of the wheels from the robot's middle, along x and y


@dataclass(frozen=True)
class Start:
    """Pose between two rows, before their first plants, looking along them; and the distance to drive."""

    x_m: float
    y_m: float
    z_m: float
    yaw_rad: float
    distance_m: float


def young_corn() -> List[str]:
    """Returns names of the corn models on the model path that a picture from behind the robot shows from above."""
    folders = os.environ.get("GAZEBO_MODEL_PATH", "").split(os.pathsep)
    metrics = [p for f in folders if f for p in pathlib.Path(f).glob("corn_variant_*/metrics.json")]
    heights = {p.parent.name: json.loads(p.read_text())["height_m"] for p in metrics}
    found = {name for name, height in heights.items() if SHORTEST_M < height < TALLEST_M}
    if not found:
        raise RuntimeError(f"no young corn_variant_* on GAZEBO_MODEL_PATH: {folders}")
    return sorted(found)


def generate(
    graph: RosGraph, folder: pathlib.Path, seed: int, say: Callable[[str], None]
) -> Dict[str, Any]:
    """Generates the field into a folder of models; returns its ground truth."""
    folder.mkdir()
    models = young_corn()
    command = ["rosrun", "ardee_world", "generate_field", "--name", MODEL, "--seed", str(seed)]
    command += [
        "--rows-per-plot",
        str(ROWS),
        "--stalks-per-row",
        str(STALKS_PER_ROW),
        "--terrain",
        TERRAIN,
    ]
    say(" ".join(command) + " ...")
    graph.run(*command, "--output", str(folder), "--models", *models)
    truth = json.loads((folder / MODEL / "truth.json").read_text())
    say(f"{truth['emerged']} plants of {len(models)} shapes in {ROWS} rows")
    return truth


def start_of_a_row(truth: Dict[str, Any]) -> Start:
    """Returns the start before the middle two rows of the field, in the world frame."""
    left, right = truth["rows"][ROWS // 2 - 1], truth["rows"][ROWS // 2]
    x = (left["start_m"][0] + right["start_m"][0]) / 2
    first_y, last_y = left["start_m"][1], left["end_m"][1]
    along = math.copysign(1.0, last_y - first_y)
    y = first_y - along * BEFORE_THE_ROW_M
    field_x, field_y, field_yaw = truth["config"]["world_pose"]
    c, s = math.cos(field_yaw), math.sin(field_yaw)
    world_x, world_y = field_x + c * x - s * y, field_y + s * x + c * y
    around = np.array([-HALF_TRACK_M, 0.0, HALF_TRACK_M])
    ground = terrain_model(TERRAIN, search_path()).height_at(
        world_x + around[:, None], world_y + around[None, :]
    )
    return Start(
        x_m=world_x,
        y_m=world_y,
        z_m=float(ground.max()) + RIDE_HEIGHT_M,
        yaw_rad=field_yaw + along * math.pi / 2,
        distance_m=abs(last_y - first_y) + BEFORE_THE_ROW_M,
    )
