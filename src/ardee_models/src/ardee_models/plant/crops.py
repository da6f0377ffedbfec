# SPDX-License-Identifier: MIT
"""Makes a plant, its textures and its model directory from species, stage and seed."""

from dataclasses import dataclass
from pathlib import Path
from typing import Dict, Optional, Tuple

import numpy as np

from ardee_common.output import check_name
from ardee_models.plant.crop_files import write_crop
from ardee_models.plant.cylinder import Cylinder, fit_cylinder
from ardee_models.plant.detail import LEVELS
from ardee_models.plant.organ_meshes import assemble
from ardee_models.plant.plan import Plan, grow
from ardee_models.plant.plant import Plant
from ardee_models.plant.plant_metrics import measure
from ardee_models.plant.plant_textures import plant_textures
from ardee_models.plant.species import CropParams, load_params


@dataclass(frozen=True)
class Crop:
    """A generated crop, before it is written."""

    params: CropParams
    plan: Plan
    levels: Tuple[Plant, ...]
    cylinder: Cylinder
    metrics: Dict[str, object]
    textures: Dict[str, np.ndarray]


def generate_crop(params: CropParams, seed: int) -> Crop:
    """Generates a crop. Geometry and textures have separate random streams, so that one does not change the other."""
    geometry_seed, texture_seed = np.random.SeedSequence(seed).spawn(2)
    plan = grow(params, np.random.default_rng(geometry_seed))
    levels = tuple(assemble(params, plan, detail) for detail in LEVELS)
    cylinder = fit_cylinder(levels[0].organ("Stem").mesh.vertices)
    metrics = measure(params, plan, levels, cylinder, seed)
    textures = plant_textures(params, plan, np.random.default_rng(texture_seed))
    return Crop(params, plan, levels, cylinder, metrics, textures)


def make_crop(
    species: str, stage: str, seed: int, name: str, parent: Path, params_file: Optional[Path] = None
) -> Path:
    """Generates one crop model directory parent/name."""
    check_name(name)
    crop = generate_crop(load_params(species, stage, params_file), seed)
    return write_crop(crop.levels, crop.cylinder, crop.textures, crop.metrics, name, parent)
