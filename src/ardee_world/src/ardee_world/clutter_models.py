# SPDX-License-Identifier: MIT
"""Model directories of weeds, stones and litter: one STL mesh each, with a colour; stones have a collision shape."""

import json
import zlib
from dataclasses import dataclass
from pathlib import Path
from typing import Callable

import numpy as np

from ardee_common.output import model_directory
from ardee_models.metadata import model_config
from ardee_models.plant.plant_metrics import METRICS_FILE
from ardee_world import clutter_shapes

# Class ids in segmentation, after those of crops
WEED, STONE, LITTER = 10, 11, 12
_STL = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_MESH = """<geometry>
          <mesh>
            <uri>model://{name}/meshes/{name}.stl</uri>
          </mesh>
        </geometry>"""
_MODEL = """<?xml version="1.0"?>
<sdf version="1.5">
  <model name="{name}">
    <static>true</static>
    <link name="link">
{collision}      <visual name="visual">
        {mesh}
        <material>
          <ambient>{colour} 1</ambient>
          <diffuse>{colour} 1</diffuse>
        </material>
      </visual>
    </link>
  </model>
</sdf>
"""
_COLLISION = """      <collision name="collision">
        {mesh}
      </collision>
"""


@dataclass(frozen=True)
class ClutterModel:
    """One model: its shape, its colour (red, green, blue in 0 to 1), and whether it has a collision shape."""

    kind: str
    label: int
    colour: tuple
    solid: bool
    shape: Callable[[np.random.Generator], np.ndarray]


def _stone(size_m: tuple, corners: int) -> Callable[[np.random.Generator], np.ndarray]:
    return lambda rng: clutter_shapes.stone(rng, size_m, corners)


MODELS = {
    "weed_rosette": ClutterModel("weed", WEED, (0.25, 0.45, 0.14), False, clutter_shapes.rosette),
    "weed_broadleaf": ClutterModel(
        "weed", WEED, (0.30, 0.42, 0.16), False, clutter_shapes.broadleaf
    ),
    "weed_grass": ClutterModel("weed", WEED, (0.38, 0.52, 0.20), False, clutter_shapes.grass_tuft),
    "stone_round": ClutterModel(
        "stone", STONE, (0.50, 0.48, 0.45), True, _stone((0.10, 0.08, 0.06), 90)
    ),
    "stone_flat": ClutterModel(
        "stone", STONE, (0.42, 0.40, 0.40), True, _stone((0.12, 0.09, 0.03), 60)
    ),
    "stone_sharp": ClutterModel(
        "stone", STONE, (0.55, 0.52, 0.46), True, _stone((0.09, 0.08, 0.06), 16)
    ),
    "litter_leaf": ClutterModel(
        "litter", LITTER, (0.70, 0.60, 0.38), False, clutter_shapes.dead_leaf
    ),
    "litter_stalk": ClutterModel(
        "litter", LITTER, (0.62, 0.52, 0.32), False, clutter_shapes.dead_stalk
    ),
}


def _stl_bytes(triangles: np.ndarray) -> bytes:
    """Bytes of a binary STL file."""
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    records = np.zeros(len(triangles), dtype=_STL)
    records["normal"], records["corners"] = normals / np.maximum(lengths, 1e-30), triangles
    return bytes(80) + np.uint32(len(triangles)).tobytes() + records.tobytes()


def write_clutter_model(name: str, parent: Path) -> Path:
    """Writes parent/name, replacing an earlier model of that name; the bytes are the same every time."""
    model = MODELS[name]
    triangles = model.shape(np.random.default_rng(zlib.crc32(name.encode())))
    span = np.ptp(triangles.reshape(-1, 3), axis=0)
    mesh = _MESH.format(name=name)
    text = _MODEL.format(
        name=name,
        mesh=mesh,
        collision=_COLLISION.format(mesh=mesh) if model.solid else "",
        colour=" ".join(map(str, model.colour)),
    )
    metrics = {
        "species": model.kind,
        "stage": "",
        "label": model.label,
        "height_m": round(float(triangles[..., 2].max()), 5),
        "stalk_radius_m": round(float(0.5 * span[:2].max()), 5),
        "triangles": len(triangles),
    }
    with model_directory(parent, name) as folder:
        (folder / "meshes").mkdir()
        (folder / "meshes" / f"{name}.stl").write_bytes(_stl_bytes(triangles))
        (folder / "model.sdf").write_text(text)
        (folder / "model.config").write_text(model_config(name, f"{model.kind}, procedural"))
        (folder / METRICS_FILE).write_text(json.dumps(metrics, indent=2) + "\n")
    return parent / name
