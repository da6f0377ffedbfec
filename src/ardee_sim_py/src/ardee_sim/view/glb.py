# SPDX-License-Identifier: MIT
"""Writes pieces as binary glTF, which browsers show, with their textures inside."""

import warnings
from functools import lru_cache
from pathlib import Path
from typing import Any, Dict, List, Optional, Sequence

import numpy as np
from ardee_sim.view.shapes import Piece
from PIL import Image

from ardee_models.mesh_file import load_trimesh

_MOST_PX = 512  # width and height of a texture in the page


@lru_cache(maxsize=256)
def _texture(path: str, changed_ns: int) -> Optional[Image.Image]:
    """Returns a texture as it was changed last, no larger than the page needs; None if it cannot be read."""
    try:
        with Image.open(path) as opened:
            picture = opened.convert("RGBA")
    except (OSError, ValueError) as error:
        warnings.warn(f"{path}: {error}; shown without it", stacklevel=1)
        return None
    picture.thumbnail((_MOST_PX, _MOST_PX))
    return picture if picture.getextrema()[3][0] < 255 else picture.convert("RGB")


def _look(material: Dict[str, Any]) -> Any:
    """Returns trimesh's material."""
    rgba = np.asarray(material["rgba"], float)
    path = material["texture"]
    changed_ns = Path(path).stat().st_mtime_ns if Path(path).is_file() else 0
    texture = _texture(path, changed_ns) if path else None
    rejection = material["alpha_rejection"]
    is_holed = rgba[3] >= 1 and rejection >= 0 and texture is not None
    return load_trimesh().visual.material.PBRMaterial(
        baseColorFactor=[*rgba[:3] ** 2.2, rgba[3]],  # files have sRGB, glTF has light
        emissiveFactor=np.clip(material["emissive"], 0, 1) ** 2.2,
        metallicFactor=0.0,
        roughnessFactor=1.0,
        baseColorTexture=texture,
        doubleSided=material["two_sided"],
        alphaMode="BLEND" if rgba[3] < 1 else "MASK" if is_holed else None,
        alphaCutoff=rejection if is_holed else None,
    )


def _joined(pieces: Sequence[Piece]) -> List[Piece]:
    """Returns the pieces with those of equal materials as one."""
    groups: Dict[str, List[Piece]] = {}
    for piece in pieces:
        if len(piece.triangles):
            key = repr((piece.material, piece.normals is None, len(piece.texcoords) > 0))
            groups.setdefault(key, []).append(piece)
    joined = []
    for group in groups.values():
        starts = np.cumsum([0] + [len(piece.vertices_m) for piece in group[:-1]])
        triangles = [piece.triangles + start for piece, start in zip(group, starts)]
        normals = [piece.normals for piece in group if piece.normals is not None]
        joined.append(
            Piece(
                np.concatenate([piece.vertices_m for piece in group]),
                np.concatenate(triangles).astype(np.uint32),
                group[0].material,
                np.concatenate([piece.texcoords for piece in group]),
                np.concatenate(normals) if normals else None,
            )
        )
    return joined


def write_glb(pieces: Sequence[Piece]) -> bytes:
    """Returns a binary glTF file of the pieces, in their own axes; empty if there is nothing to show."""
    trimesh = load_trimesh()
    meshes = [
        trimesh.Trimesh(
            piece.vertices_m,
            piece.triangles,
            vertex_normals=piece.normals,
            visual=trimesh.visual.TextureVisuals(
                uv=piece.texcoords if len(piece.texcoords) else None, material=_look(piece.material)
            ),
            process=False,
        )
        for piece in _joined(pieces)
    ]
    return trimesh.Scene(meshes).export(file_type="glb") if meshes else b""
