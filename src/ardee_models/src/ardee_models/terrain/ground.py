# SPDX-License-Identifier: MIT
"""The ground of a terrain's model directory (heightmap, mesh or plane), on which plants stand."""

from dataclasses import dataclass
from pathlib import Path
from typing import Sequence, Tuple

import numpy as np

from ardee_common.errors import GeneratorError
from ardee_models.lookup import find_model, numbers, resource, sdf_root, terrain_model
from ardee_models.terrain.height_map import Ground
from ardee_models.terrain.mesh_terrain import read_mesh
from ardee_models.terrain.surface import MeshGround


@dataclass(frozen=True)
class LevelGround:
    """A plane."""

    def height_at(self, x_m: np.ndarray, y_m: np.ndarray) -> np.ndarray:
        """Zero everywhere."""
        return np.zeros(np.broadcast(x_m, y_m).shape)

    def bounds_m(self) -> Tuple[np.ndarray, np.ndarray]:
        """A plane has no end."""
        return np.full(2, -np.inf), np.full(2, np.inf)


def is_ground(model: Path) -> bool:
    """Tells whether a model's directory holds ground: a heightmap, mesh or plane that it collides with."""
    geometries = sdf_root(model).iterfind(".//collision/geometry/*")
    return any(geometry.tag in ("heightmap", "mesh", "plane") for geometry in geometries)


def ground_model(name: str, folders: Sequence[Path]) -> Ground:
    """The first heightmap, mesh or plane that the model collides with."""
    model = find_model(name, folders)
    root = sdf_root(model)
    if root.find(".//collision/geometry/heightmap") is not None:
        return terrain_model(name, folders)
    mesh = root.find(".//collision/geometry/mesh")
    if mesh is not None:
        path = resource(mesh.findtext("uri", "").strip(), [model.parent, *folders])
        scale = numbers(mesh, "scale", 3, model) if mesh.find("scale") is not None else 1.0
        # the simulator turns no axis up, whatever the file says
        ground = read_mesh(path, "z", None, lambda text: None)
        return MeshGround(ground.vertices_m * scale, ground.triangles)
    if root.find(".//collision/geometry/plane") is not None:
        return LevelGround()
    raise GeneratorError(f"{model}/model.sdf: no <heightmap>, <mesh> or <plane> in a collision")
