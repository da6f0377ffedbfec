# SPDX-License-Identifier: MIT
"""A leaf blade: curved midrib, width profile, fold along the midrib, wavy edges."""

from dataclasses import dataclass
from typing import Tuple

import numpy as np

from ardee_models.plant.mesh import join, sheet, unit
from ardee_models.plant.plant import Mesh
from ardee_models.plant.species import Leaves

_FINE_STEPS = 8  # integration steps a segment of the midrib
_TIP_WIDTH = 0.03  # part of the largest width: keeps the last triangles from collapsing
_KINK_LENGTH = 0.02  # part of the blade over which a buckled midrib bends (estimate)
MOST_DOWNWARD = np.radians(172.0)  # a tip hangs, it does not point back to the stalk
_COLLAR_LENGTH = 0.08  # part of the blade in which the fold at the collar opens
_STRIP_MARGIN = 0.04  # part of a texture strip's width that stays free at each side


@dataclass(frozen=True)
class Shred:
    """The part of a blade between two tears, at offsets -1..1 across it: apart from `apart_from` of the length on.

    From there it stands off from the blade by two angles; at `ends_at` its tip has broken off.
    """

    low: float
    high: float
    apart_from: float
    ends_at: float
    side_rad: float
    up_rad: float


WHOLE = (Shred(-1.0, 1.0, 0.0, 1.0, 0.0, 0.0),)


@dataclass(frozen=True)
class Blade:
    """One blade: its start, its direction (angles from the vertical), its size, its state."""

    rank: int
    origin: np.ndarray
    azimuth_rad: float
    azimuth_drift_rad: float
    insertion_rad: float
    curvature_rad: float
    buckle_rad: float
    buckle_at: float
    twist_rad: float
    fold_extra_rad: float
    length_m: float
    width_m: float
    wave_phase_rad: float
    dryness: float
    strip: int
    strips: int
    shreds: Tuple[Shred, ...] = WHOLE


def width_profile(s: np.ndarray, klig: float, s_wmax: float, tip_power: float) -> np.ndarray:
    """Relative width at s: parabola from klig to 1 at s_wmax (Dornbusch 2011), then 1 - b^p to the tip."""
    base = klig + (1.0 - klig) * (1.0 - (1.0 - s / s_wmax) ** 2)
    beyond = np.clip((s - s_wmax) / (1.0 - s_wmax), 0.0, 1.0)
    return np.maximum(np.where(s < s_wmax, base, 1.0 - beyond**tip_power), _TIP_WIDTH)


def profile_area(klig: float, s_wmax: float, tip_power: float) -> float:
    """Area of the outline over length times width: the integral of the width profile."""
    return s_wmax * (klig + (1.0 - klig) * 2.0 / 3.0) + (1.0 - s_wmax) * tip_power / (
        tip_power + 1.0
    )


def midrib(blade: Blade, power: float, segments: int) -> tuple:
    """Points and tangents at segments + 1 stations; the angle from the vertical grows by curvature * s^power.

    At `buckle_at` of its length the midrib has kinked, within a few per cent of it, by `buckle_rad`. From where it
    reaches the ground it lies there, away from the stalk.
    """
    fine = np.linspace(0.0, 1.0, segments * _FINE_STEPS + 1)
    middle = (fine[1:] + fine[:-1]) / 2

    def direction(s: np.ndarray) -> np.ndarray:
        kink = blade.buckle_rad / (1.0 + np.exp((blade.buckle_at - s) / _KINK_LENGTH))
        angle = blade.insertion_rad + blade.curvature_rad * s**power + kink
        angle = np.minimum(angle, MOST_DOWNWARD)
        azimuth = blade.azimuth_rad + blade.azimuth_drift_rad * s
        return np.stack(
            (np.sin(angle) * np.cos(azimuth), np.sin(angle) * np.sin(azimuth), np.cos(angle)), -1
        )

    step_m = blade.length_m / len(middle)
    path = np.concatenate((np.zeros((1, 3)), np.cumsum(direction(middle) * step_m, axis=0)))
    path += blade.origin
    tangents = direction(fine)
    aground = np.flatnonzero(path[:, 2] < 0.0)
    if len(aground):
        outward = np.array([np.cos(blade.azimuth_rad), np.sin(blade.azimuth_rad), 0.0])
        last = path[aground[0] - 1] * (1.0, 1.0, 0.0)
        path[aground[0] :] = last + np.arange(1, len(aground) + 1)[:, None] * step_m * outward
        tangents[aground[0] :] = outward
    return path[::_FINE_STEPS], tangents[::_FINE_STEPS]


