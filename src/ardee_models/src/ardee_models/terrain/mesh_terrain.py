# SPDX-License-Identifier: MIT
"""A 3D mesh as terrain (thesis Figure 4.11)."""

from pathlib import Path
from typing import Optional

import numpy as np

from ardee_common.errors import GeneratorError
from ardee_models.mesh_file import Say, read_pieces
from ardee_models.terrain.surface import MeshGround

_MAX_TRIANGLES = 5_000_000


def read_mesh(path: Path, up: str, scale: Optional[float], say: Say) -> MeshGround:
    """Reads the mesh, with its `up` axis upwards and `scale` metres a unit, and joins equal corners."""
    if scale is not None and not 1e-6 <= scale <= 1e6:
        raise GeneratorError(f"mesh scale: found {scale}, expected 1e-6 to 1e6")
    pieces = read_pieces(path, up, scale, say)
    corners = np.concatenate([p.vertices_m()[np.asarray(p.geometry.faces)] for p in pieces])
    if len(corners) > _MAX_TRIANGLES:
        raise GeneratorError(
            f"{path}: found {len(corners)} triangles, expected at most {_MAX_TRIANGLES}"
        )
    vertices, index = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    triangles = index.reshape(-1, 3)
    a, b, c = (triangles[:, k] for k in range(3))
    ground = MeshGround(vertices, triangles[(a != b) & (b != c) & (c != a)])
    if len(ground.triangles) == 0 or np.ptp(vertices[:, :2], axis=0).min() < 1e-3:
        raise GeneratorError(
            f"{path}: found no area seen from above, expected a surface that spans x and y"
        )
    return ground


def check_lies(ground: MeshGround, path: Path) -> None:
    """Raises GeneratorError for ground of which more is seen from a side than from above: it stands on its edge."""
    a, b, c = (ground.vertices_m[ground.triangles[:, k]] for k in range(3))
    areas_m2 = 0.5 * np.abs(np.cross(b - a, c - a)).sum(axis=0)
    if 2.0 * areas_m2[2] < areas_m2.max():
        raise GeneratorError(
            f"{path}: found {areas_m2[2]:.3g} m^2 seen from above and {areas_m2.max():.3g} m^2 from a side,"
            " expected ground that lies; --mesh-up says which axis of the file points up"
        )


def centred(ground: MeshGround) -> MeshGround:
    """The ground with the middle of its bounds at the origin, and with height zero there."""
    low, high = ground.vertices_m.min(axis=0), ground.vertices_m.max(axis=0)
    middle = 0.5 * (low + high)
    here = float(ground.height_at(middle[:1], middle[1:2])[0])
    shift = np.array([middle[0], middle[1], here])
    return MeshGround(ground.vertices_m - shift, ground.triangles)
