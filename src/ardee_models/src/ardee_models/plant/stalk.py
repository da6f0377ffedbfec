# SPDX-License-Identifier: MIT
"""The stem of a shoot: internodes, nodes, sheaths."""

from dataclasses import dataclass
from typing import Tuple

import numpy as np

from ardee_models.plant.curve import Curve
from ardee_models.plant.mesh import tube
from ardee_models.plant.plant import Mesh

_NODE_BAND = 0.14  # height of the swelling at a node over the internode's length (estimate)


@dataclass(frozen=True)
class StalkPlan:
    """A tapered stem; leaves part from it at arc lengths `collars_m`, `sheathed` tells which leaves still clasp it."""

    curve: Curve
    collars_m: Tuple[float, ...]
    sheathed: Tuple[bool, ...]
    base_radius_m: float
    top_radius_m: float
    node_swelling: float
    sheath_m: float

    def radius_m(self, s_m: np.ndarray) -> np.ndarray:
        """Radius of the bare stem: linear taper."""
        part = np.asarray(s_m) / self.curve.length_m
        return self.base_radius_m + (self.top_radius_m - self.base_radius_m) * part


def ligule_heights(count: int, ratio: float, height_m: float) -> np.ndarray:
    """Heights of collars 1..count, geometric: H (1 - q^i) / (1 - q^n) (ArchiCrop); equal spacing at q = 1."""
    i = np.arange(1, count + 1)
    if abs(ratio - 1.0) < 1e-9:
        return height_m * i / count
    return height_m * (1.0 - ratio**i) / (1.0 - ratio**count)


def _stations(stalk: StalkPlan) -> tuple:
    """Arc lengths of the rings, and the addition of each to the bare stem's radius."""
    s, added = [0.0], [0.0]
    low = 0.0
    for high, sheathed in zip(stalk.collars_m, stalk.sheathed):
        if sheathed and stalk.sheath_m > 0.0:  # widens to the collar, then the next internode
            s += [high - 0.02 * (high - low), high]
            added += [stalk.sheath_m, 0.0]
        elif stalk.node_swelling > 1.0:
            s += [high - _NODE_BAND * (high - low), high]
            added += [0.0, (stalk.node_swelling - 1.0) * float(stalk.radius_m(high))]
        else:
            s.append(high)
            added.append(0.0)
        low = high
    added[-1] = 0.0
    return np.array(s), np.array(added)


def stalk_mesh(stalk: StalkPlan, sides: int, rings: int) -> Mesh:
    """Open tube; with fewer `rings` than its features need, a plain taper."""
    s, added = _stations(stalk)
    if len(s) > rings:
        s = np.linspace(0.0, stalk.curve.length_m, rings)
        added = np.zeros(rings)
    points = stalk.curve.points(s)
    mesh = tube(points, stalk.radius_m(s) + added, stalk.curve.side(), sides)
    vertices = mesh.vertices.copy()
    vertices[: sides + 1, 2] = 0.0  # the foot is cut level with the ground
    return Mesh(vertices, mesh.normals, mesh.texcoords, mesh.triangles)
