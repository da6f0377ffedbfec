# SPDX-License-Identifier: MIT
"""Writes a terrain as a Gazebo model directory: 16-bit grey image and SDF heightmap (thesis Listing A.23)."""

from pathlib import Path
from typing import Optional

import numpy as np
from PIL import Image

from ardee_common.output import check_name, model_directory
from ardee_models.metadata import model_config
from ardee_models.terrain.height_map import Terrain
from ardee_models.terrain.recipe import Look, Surface
from ardee_models.terrain.terrain_picture import shaded

_LEVELS = 65535
SURFACE = """        <surface>
          <friction>
            <ode>
              <mu>{mu:g}</mu>
              <mu2>{mu2:g}</mu2>
            </ode>
          </friction>
          <contact>
            <ode>
              <kp>{kp:.1f}</kp>
              <kd>{kd:.1f}</kd>
            </ode>
          </contact>
        </surface>
"""
# Share of a lidar's light, 905 nm, that dry soil sends back.
# 0.2 to 0.4: Stoner and Baumgardner 1981, Soil Science Society of America Journal 45:1161, from memory.
_REFLECTIVITY = 0.3
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
{surface}      </collision>
      <visual name="visual">
        <laser_retro>{reflectivity:g}</laser_retro>
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
              <size>{size:g}</size>
            </texture>
"""
_BLEND = """            <blend>
              <min_height>{low:g}</min_height>
              <fade_dist>{fade:g}</fade_dist>
            </blend>
"""


def quantise(terrain: Terrain) -> tuple:
    """Quantised terrain: 16-bit image, size z, and position z, with height = position + pixel / 65535 * size."""
    low, high = float(terrain.heights_m.min()), float(terrain.heights_m.max())
    span = round(high - low, 6)
    if span == 0.0:
        return np.zeros(terrain.heights_m.shape, np.uint16), 1.0, round(low, 6)
    pixels = np.rint((terrain.heights_m - low) / (high - low) * _LEVELS)
    return pixels.astype(np.uint16), span, round(low, 6)


def surface_xml(surface: Surface) -> str:
    """SDF text of a collision's friction and contact."""
    return SURFACE.format(**vars(surface))


def write_terrain(
    terrain: Terrain,
    friction_mu: float,
    name: str,
    image_stem: str,
    parent: Path,
    surface: Optional[Surface] = None,
    look: Look = Look(),
    description: str = "Field terrain, procedural heightmap",
) -> Path:
    """Writes parent/name, replacing an earlier model of that name; returns its path. `surface` overrides friction."""
    pixels, size_z, pos_z = quantise(terrain)
    relative = f"meshes/heightmaps/{check_name(image_stem)}.png"
    felt = surface or Surface(mu=friction_mu, mu2=friction_mu)
    blends = look.blends[: len(look.textures) - 1]
    sdf = _MODEL.format(
        uri=f"file://{name}/{relative}",
        size=f"{terrain.size_m:.9g} {terrain.size_m:.9g} {size_z:.9g}",
        pos=f"0 0 {pos_z:.9g}",
        surface=surface_xml(felt),
        reflectivity=_REFLECTIVITY,
        textures="".join(_TEXTURE.format(name=t, size=look.texture_size_m) for t in look.textures),
        blends="".join(_BLEND.format(low=b.min_height_m, fade=b.fade_m) for b in blends),
    )
    with model_directory(parent, name) as folder:
        (folder / relative).parent.mkdir(parents=True)
        Image.fromarray(pixels).save(folder / relative)
        (folder / "model.sdf").write_text(sdf)
        (folder / "model.config").write_text(model_config(name, description))
        shaded(terrain).save(folder / "map.png")
    return parent / name
