# SPDX-License-Identifier: MIT
"""Writes meshes as COLLADA: z up, metres, one named node a part, texture images by relative path."""

import datetime
from pathlib import Path
from typing import Sequence, Tuple

import collada
import numpy as np
from collada import asset, geometry, material, scene, source

from ardee_models.plant.plant import Mesh

_TIMELESS = datetime.datetime(
    2000, 1, 1
)  # COLLADA requires a date; a fixed one keeps the bytes of a file the same
_DECIMALS = 5  # decimals of a metre: 0.01 mm
# rviz has no ambient light and lights one side of a leaf; the emission keeps the other side from being black
_GLOW = 0.35


def _flat(array: np.ndarray) -> np.ndarray:
    # adding zero turns -0.0 into 0.0
    return np.round(array, _DECIMALS).astype(np.float32).ravel() + np.float32(0.0)


def _material(doc: collada.Collada, name: str, texture_file: str) -> material.Material:
    parameters: list = []
    diffuse: object = (0.8, 0.8, 0.8, 1.0)
    if texture_file:
        image = material.CImage(f"{name}-image", f"../materials/textures/{texture_file}")
        surface = material.Surface(f"{name}-surface", image)
        sampler = material.Sampler2D(f"{name}-sampler", surface)
        parameters, diffuse = [surface, sampler], material.Map(sampler, "UVSET0")
        doc.images.append(image)
    effect = material.Effect(
        f"{name}-effect",
        parameters,
        "lambert",
        diffuse=diffuse,
        emission=(_GLOW, _GLOW, _GLOW, 1.0),
        ambient=(1.0, 1.0, 1.0, 1.0),
        double_sided=True,
    )
    result = material.Material(f"{name}-material", f"{name}-material", effect)
    doc.effects.append(effect)
    doc.materials.append(result)
    return result


def _node(doc: collada.Collada, name: str, mesh: Mesh, texture_file: str) -> scene.Node:
    ids = {kind: f"{name}-{kind}" for kind in ("positions", "normals", "texcoords")}
    sources = [
        source.FloatSource(ids["positions"], _flat(mesh.vertices), ("X", "Y", "Z")),
        source.FloatSource(ids["normals"], _flat(mesh.normals), ("X", "Y", "Z")),
        source.FloatSource(ids["texcoords"], _flat(mesh.texcoords), ("S", "T")),
    ]
    geom = geometry.Geometry(doc, f"{name}-geometry", name, sources)
    inputs = source.InputList()
    for offset, (semantic, kind) in enumerate(
        (("VERTEX", "positions"), ("NORMAL", "normals"), ("TEXCOORD", "texcoords"))
    ):
        inputs.addInput(offset, semantic, f"#{ids[kind]}", "0" if semantic == "TEXCOORD" else None)
    indices = np.repeat(mesh.triangles.ravel(), 3)
    geom.primitives.append(geom.createTriangleSet(indices, inputs, "material"))
    doc.geometries.append(geom)
    bound = scene.MaterialNode(
        "material", _material(doc, name, texture_file), [("UVSET0", "TEXCOORD", "0")]
    )
    return scene.Node(name, children=[scene.GeometryNode(geom, [bound])])


def write_collada(parts: Sequence[Tuple[str, Mesh, str]], path: Path) -> None:
    """Writes a .dae of (name, mesh, image file in materials/textures or "") parts."""
    doc = collada.Collada()
    doc.assetInfo.created = doc.assetInfo.modified = _TIMELESS
    doc.assetInfo.upaxis = asset.UP_AXIS.Z_UP
    doc.assetInfo.unitname, doc.assetInfo.unitmeter = "meter", 1.0
    nodes = [_node(doc, name, mesh, texture) for name, mesh, texture in parts]
    whole = scene.Scene("scene", nodes)
    doc.scenes.append(whole)
    doc.scene = whole
    doc.write(str(path))
