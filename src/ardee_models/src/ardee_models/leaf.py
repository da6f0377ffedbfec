# SPDX-License-Identifier: MIT
"""A grass leaf blade: curved midrib, width profile, fold along the midrib, wavy edges."""

from dataclasses import dataclass

import numpy as np

from ardee_models.mesh import sheet, unit
from ardee_models.params import Architecture
from ardee_models.plant import Mesh

_FINE_STEPS = 8  # integration steps a segment of the midrib
_TIP_WIDTH = 0.03  # of the largest width: keeps the last triangles from collapsing
_COLLAR_LENGTH = 0.08  # part of the blade in which the fold at the collar opens


@dataclass(frozen=True)
class Blade:
    """One blade: where it starts, how it is directed (angles from the vertical), its size and its edge waves' phase."""

    origin: np.ndarray
    azimuth_rad: float
    azimuth_drift_rad: float
    insertion_rad: float
    curvature_rad: float
    length_m: float
    width_m: float
    wave_phase_rad: float


def width_profile(s: np.ndarray, klig: float, s_wmax: float) -> np.ndarray:
    """Relative width at relative length s: parabola from klig to 1 at s_wmax, then to the tip (Dornbusch 2011)."""
    base = klig + (1.0 - klig) * (1.0 - (1.0 - s / s_wmax) ** 2)
    beyond = np.clip((s - s_wmax) / (1.0 - s_wmax), 0.0, 1.0)
    tip = (1.0 - beyond**2) ** 0.8
    return np.maximum(np.where(s < s_wmax, base, tip), _TIP_WIDTH)


def midrib(blade: Blade, power: float, segments: int) -> tuple:
    """Points and tangents at segments + 1 stations; the angle from the vertical grows by curvature * s^power."""
    fine = np.linspace(0.0, 1.0, segments * _FINE_STEPS + 1)
    middle = (fine[1:] + fine[:-1]) / 2

    def direction(s: np.ndarray) -> np.ndarray:
        angle = blade.insertion_rad + blade.curvature_rad * s**power
        azimuth = blade.azimuth_rad + blade.azimuth_drift_rad * s
        return np.stack(
            (np.sin(angle) * np.cos(azimuth), np.sin(angle) * np.sin(azimuth), np.cos(angle)), -1
        )

    steps = direction(middle) * (blade.length_m / len(middle))
    path = np.concatenate((np.zeros((1, 3)), np.cumsum(steps, axis=0))) + blade.origin
    return path[::_FINE_STEPS], direction(fine[::_FINE_STEPS])


def blade_mesh(blade: Blade, shape: Architecture, segments: int) -> Mesh:
    """Three columns of vertices (edge, midrib, edge): 4 triangles a segment, upper side along the normals."""
    s = np.linspace(0.0, 1.0, segments + 1)
    centre, tangent = midrib(blade, shape.curvature_power, segments)
    azimuth = blade.azimuth_rad + blade.azimuth_drift_rad * s
    side = np.stack((np.sin(azimuth), -np.cos(azimuth), np.zeros_like(s)), -1)
    up = unit(np.cross(side, tangent))
    half = 0.5 * blade.width_m * width_profile(s, shape.blade_klig, shape.blade_s_wmax)
    opening = np.exp(-s / _COLLAR_LENGTH)
    fold = np.radians(shape.fold_blade_deg + (shape.fold_base_deg - shape.fold_blade_deg) * opening)
    wave = shape.wave_amplitude * half * (1.0 - opening)
    phase = 2.0 * np.pi * shape.wave_count * s + blade.wave_phase_rad
    columns = []
    for sign, shift in ((-1.0, 0.0), (0.0, 0.0), (1.0, 0.6 * np.pi)):
        lift = abs(sign) * (half * np.sin(fold) + wave * np.sin(phase + shift))
        columns.append(centre + (sign * half * np.cos(fold))[:, None] * side + lift[:, None] * up)
    points = np.stack(columns, axis=1)
    points[..., 2] = np.maximum(points[..., 2], 0.0)  # a drooping tip rests on the ground
    u, v = np.broadcast_arrays(np.array([0.0, 0.5, 1.0])[None, :], s[:, None])
    return sheet(points, np.stack((u, v), axis=-1))
