# SPDX-License-Identifier: MIT
"""Terrain to Gazebo model directory: 16-bit grey image and SDF heightmap."""

from pathlib import Path

import numpy as np
from PIL import Image

from ardee_models.output import model_directory
from ardee_models.terrain import Terrain
from ardee_models.writers.metadata import model_config

_LEVELS = 65535
_MODEL = """<?xml version="1.0"?>
<sdf version="1.5">
  <model name="heightmap">
    <static>true</static>
    <link name="link">
      <collision name="collision">
        <geometry>
          <heightmap>
            <uri>{uri}</uri>
            <size>{size}</size>
            <pos>{pos}</pos>
          </heightmap>
        </geometry>
        <surface>
          <friction>
            <ode>
              <mu>{mu:g}</mu>
              <mu2>{mu:g}</mu2>
            </ode>
          </friction>
          <contact>
            <ode>
              <kp>100000.0</kp>
              <kd>10000.0</kd>
            </ode>
          </contact>
        </surface>
      </collision>
      <visual name="visual">
        <geometry>
          <heightmap>
            <use_terrain_paging>false</use_terrain_paging>
{textures}{blends}            <uri>{uri}</uri>
            <size>{size}</size>
            <pos>{pos}</pos>
          </heightmap>
        </geometry>
      </visual>
    </link>
  </model>
</sdf>
"""
_TEXTURE = """            <texture>
              <diffuse>file://media/materials/textures/{name}_diffusespecular.png</diffuse>
              <normal>file://media/materials/textures/flat_normal.png</normal>
              <size>1</size>
            </texture>
"""
_BLEND = """            <blend>
              <min_height>0.5</min_height>
              <fade_dist>1</fade_dist>
            </blend>
"""


def quantise(terrain: Terrain) -> tuple:
    """16-bit image, size z and position z with height = position + pixel / 65535 * size."""
    low, high = float(terrain.heights_m.min()), float(terrain.heights_m.max())
    span = round(high - low, 6)
    if span == 0.0:
        return np.zeros(terrain.heights_m.shape, np.uint16), 1.0, round(low, 6)
    pixels = np.rint((terrain.heights_m - low) / (high - low) * _LEVELS)
    return pixels.astype(np.uint16), span, round(low, 6)


def write_terrain(
    terrain: Terrain, friction_mu: float, name: str, image_stem: str, parent: Path
) -> Path:
    """Write parent/name, replacing an earlier model of that name; returns its path."""
    pixels, size_z, pos_z = quantise(terrain)
    relative = f"meshes/heightmaps/{image_stem}.png"
    sdf = _MODEL.format(
        uri=f"file://{name}/{relative}",
        size=f"{terrain.size_m:g} {terrain.size_m:g} {size_z:g}",
        pos=f"0 0 {pos_z:g}",
        mu=friction_mu,
        textures="".join(_TEXTURE.format(name=t) for t in ("dirt", "grass", "fungus")),
        blends=_BLEND * 2,
    )
    with model_directory(parent, name) as folder:
        (folder / relative).parent.mkdir(parents=True)
        Image.fromarray(pixels).save(folder / relative)
        (folder / "model.sdf").write_text(sdf)
        (folder / "model.config").write_text(
            model_config(name, "Field terrain, procedural heightmap")
        )
    return parent / name
