# SPDX-License-Identifier: MIT
"""Plant to COLLADA: z up, metres, one named node an organ, texture images by relative path."""

import datetime
from pathlib import Path

import collada
import numpy as np
from collada import asset, geometry, material, scene, source

from ardee_models.plant import Organ, Plant

_TIMELESS = datetime.datetime(
    2000, 1, 1
)  # COLLADA wants a date; the same one keeps the bytes the same
_DECIMALS = 5  # of a metre: 0.01 mm


def _flat(array: np.ndarray) -> np.ndarray:
    # adding zero turns -0.0 into 0.0
    return np.round(array, _DECIMALS).astype(np.float32).ravel() + np.float32(0.0)


def _material(doc: collada.Collada, organ: Organ, texture_path: str) -> material.Material:
    image = material.CImage(f"{organ.name}-image", texture_path)
    surface = material.Surface(f"{organ.name}-surface", image)
    sampler = material.Sampler2D(f"{organ.name}-sampler", surface)
    texture = material.Map(sampler, "UVSET0")
    effect = material.Effect(
        f"{organ.name}-effect",
        [surface, sampler],
        "lambert",
        diffuse=texture,
        ambient=(1.0, 1.0, 1.0, 1.0),
        double_sided=True,
    )
    result = material.Material(f"{organ.name}-material", f"{organ.name}-material", effect)
    doc.images.append(image)
    doc.effects.append(effect)
    doc.materials.append(result)
    return result


def _node(doc: collada.Collada, organ: Organ, texture_path: str) -> scene.Node:
    mesh = organ.mesh
    ids = {kind: f"{organ.name}-{kind}" for kind in ("positions", "normals", "texcoords")}
    sources = [
        source.FloatSource(ids["positions"], _flat(mesh.vertices), ("X", "Y", "Z")),
        source.FloatSource(ids["normals"], _flat(mesh.normals), ("X", "Y", "Z")),
        source.FloatSource(ids["texcoords"], _flat(mesh.texcoords), ("S", "T")),
    ]
    geom = geometry.Geometry(doc, f"{organ.name}-geometry", organ.name, sources)
    inputs = source.InputList()
    for offset, (semantic, kind) in enumerate(
        (("VERTEX", "positions"), ("NORMAL", "normals"), ("TEXCOORD", "texcoords"))
    ):
        inputs.addInput(offset, semantic, f"#{ids[kind]}", "0" if semantic == "TEXCOORD" else None)
    indices = np.repeat(mesh.triangles.ravel(), 3)
    geom.primitives.append(geom.createTriangleSet(indices, inputs, "material"))
    doc.geometries.append(geom)
    bound = scene.MaterialNode(
        "material", _material(doc, organ, texture_path), [("UVSET0", "TEXCOORD", "0")]
    )
    return scene.Node(organ.name, children=[scene.GeometryNode(geom, [bound])])


def write_collada(plant: Plant, path: Path, texture_names: dict) -> None:
    """Write meshes/<name>.dae; `texture_names` gives the image file in materials/textures of each organ texture."""
    doc = collada.Collada()
    doc.assetInfo.created = doc.assetInfo.modified = _TIMELESS
    doc.assetInfo.upaxis = asset.UP_AXIS.Z_UP
    doc.assetInfo.unitname, doc.assetInfo.unitmeter = "meter", 1.0
    nodes = [
        _node(doc, organ, f"../materials/textures/{texture_names[organ.texture]}")
        for organ in plant.organs
    ]
    whole = scene.Scene("scene", nodes)
    doc.scenes.append(whole)
    doc.scene = whole
    doc.write(str(path))
