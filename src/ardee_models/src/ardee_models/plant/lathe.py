# SPDX-License-Identifier: MIT
"""Bodies of revolution round a curve: branches, ears, grains, flowers."""

from dataclasses import dataclass
from typing import Tuple

import numpy as np

from ardee_models.plant.curve import Curve
from ardee_models.plant.mesh import tube
from ardee_models.plant.plant import Mesh


@dataclass(frozen=True)
class Lathe:
    """Radii at relative stations 0..1 of a curve; `band` is the part of the texture's height it shows.

    A `minor` body is one of many alike: the coarse level of detail keeps some of them and makes those larger.
    """

    curve: Curve
    stations: Tuple[float, ...]
    radii_m: Tuple[float, ...]
    band: Tuple[float, float] = (0.0, 1.0)
    sides: int = 3
    minor: bool = False


def spindle(curve: Curve, radius_m: float, band: tuple, sides: int, minor: bool = False) -> Lathe:
    """A double cone that stands for an ellipsoid."""
    return Lathe(curve, (0.0, 0.42, 1.0), (0.0, radius_m, 0.0), band, sides, minor)


def lathe_mesh(lathe: Lathe, sides: int, stations: int) -> Mesh:
    """Open tube with at most `stations` rings; normals point away from the curve."""
    chosen = np.arange(len(lathe.stations))
    if len(chosen) > stations:
        chosen = np.unique(np.linspace(0, len(chosen) - 1, stations).round().astype(int))
    relative = np.array(lathe.stations)[chosen]
    radii = np.array(lathe.radii_m)[chosen]
    points = lathe.curve.points(relative * lathe.curve.length_m)
    mesh = tube(points, radii, lathe.curve.side(), sides)
    low, high = lathe.band
    texcoords = mesh.texcoords.copy()
    texcoords[:, 1] = low + (high - low) * np.repeat(relative, sides + 1)
    return Mesh(mesh.vertices, mesh.normals, texcoords, mesh.triangles)
