# SPDX-License-Identifier: MIT
"""Makes fields for measurements: the shipped farm world with more or fewer plants, on ground of the same grain."""
import math
import os
import pathlib
import subprocess
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from typing import Dict, List

import numpy as np

from ardee_models.lookup import search_path, terrain_model

ROW_SPACING_M, STALK_SPACING_M = 0.762, 0.166  # the field generator's defaults, passed on
LEAST_STALKS_PER_ROW = 50
HEADLAND_M = 1.0
GROUND_STEP_M = 30.0 / 256  # distance of heights, as in the shipped heightmap_ground
GROUND_MARGIN_M = 6.0  # around the field
GROUND_SAMPLES = [2**n + 1 for n in range(8, 13)]  # sizes that the terrain generator accepts
RIDE_HEIGHT_M = 0.175  # base_footprint of the robot above the ground
HALF_LENGTH_M = 0.25  # half the robot's length: the ground under it counts
INSIDE_M = 1.0  # from the row's end to where the robot turns back
LONGEST_LANE_M = 30.0  # a robot that errs by 0.001 rad stays in the lane so far


@dataclass(frozen=True)
class Field:
    """Generated world, and the lane in its middle."""

    plants: int
    rows: int
    world: pathlib.Path
    env: Dict[str, str]  # environment of the programs that load it
    start: List[float]  # x y z yaw of the robot at the lane's start [m m m rad]
    lane_m: float


def rows_of(plants: int) -> int:
    """Returns the number of rows of an about square field: even, so that a lane is in the middle; rather long rows."""
    ideal = math.sqrt(plants * STALK_SPACING_M / ROW_SPACING_M)
    fitting = [n for n in range(4, plants + 1, 2) if plants // n >= LEAST_STALKS_PER_ROW]
    whole = [n for n in fitting if plants % n == 0] or fitting or [2]
    return min(whole, key=lambda n: abs(n - ideal))


def _generate(env: Dict[str, str], *command: str) -> None:
    done = subprocess.run(
        ["rosrun", *command], env=env, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    )
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(command[:2])}: {done.stdout}")


def _write_world(template: pathlib.Path, pose: List[float], world: pathlib.Path) -> None:
    """Writes the template with this ground and field in place of its own."""
    tree = ElementTree.parse(template)
    for include in tree.iter("include"):
        uri = include.find("uri")
        if uri is None or uri.text is None:
            raise RuntimeError(f"{template}: found an <include> without <uri>")
        if "ground" in uri.text:
            uri.text = "model://benchmark_ground"
        else:
            uri.text = "model://benchmark_field"
            include.find("pose").text = f"{pose[0]} {pose[1]} 0 0 0 {pose[2]}"
    tree.write(world)


def generate(plants: int, folder: pathlib.Path, farm_world: pathlib.Path, seed: int = 0) -> Field:
    """Writes ground, field and world into a new folder."""
    folder.mkdir()
    rows = rows_of(plants)
    stalks = max(1, plants // rows)
    length_m = (stalks - 1) * STALK_SPACING_M
    extent_m = max(length_m + 2 * HEADLAND_M, rows * ROW_SPACING_M) + 2 * GROUND_MARGIN_M
    samples = next((n for n in GROUND_SAMPLES if (n - 1) * GROUND_STEP_M >= extent_m), None)
    if samples is None:
        raise RuntimeError(f"{plants} plants: more than the largest ground holds")
    env = dict(os.environ)
    env["GAZEBO_MODEL_PATH"] = f"{folder}:{env.get('GAZEBO_MODEL_PATH', '')}"
    output = ["--output", str(folder), "--seed", str(seed)]
    size = ["--samples", str(samples), "--size-m", str((samples - 1) * GROUND_STEP_M)]
    _generate(env, "ardee_models", "generate_terrain", "--name", "benchmark_ground", *size, *output)
    # Rows run along -y of the field's frame, so along -x of the world: the field's middle lies on the origin.
    pose = [length_m / 2 + HEADLAND_M, 0.0, -math.pi / 2]
    plan = [
        "--rows-per-plot",
        str(rows),
        "--stalks-per-row",
        str(stalks),
        "--headland-m",
        str(HEADLAND_M),
    ]
    plan += ["--row-spacing-m", str(ROW_SPACING_M), "--stalk-spacing-m", str(STALK_SPACING_M)]
    plan += ["--emergence-min", "1", "--emergence-max", "1", "--terrain", "benchmark_ground"]
    plan += ["--world-pose", *(str(value) for value in pose)]
    models = sorted(
        p.parent.name for f in search_path() for p in f.glob("corn_variant_*/model.sdf")
    )
    if not models:
        raise RuntimeError("no model corn_variant_* on GAZEBO_MODEL_PATH")
    name = ["--name", "benchmark_field", "--models", *models]
    _generate(env, "ardee_world", "generate_field", *name, *plan, *output)
    world = folder / "benchmark.world"
    _write_world(farm_world, pose, world)
    half_lane_m = length_m / 2 - INSIDE_M
    around = np.linspace(-HALF_LENGTH_M, HALF_LENGTH_M, 9)
    ground = terrain_model("benchmark_ground", [folder]).height_at(
        half_lane_m + around[:, None], around[None, :]
    )
    start = [half_lane_m, 0.0, float(ground.max()) + RIDE_HEIGHT_M, math.pi]
    return Field(rows * stalks, rows, world, env, start, min(2 * half_lane_m, LONGEST_LANE_M))
