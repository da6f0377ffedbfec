# SPDX-License-Identifier: MIT
"""Meshes the organs of a plan at a level of detail."""

from dataclasses import replace
from typing import List, Tuple

import numpy as np

from ardee_models.plant.detail import Detail
from ardee_models.plant.lathe import Lathe, lathe_mesh
from ardee_models.plant.leaf import WHOLE, Blade, blade_mesh
from ardee_models.plant.mesh import join
from ardee_models.plant.plan import Plan
from ardee_models.plant.plant import Mesh, Organ, Plant
from ardee_models.plant.species import CropParams, Leaves
from ardee_models.plant.stalk import stalk_mesh

_LEAF_GROUPS = (("LeavesBase", "leavesb"), ("LeavesMid", "leavesm"), ("LeavesTop", "leavest"))
_FEWEST_TORN = 3  # segments of a torn blade
_FEWEST_ABREAST = ((5, 16), (3, 4))  # columns of a blade, and segments it must then still get


def _bodies_mesh(bodies: Tuple[Lathe, ...], detail: Detail) -> Mesh:
    """Bodies as tubes; of minor bodies only every n-th, made thicker to fill the place of the others."""
    meshes, minor = [], 0
    thicker = np.sqrt(detail.minor_every)
    for body in bodies:
        if body.minor:
            minor += 1
            if (minor - 1) % detail.minor_every:
                continue
            body = replace(body, radii_m=tuple(thicker * r for r in body.radii_m))
        meshes.append(lathe_mesh(body, min(body.sides, detail.body_sides), detail.body_rings))
    return join(meshes)


def _grid(triangles: int, detail: Detail) -> Tuple[int, int]:
    """Columns and segments of a blade that may have the given number of triangles."""
    for columns, fewest in _FEWEST_ABREAST:
        segments = triangles // (2 * (columns - 1))
        if segments >= fewest:
            return columns, min(segments, detail.segments_max)
    return 2, int(np.clip(triangles // 2, detail.segments_min, detail.segments_max))


def _blade_mesh(blade: Blade, shape: Leaves, segments: int, columns: int) -> Mesh:
    """Mesh of a blade; a torn one has shorter columns, so that it takes no more triangles than a whole one."""
    tears = len(blade.shreds) - 1
    if tears:
        segments = max(segments * (columns - 1) // (columns - 1 + tears), _FEWEST_TORN)
    return blade_mesh(blade, shape, segments, columns)


def _leaf_organs(
    blades: Tuple[Blade, ...], shape: Leaves, triangles: int, detail: Detail
) -> List[Organ]:
    """Blades in three groups from the ground up, as the material may differ with height."""
    columns, segments = _grid(triangles // len(blades), detail)
    order = np.argsort([blade.origin[2] for blade in blades], kind="stable")
    if not detail.torn:
        blades = tuple(replace(blade, shreds=WHOLE) for blade in blades)
    organs = []
    for (name, visual), group in zip(_LEAF_GROUPS, np.array_split(order, 3)):
        meshes = [_blade_mesh(blades[i], shape, segments, columns) for i in group]
        if meshes:
            organs.append(Organ(name, visual, "leaves", join(meshes)))
    return organs


def assemble(params: CropParams, plan: Plan, detail: Detail) -> Plant:
    """One plant standing at the origin, base at z = 0."""
    stem = stalk_mesh(plan.main.stalk, detail.stalk_sides, detail.stalk_rings)
    organs = [Organ("Stem", "stem", "stem", stem)]
    if plan.tillers:
        tillers = [
            stalk_mesh(shoot.stalk, detail.tiller_sides, detail.stalk_rings)
            for shoot in plan.tillers
        ]
        organs.append(Organ("Tillers", "tillers", "stem", join(tillers)))
    heads = [
        Organ(name, name.lower(), name.lower(), _bodies_mesh(bodies, detail))
        for name, bodies in plan.bodies.items()
    ]
    used = sum(len(organ.mesh.triangles) for organ in organs + heads)
    blades = tuple(blade for shoot in (plan.main, *plan.tillers) for blade in shoot.blades)
    leaves = params.architecture.leaves
    organs += _leaf_organs(blades, leaves, max(detail.triangles - used, 0), detail)
    return Plant(params.species, params.stage_name, params.label, tuple(organs + heads))
