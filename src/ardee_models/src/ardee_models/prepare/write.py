# SPDX-License-Identifier: MIT
"""Writes a user's plants as Gazebo model directories, all of them or none."""

import contextlib
from pathlib import Path
from typing import Dict, List, Optional, Sequence

import numpy as np
from PIL import Image

from ardee_common.errors import GeneratorError
from ardee_common.output import check_name, model_directory
from ardee_models.collada_file import write_collada
from ardee_models.plant.crop_files import write_metrics, write_text_files
from ardee_models.plant.crop_sdf import Visual
from ardee_models.plant.cylinder import Cylinder, fit_cylinder, fit_stalk_among_leaves
from ardee_models.plant.plant import Mesh
from ardee_models.prepare.read import UserPart
from ardee_models.prepare.split import plant_of_vertices

_STEM_NAMES = ("stem", "stalk", "trunk")
_STALK_RADIUS_PART = 0.01  # first guess of a stalk's radius over the plant's height


def _select(part: UserPart, keep: np.ndarray) -> Optional[UserPart]:
    """The triangles of a part whose vertices are kept, or None."""
    triangles = part.mesh.triangles[keep[part.mesh.triangles[:, 0]]]
    if not len(triangles):
        return None
    used, compact = np.unique(triangles, return_inverse=True)
    mesh = part.mesh
    cut = Mesh(
        mesh.vertices[used], mesh.normals[used], mesh.texcoords[used], compact.reshape(-1, 3)
    )
    return UserPart(part.name, cut, part.image, part.colour)


def split_plants(parts: Sequence[UserPart], gap_m: float) -> List[List[UserPart]]:
    """Lists of parts, one for each plant."""
    offsets = np.cumsum([0] + [len(part.mesh.vertices) for part in parts])
    vertices = np.concatenate([part.mesh.vertices for part in parts])
    triangles = np.concatenate([p.mesh.triangles + o for p, o in zip(parts, offsets)])
    plant = plant_of_vertices(vertices, triangles, gap_m)
    plants = []
    for number in range(int(plant.max()) + 1):
        pieces = [
            _select(part, plant[low:high] == number)
            for part, low, high in zip(parts, offsets, offsets[1:])
        ]
        plants.append([piece for piece in pieces if piece is not None])
    return plants


def fit(parts: Sequence[UserPart], stem: Optional[str]) -> Cylinder:
    """Fits the stalk's cylinder: to the part called `stem`, else to one with a stalk's name, else by search."""
    vertices = np.concatenate([part.mesh.vertices for part in parts])
    if stem is not None:
        chosen = [part for part in parts if part.name == stem]
        if not chosen:
            known = ", ".join(part.name for part in parts)
            raise GeneratorError(f"--stem {stem}: found no such part, the mesh has {known}")
    else:
        chosen = [p for p in parts if any(word in p.name.lower() for word in _STEM_NAMES)]
        if len(chosen) == len(parts):  # named after the file, say: leaves are among them
            chosen = []
    if chosen:
        return fit_cylinder(np.concatenate([part.mesh.vertices for part in chosen]))
    return fit_stalk_among_leaves(vertices, _STALK_RADIUS_PART * float(np.ptp(vertices[:, 2])))


def stand_at_origin(parts: Sequence[UserPart], stem: Optional[str]) -> tuple:
    """Moves parts and cylinder so that the lowest vertex is at z = 0 and the stalk's foot at x = y = 0."""
    cylinder = fit(parts, stem)
    foot = cylinder.centre - 0.5 * cylinder.length_m * cylinder.axis
    low = min(float(part.mesh.vertices[:, 2].min()) for part in parts)
    shift = np.array([foot[0], foot[1], low])
    moved = [
        UserPart(
            p.name,
            Mesh(p.mesh.vertices - shift, p.mesh.normals, p.mesh.texcoords, p.mesh.triangles),
            p.image,
            p.colour,
        )
        for p in parts
    ]
    centre = cylinder.centre - shift
    return moved, Cylinder(centre, cylinder.axis, cylinder.radius_m, cylinder.length_m)


def _metrics(parts: Sequence[UserPart], cylinder: Cylinder, facts: Dict[str, object]) -> dict:
    vertices = np.concatenate([part.mesh.vertices for part in parts])
    bounds = [[round(float(v), 5) for v in f(vertices, axis=0)] for f in (np.min, np.max)]
    return {
        **facts,
        "height_m": bounds[1][2],
        "stalk_height_m": round(cylinder.length_m, 5),
        "stalk_radius_m": round(cylinder.radius_m, 5),
        "stalk_diameter_m": round(2.0 * cylinder.radius_m, 5),
        "lateral_extent_m": round(float(np.linalg.norm(vertices[:, :2], axis=1).max()), 5),
        "triangles": sum(len(part.mesh.triangles) for part in parts),
        "bounds_m": bounds,
    }


def _write_textures(folder: Path, name: str, parts: Sequence[UserPart]) -> Dict[str, str]:
    """Writes each image once as PNG; returns the file name of each part."""
    files: Dict[str, str] = {}
    written: Dict[int, str] = {}
    for part in parts:
        if part.image is None:
            files[part.name] = ""
            continue
        key = id(part.image)
        if key not in written:
            written[key] = f"{name}_{part.name}.png"
            image: Image.Image = part.image
            if image.mode not in ("RGB", "RGBA", "L"):
                image = image.convert("RGBA")
            image.save(folder / "materials" / "textures" / written[key])
        files[part.name] = written[key]
    return files


def _write_model(
    folder: Path, name: str, parts: Sequence[UserPart], cylinder: Cylinder, facts: Dict[str, object]
) -> None:
    (folder / "materials" / "textures").mkdir(parents=True)
    files = _write_textures(folder, name, parts)
    visuals = [
        Visual(part.name.lower(), part.name, files[part.name], f"meshes/{name}.dae", part.colour)
        for part in parts
    ]
    text = f"Crop model prepared from {facts['source']}"
    write_text_files(folder, name, text, visuals, cylinder)
    write_metrics(folder, _metrics(parts, cylinder, facts))
    triples = [(part.name, part.mesh, files[part.name]) for part in parts]
    write_collada(triples, folder / "meshes" / f"{name}.dae")


def write_plants(
    plants: Sequence[Sequence[UserPart]],
    name: str,
    parent: Path,
    stem: Optional[str],
    facts: Dict[str, object],
) -> List[Path]:
    """Writes parent/name, or parent/name_1 ... if there are several plants."""
    check_name(name)
    single = len(plants) == 1
    names = [name if single else f"{name}_{i + 1}" for i in range(len(plants))]
    standing = [stand_at_origin(parts, stem) for parts in plants]
    # folders get their final names after the last is written, so that an error leaves none
    with contextlib.ExitStack() as stack:
        folders = [stack.enter_context(model_directory(parent, each)) for each in names]
        for folder, each, (parts, cylinder) in zip(folders, names, standing):
            _write_model(folder, each, parts, cylinder, facts)
    return [parent / each for each in names]
