# SPDX-License-Identifier: MIT
"""Writes a plant's Gazebo model directory: SDF, meshes by level of detail, OGRE material script, textures, metrics."""

import json
from pathlib import Path
from typing import Dict, Sequence, Tuple

import numpy as np
from PIL import Image

from ardee_common.output import model_directory
from ardee_models.collada_file import write_collada
from ardee_models.metadata import model_config
from ardee_models.plant.crop_sdf import Visual, material_script, model_sdf
from ardee_models.plant.cylinder import Cylinder
from ardee_models.plant.detail import LEVELS
from ardee_models.plant.plant import Plant
from ardee_models.plant.plant_metrics import METRICS_FILE


def write_text_files(
    folder: Path, name: str, description: str, visuals: Sequence[Visual], cylinder: Cylinder
) -> None:
    """Writes model.config, model.sdf and the material script, and makes the folders of meshes and textures."""
    for sub in ("meshes", "materials/scripts", "materials/textures"):
        (folder / sub).mkdir(parents=True, exist_ok=True)
    (folder / "model.config").write_text(model_config(name, description))
    (folder / "model.sdf").write_text(model_sdf(name, visuals, cylinder))
    script = folder / "materials" / "scripts" / f"{name}.material"
    script.write_text(material_script(name, visuals))


def write_metrics(folder: Path, metrics: Dict[str, object]) -> None:
    """Writes metrics.json, which field generators read instead of the mesh."""
    (folder / METRICS_FILE).write_text(json.dumps(metrics, indent=2) + "\n")


def write_crop(
    levels: Tuple[Plant, ...],
    cylinder: Cylinder,
    textures: Dict[str, np.ndarray],
    metrics: Dict[str, object],
    name: str,
    parent: Path,
) -> Path:
    """Writes parent/name, replacing an earlier model of that name; returns its path."""
    plant = levels[0]
    files = {organ.texture: f"{name}_{organ.texture}.png" for organ in plant.organs}
    visuals = [
        Visual(organ.visual, organ.name, files[organ.texture], f"meshes/{name}.dae")
        for organ in plant.organs
    ]
    text = f"{plant.species} at stage {plant.stage}, procedural, seed {metrics['seed']}"
    with model_directory(parent, name) as folder:
        write_text_files(folder, name, text, visuals, cylinder)
        write_metrics(folder, metrics)
        for key, file_name in files.items():
            image = Image.fromarray(textures[key])
            image.save(folder / "materials/textures" / file_name, compress_level=5)
        for level, detail in zip(levels, LEVELS):
            parts = [(organ.name, organ.mesh, files[organ.texture]) for organ in level.organs]
            write_collada(parts, folder / "meshes" / f"{name}{detail.suffix}.dae")
    return parent / name
