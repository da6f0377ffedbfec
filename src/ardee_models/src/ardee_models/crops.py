# SPDX-License-Identifier: MIT
"""From species, stage and seed to a plant and its textures."""

from pathlib import Path
from typing import Optional

import numpy as np

from ardee_models import grass
from ardee_models.params import load_params
from ardee_models.textures import plant_textures
from ardee_models.writers.crop import write_crop


def make_crop(
    species: str, stage: str, seed: int, name: str, parent: Path, params_file: Optional[Path] = None
) -> Path:
    """Generate one crop model directory parent/name; geometry and textures draw from streams of their own."""
    params = load_params(species, stage, params_file)
    geometry_seed, texture_seed = np.random.SeedSequence(seed).spawn(2)
    plant = grass.generate(params, np.random.default_rng(geometry_seed))
    textures = plant_textures(plant.senescence, np.random.default_rng(texture_seed))
    return write_crop(plant, textures, seed, name, parent)
