# SPDX-License-Identifier: MIT
"""Writes mesh ground as a Gazebo model directory: one OBJ file, both visual and collision shape."""

from pathlib import Path

import numpy as np
from PIL import Image

from ardee_common.output import model_directory
from ardee_models.metadata import model_config
from ardee_models.terrain import ground_textures
from ardee_models.terrain.recipe import Surface
from ardee_models.terrain.surface import MeshGround
from ardee_models.terrain.terrain_model import surface_xml

_TEXTURE_SEED = 1
_MODEL = """<?xml version="1.0"?>
<sdf version="1.5">
  <model name="{name}">
    <static>true</static>
    <link name="link">
      <collision name="collision">
        <geometry>
          <mesh>
            <uri>model://{name}/meshes/{name}.obj</uri>
          </mesh>
        </geometry>
{surface}      </collision>
      <visual name="visual">
        <geometry>
          <mesh>
            <uri>model://{name}/meshes/{name}.obj</uri>
          </mesh>
        </geometry>
        <material>
          <script>
            <uri>model://{name}/materials/scripts</uri>
            <uri>model://{name}/materials/textures</uri>
            <name>Ground/{name}</name>
          </script>
        </material>
      </visual>
    </link>
  </model>
</sdf>
"""
_MATERIAL = """material Ground/{name}
{{
  technique
  {{
    pass
    {{
      cull_hardware none
      cull_software none
      texture_unit
      {{
        texture {name}.png
      }}
    }}
  }}
}}
"""


def _obj_text(ground: MeshGround, texture_size_m: float) -> str:
    """OBJ text: vertices, texture coordinates seen from above, smooth normals, triangles."""
    vertices, triangles = ground.vertices_m, ground.triangles
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    faces = np.cross(b - a, c - a)
    normals = np.zeros_like(vertices)
    for corner in range(3):
        np.add.at(normals, triangles[:, corner], faces)
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = np.where(lengths > 0.0, normals / np.maximum(lengths, 1e-30), (0.0, 0.0, 1.0))
    uv = vertices[:, :2] / texture_size_m
    lines = ["o ground"]
    lines += ["v %.6f %.6f %.6f" % tuple(v) for v in vertices.tolist()]
    lines += ["vt %.5f %.5f" % tuple(t) for t in uv.tolist()]
    lines += ["vn %.4f %.4f %.4f" % tuple(n) for n in normals.tolist()]
    lines += ["f " + " ".join(f"{i}/{i}/{i}" for i in f) for f in (triangles + 1).tolist()]
    return "\n".join(lines) + "\n"


def write_mesh_terrain(
    ground: MeshGround, surface: Surface, name: str, parent: Path, texture_size_m: float = 1.0
) -> Path:
    """Writes parent/name, replacing an earlier model of that name; returns its path."""
    with model_directory(parent, name) as folder:
        for sub in ("meshes", "materials/scripts", "materials/textures"):
            (folder / sub).mkdir(parents=True)
        (folder / "meshes" / f"{name}.obj").write_text(_obj_text(ground, texture_size_m))
        script = folder / "materials/scripts" / f"{name}.material"
        script.write_text(_MATERIAL.format(name=name))
        soil = ground_textures.dirt(np.random.default_rng(_TEXTURE_SEED))
        Image.fromarray(soil).save(folder / "materials/textures" / f"{name}.png", optimize=True)
        (folder / "model.sdf").write_text(_MODEL.format(name=name, surface=surface_xml(surface)))
        (folder / "model.config").write_text(model_config(name, "Field terrain, mesh"))
    return parent / name
