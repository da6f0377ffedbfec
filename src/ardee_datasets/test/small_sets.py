# SPDX-License-Identifier: MIT
"""Small data sets of the tests."""

import json
from pathlib import Path

import numpy as np
from PIL import Image

from ardee_datasets.generate_dataset import main

RECIPE = """
seed: 3
fields:
  corn:
    fields: 2
    frames: 2
    options: {models: [corn_variant_1], row_length_m: 3.0, weed_density_per_m2: 2.0}
    ranges: {row_spacing_m: [0.7, 0.8]}
  late:
    split: test
    frames: 1
    options: {models: [corn_variant_7], row_length_m: 3.0}
cameras:
  front: {width_px: 96, height_px: 72, horizontal_fov_deg: 70, height_m: [0.4, 0.6], pitch_deg: [10, 30]}
lidars:
  top: {sensor: vlp16, above_m: 0.2}
"""


# One that drives past the plants on its side, under a shutter that lets them lean by some ten pixels
MOVING = """
fields:
  corn: {frames: 4, options: {models: [corn_variant_1], row_length_m: 3.0}}
cameras:
  side:
    {width_px: 96, height_px: 72, horizontal_fov_deg: 70, height_m: [0.4, 0.6], pitch_deg: [30, 40], yaw_deg: [85, 95],
     speed_m_s: [2, 3], exposure_time_s: 0.01, readout_time_s: 0.06}
"""
DRIVEN = """
fields:
  corn: {frames: 3, options: {models: [corn_variant_1], row_length_m: 3.0, weed_density_per_m2: 1.0}}
robots:
  terra: {robot: tsv3_default, cameras: [%s], speed_m_s: [0.9, 0.9], offset_m: [0.05, 0.05]}
"""


def pixels(path: Path) -> np.ndarray:
    return np.asarray(Image.open(path))


def samples(made: Path) -> list:
    return [json.loads(path.read_text()) for path in sorted(made.glob("*/samples/*.json"))]


def generated(folder: Path, recipe: str) -> Path:
    """Writes the data set of a recipe; returns its folder."""
    folder.mkdir(exist_ok=True)
    (folder / "recipe.yaml").write_text(recipe)
    assert (
        main([str(folder / "recipe.yaml"), "--output", str(folder / "set"), "--workers", "1"]) == 0
    )
    return folder / "set"
