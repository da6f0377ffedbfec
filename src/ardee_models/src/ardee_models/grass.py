# SPDX-License-Identifier: MIT
"""Grass crops (corn): phytomer by phytomer architecture turned into organs."""

from typing import List

import numpy as np

from ardee_models.leaf import Blade, blade_mesh
from ardee_models.mesh import join, tube
from ardee_models.params import Architecture, CropParams
from ardee_models.plant import Mesh, Organ, Plant
from ardee_models.tassel import tassel_mesh

_STALK_SIDES = 6
_TRIANGLE_BUDGET = 1250  # of a whole plant; blades take what stalk and tassel leave
_SEGMENT_LIMITS = (8, 24)  # of a blade
_WHORL_ERECT_DEG = 7.0  # insertion angle of leaves still in the whorl (estimate)
_NODE_BAND = 0.12  # of an internode, the height of the swelling at a node


def relative_leaf_area(rank: np.ndarray, r_max: float, skew: float) -> np.ndarray:
    """Leaf area over the largest leaf's at relative rank 0..1: exp(-k/r_max (2 d^2 + d^3)), k = -ln(skew) r_max."""
    d = rank - r_max
    return np.exp(np.log(skew) * (2.0 * d**2 + d**3))


def ligule_heights(count: int, ratio: float, height_m: float) -> np.ndarray:
    """Heights of collars 1..count, geometric: H (1 - q^i) / (1 - q^n) (ArchiCrop); equal spacing at q = 1."""
    i = np.arange(1, count + 1)
    if abs(ratio - 1.0) < 1e-9:
        return height_m * i / count
    return height_m * (1.0 - ratio**i) / (1.0 - ratio**count)


def _stalk(heights: np.ndarray, base_radius: float, top_radius: float, swelling: float) -> Mesh:
    top = heights[-1]
    stations, bulges = [0.0], [1.0]
    for low, high in zip(np.concatenate(([0.0], heights[:-1])), heights):
        stations += [high - _NODE_BAND * (high - low), high]
        bulges += [1.0, swelling]
    z = np.array(stations)
    bulges[-1] = 1.0
    radii = (base_radius + (top_radius - base_radius) * z / top) * np.array(bulges)
    centres = np.column_stack((np.zeros_like(z), np.zeros_like(z), z))
    return tube(centres, radii, np.array([0.0, 1.0, 0.0]), _STALK_SIDES)


def _leaf_lengths(ranks: np.ndarray, shape: Architecture, rng: np.random.Generator) -> np.ndarray:
    area = relative_leaf_area(ranks / shape.leaf_number, shape.rank_of_largest, shape.area_skew)
    vigour = np.exp(rng.normal(0.0, shape.leaf_length_cv))
    return (
        shape.leaf_length_max_m * vigour * np.sqrt(area) * np.exp(rng.normal(0.0, 0.03, len(ranks)))
    )


def _blades(params: CropParams, heights: np.ndarray, rng: np.random.Generator) -> List[Blade]:
    shape, stage = params.architecture, params.stage
    collared = stage.collared_leaves
    whorl = min(len(shape.whorl_length_fractions), shape.leaf_number - collared)
    ranks = np.arange(1, collared + whorl + 1)
    lengths = _leaf_lengths(ranks, shape, rng)
    base, top = 0.5 * stage.base_diameter_m, 0.5 * stage.top_diameter_m
    azimuth = rng.uniform(0.0, 2.0 * np.pi)
    blades = []
    for i in range(len(ranks)):
        azimuth += np.radians(rng.normal(shape.phyllotaxy_mean_deg, shape.phyllotaxy_sd_deg))
        insertion, bend, drift = rng.normal(0.0, 1.0, 3)
        phase = rng.uniform(0.0, 2.0 * np.pi)
        in_whorl = i - collared
        age = i / max(collared - 1, 1)
        z = heights[min(i, collared - 1)]
        mean_insertion = shape.insertion_angle_deg + age * (
            shape.insertion_angle_top_deg - shape.insertion_angle_deg
        )
        curvature, width = shape.curvature_deg, shape.width_to_length * lengths[i]
        length = lengths[i]
        if in_whorl >= 0:
            mean_insertion = _WHORL_ERECT_DEG
            fraction = shape.whorl_length_fractions[in_whorl]
            length, width, curvature = (
                length * fraction,
                width * (0.4 + 0.4 * fraction),
                0.45 * curvature * fraction,
            )
        radius = base + (top - base) * z / heights[-1]
        offset = 0.0 if in_whorl >= 0 else 0.8 * radius
        blade = Blade(
            origin=np.array([offset * np.cos(azimuth), offset * np.sin(azimuth), z]),
            azimuth_rad=azimuth,
            azimuth_drift_rad=np.radians(shape.azimuth_drift_sd_deg) * drift,
            insertion_rad=np.radians(max(mean_insertion + shape.insertion_sd_deg * insertion, 1.0)),
            curvature_rad=np.radians(max(curvature + shape.curvature_sd_deg * bend, 0.0)),
            length_m=length,
            width_m=width,
            wave_phase_rad=phase,
        )
        if i >= stage.lost_leaves:
            blades.append(blade)
    return blades


def _leaf_organs(params: CropParams, blades: List[Blade], used: int) -> List[Organ]:
    """Blades in three groups from the ground up, as the material may differ with height."""
    low, high = _SEGMENT_LIMITS
    segments = int(np.clip((_TRIANGLE_BUDGET - used) // (4 * len(blades)), low, high))
    groups = np.array_split(np.arange(len(blades)), 3)
    names = (("LeavesBase", "leavesb"), ("LeavesMid", "leavesm"), ("LeavesTop", "leavest"))
    organs = []
    for (name, visual), group in zip(names, groups):
        meshes = [blade_mesh(blades[i], params.architecture, segments) for i in group]
        if meshes:
            organs.append(Organ(name, visual, visual, join(meshes)))
    return organs


def generate(params: CropParams, rng: np.random.Generator) -> Plant:
    """One plant standing at the origin, base at z = 0."""
    shape, stage = params.architecture, params.stage
    height = stage.stalk_height_m * float(np.exp(rng.normal(0.0, shape.stalk_height_cv)))
    heights = ligule_heights(stage.collared_leaves, shape.ligule_ratio, height)
    base, top = 0.5 * stage.base_diameter_m, 0.5 * stage.top_diameter_m
    organs = [Organ("Stem", "stem", "stem", _stalk(heights, base, top, shape.node_swelling))]
    blades = _blades(params, heights, rng)
    tassels = []
    if stage.tassel:
        mesh = tassel_mesh(np.array([0.0, 0.0, height]), top, shape, rng)
        tassels = [Organ("Tassel", "tassel", "tassel", mesh)]
    used = sum(len(organ.mesh.triangles) for organ in organs + tassels)
    organs += _leaf_organs(params, blades, used) + tassels
    return Plant(
        species=params.species,
        stage=params.stage_name,
        material_prefix=params.material_prefix,
        label=params.label,
        senescence=stage.senescence,
        stalk_height_m=height,
        stalk_radius_m=0.5 * (base + top),
        leaf_count=len(blades),
        organs=tuple(organs),
    )