def _half_widths(blade: Blade, shape: Leaves, s: np.ndarray) -> np.ndarray:
    """Half widths whose trapezoids have the outline's area, however few they are."""
    outline = (shape.blade_klig, shape.blade_s_wmax, shape.blade_tip_power)
    relative = width_profile(s, *outline)
    polygon = float(np.sum((relative[1:] + relative[:-1]) / 2) / (len(s) - 1))
    return 0.5 * blade.width_m * relative * profile_area(*outline) / polygon


def _cross_section(blade: Blade, shape: Leaves, s: np.ndarray, offsets: np.ndarray) -> tuple:
    """Sideways and upward parts, over the half width, of vertices at `offsets` -1..1 across the blade."""
    opening = np.exp(-s / _COLLAR_LENGTH)[:, None]
    blade_fold = np.radians(shape.fold_blade_deg) + blade.fold_extra_rad
    fold = blade_fold + (np.radians(shape.fold_base_deg) - blade_fold) * opening
    across = np.abs(offsets)[None, :]
    # from the midrib to the edge the slope falls by edge_droop
    slope = fold - np.radians(shape.edge_droop_deg) * across * (1.0 - opening)
    phase = 2.0 * np.pi * shape.wave_count * s[:, None] + blade.wave_phase_rad
    shift = np.where(offsets > 0.0, 0.6 * np.pi, 0.0)[None, :]
    wave = shape.wave_amplitude * across**2 * (1.0 - opening) * np.sin(phase + shift)
    return np.sign(offsets)[None, :] * across * np.cos(slope), across * np.sin(slope) + wave


def _shred_mesh(
    blade: Blade, shape: Leaves, shred: Shred, s: np.ndarray, offsets: np.ndarray
) -> Mesh:
    """Mesh of one shred; normals point to the upper side."""
    centre, tangent = midrib(blade, shape.curvature_power, len(s) - 1)
    azimuth = blade.azimuth_rad + blade.azimuth_drift_rad * s
    flat_side = np.stack((np.sin(azimuth), -np.cos(azimuth), np.zeros_like(s)), -1)
    flat_up = unit(np.cross(flat_side, tangent))
    roll = (blade.twist_rad * s)[:, None]
    side = np.cos(roll) * flat_side + np.sin(roll) * flat_up
    up = np.cos(roll) * flat_up - np.sin(roll) * flat_side
    half = _half_widths(blade, shape, s)[:, None]
    sideways, lift = _cross_section(blade, shape, s, offsets)
    # no midrib to fold along: the flat blade keeps its area
    if len(offsets) == 2 and offsets[0] < 0.0 < offsets[1]:
        sideways, lift = np.broadcast_to(offsets, sideways.shape), np.zeros_like(lift)
    apart = blade.length_m * np.maximum(s - shred.apart_from, 0.0)[:, None]
    direction = unit(np.array([np.tan(shred.side_rad), np.tan(shred.up_rad), 1.0]))
    turned = np.stack((side, up, tangent), -1) @ direction - tangent
    centre[1:] += np.cumsum(np.diff(apart, axis=0) * (turned[1:] + turned[:-1]) / 2, axis=0)
    points = (
        centre[:, None, :]
        + (half * sideways)[..., None] * side[:, None, :]
        + (half * lift)[..., None] * up[:, None, :]
    )
    points[..., 2] = np.maximum(points[..., 2], 0.0)  # a drooping tip rests on the ground
    low = (blade.strip + _STRIP_MARGIN) / blade.strips
    high = (blade.strip + 1.0 - _STRIP_MARGIN) / blade.strips
    u, v = np.broadcast_arrays((low + (high - low) * (offsets + 1.0) / 2.0)[None, :], s[:, None])
    rows = max(int(round(shred.ends_at * (len(s) - 1))), 1) + 1
    return sheet(points[:rows], np.stack((u, v), axis=-1)[:rows])


def blade_mesh(blade: Blade, shape: Leaves, segments: int, columns: int) -> Mesh:
    """Mesh of `columns` of vertices (odd: one is the midrib; 2: edges only), and of two more at each tear."""
    s = np.linspace(0.0, 1.0, segments + 1)
    offsets = np.linspace(-1.0, 1.0, columns)
    meshes = []
    for shred in blade.shreds:
        inside = offsets[(offsets > shred.low) & (offsets < shred.high)]
        across = np.concatenate(([shred.low], inside, [shred.high]))
        meshes.append(_shred_mesh(blade, shape, shred, s, across))
    return join(meshes)
