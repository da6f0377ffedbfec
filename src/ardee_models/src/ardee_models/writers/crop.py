# SPDX-License-Identifier: MIT
"""Plant to Gazebo model directory: SDF, mesh, OGRE material script, textures, metrics."""

import json
from pathlib import Path
from typing import Dict

import numpy as np
from PIL import Image

from ardee_models.output import model_directory
from ardee_models.plant import Plant
from ardee_models.writers.collada_file import write_collada
from ardee_models.writers.metadata import model_config

METRICS_FILE = "metrics.json"

_VISUAL = """      <visual name="{visual}">
        <geometry>
          <mesh>
            <uri>model://{model}/meshes/{model}.dae</uri>
            <submesh>
              <name>{organ}</name>
            </submesh>
          </mesh>
        </geometry>
        <material>
          <script>
            <uri>model://{model}/materials/scripts</uri>
            <uri>model://{model}/materials/textures</uri>
            <name>{prefix}/{organ}</name>
          </script>
        </material>
      </visual>
"""
_MODEL = """<?xml version="1.0"?>
<sdf version="1.5">
  <model name="{model}">
    <static>true</static>
    <link name="link">
      <collision name="collision">
        <pose>0 0 {middle:.6f} 0 0 0</pose>
        <geometry>
          <cylinder>
            <radius>{radius:.5f}</radius>
            <length>{length:.5f}</length>
          </cylinder>
        </geometry>
        <max_contacts>10</max_contacts>
      </collision>
{visuals}    </link>
  </model>
</sdf>
"""
_MATERIAL = """material {prefix}/{organ}
{{
  technique
  {{
    pass
    {{
      alpha_rejection greater 128
      cull_hardware none
      cull_software none

      texture_unit
      {{
        texture {texture}
      }}
    }}
  }}
}}
"""


def _sdf(plant: Plant, model: str) -> str:
    visuals = "".join(
        _VISUAL.format(
            visual=organ.visual, model=model, organ=organ.name, prefix=plant.material_prefix
        )
        for organ in plant.organs
    )
    length = round(plant.stalk_height_m, 5)
    return _MODEL.format(
        model=model, middle=length / 2, radius=plant.stalk_radius_m, length=length, visuals=visuals
    )


def metrics(plant: Plant, seed: int) -> dict:
    """The figures a field generator or a test wants without reading the mesh."""
    low = np.min([organ.mesh.vertices.min(axis=0) for organ in plant.organs], axis=0)
    high = np.max([organ.mesh.vertices.max(axis=0) for organ in plant.organs], axis=0)
    return {
        "species": plant.species,
        "stage": plant.stage,
        "seed": seed,
        "label": plant.label,
        "height_m": round(plant.height_m(), 5),
        "stalk_height_m": round(plant.stalk_height_m, 5),
        "stalk_radius_m": round(plant.stalk_radius_m, 5),
        "leaf_count": plant.leaf_count,
        "leaf_area_m2": round(plant.leaf_area_m2(), 5),
        "triangles": plant.triangle_count(),
        "bounds_m": [[round(float(v), 5) for v in corner] for corner in (low, high)],
    }


def write_crop(
    plant: Plant, textures: Dict[str, np.ndarray], seed: int, name: str, parent: Path
) -> Path:
    """Write parent/name, replacing an earlier model of that name; returns its path."""
    names = {organ.texture: f"{name}_{organ.texture}.png" for organ in plant.organs}
    with model_directory(parent, name) as folder:
        for sub in ("meshes", "materials/scripts", "materials/textures"):
            (folder / sub).mkdir(parents=True)
        text = f"{plant.species} at stage {plant.stage}, procedural, seed {seed}"
        (folder / "model.config").write_text(model_config(name, text))
        (folder / "model.sdf").write_text(_sdf(plant, name))
        (folder / METRICS_FILE).write_text(json.dumps(metrics(plant, seed), indent=2) + "\n")
        script = "\n".join(
            _MATERIAL.format(
                prefix=plant.material_prefix, organ=organ.name, texture=names[organ.texture]
            )
            for organ in plant.organs
        )
        (folder / "materials/scripts" / f"{name}.material").write_text(script)
        for key, file_name in names.items():
            Image.fromarray(textures[key]).save(
                folder / "materials/textures" / file_name, optimize=True
            )
        write_collada(plant, folder / "meshes" / f"{name}.dae", names)
    return parent / name
