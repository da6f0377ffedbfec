# SPDX-License-Identifier: MIT
"""Writes the ground of a recipe as the model that the recipe's form asks for."""

from pathlib import Path

import numpy as np

from ardee_models.terrain.features import follow
from ardee_models.terrain.height_map import Terrain
from ardee_models.terrain.recipe import Recipe
from ardee_models.terrain.surface import MeshGround
from ardee_models.terrain.terrain_model import write_terrain
from ardee_models.terrain.terrain_obj import write_mesh_terrain


def mesh_of(terrain: Terrain) -> MeshGround:
    """Returns the surface of a grid: two triangles a cell, divided as `Terrain.height_at` divides it."""
    count = len(terrain.heights_m)
    axis = np.linspace(-0.5, 0.5, count) * terrain.size_m
    x, y = np.meshgrid(axis, -axis)
    vertices = np.column_stack((x.ravel(), y.ravel(), terrain.heights_m.ravel()))
    above = np.arange(count * count).reshape(count, count)[:-1, :-1].ravel()  # corner at -x +y
    below = above + count
    right = np.column_stack((below, below + 1, above + 1))
    left = np.column_stack((below, above + 1, above))
    return MeshGround(vertices, np.concatenate((right, left)))


def write_recipe(recipe: Recipe, name: str, image_name: str, parent: Path) -> Path:
    """Writes parent/name, replacing an earlier model of that name; returns its path."""
    terrain = follow(recipe)
    if recipe.form == "mesh":
        return write_mesh_terrain(mesh_of(terrain), recipe.surface, name, parent)
    mu = recipe.surface.mu
    return write_terrain(terrain, mu, name, image_name, parent, recipe.surface, recipe.look)
