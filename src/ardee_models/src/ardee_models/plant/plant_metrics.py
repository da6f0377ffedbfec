# SPDX-License-Identifier: MIT
"""The figures of a plant, measured on its mesh, that are written beside it."""

from typing import Dict, Tuple

import numpy as np

from ardee_models.plant.cylinder import Cylinder
from ardee_models.plant.plan import Plan
from ardee_models.plant.plant import Plant
from ardee_models.plant.species import CropParams

METRICS_FILE = "metrics.json"
_GREEN = 0.5  # a blade less dry than this counts as green
_FOOT = 0.15  # lowest part of the stalk, where its diameter is measured
LOW_M = 0.5  # leaves below are those that a robot in the lane meets
LANE_M = 0.762  # width of a lane between two rows: 30 in


def _stalk_diameter(stem: np.ndarray, cylinder: Cylinder) -> float:
    """Mean diameter of the foot of the stalk."""
    offsets = stem - cylinder.centre
    along = offsets @ cylinder.axis
    radii = np.linalg.norm(offsets - along[:, None] * cylinder.axis, axis=1)
    return 2.0 * float(radii[along <= along.min() + _FOOT * np.ptp(along)].mean())


def mid_lane_share(distance_m: np.ndarray) -> np.ndarray:
    """Share of a plant's azimuths at which a point so far from its stalk is in the middle third of a lane beside it."""
    near, far = (
        np.arcsin(np.minimum(edge_m / np.maximum(distance_m, 1e-9), 1.0))
        for edge_m in (LANE_M / 3.0, 2.0 * LANE_M / 3.0)
    )
    return (far - near) * 2.0 / np.pi


def _leaf_heights(plant: Plant) -> Dict[str, float]:
    """Where the area of the blades is: over the ground, and in the lane."""
    areas = np.concatenate([mesh.triangle_areas_m2() for mesh in plant.blades()])
    centres = np.concatenate([mesh.triangle_centres() for mesh in plant.blades()])
    low = areas * (centres[:, 2] < LOW_M)
    in_lane = low @ mid_lane_share(np.linalg.norm(centres[:, :2], axis=1))
    return {
        "leaf_height_mean_m": round(float(areas @ centres[:, 2] / areas.sum()), 4),
        "leaf_area_low_m2": round(float(low.sum()), 5),
        "leaf_area_low_mid_lane_share": round(float(in_lane / max(low.sum(), 1e-12)), 4),
    }


def measure(
    params: CropParams, plan: Plan, levels: Tuple[Plant, ...], cylinder: Cylinder, seed: int
) -> Dict[str, object]:
    """Content of metrics.json; lengths in metres, areas one-sided in square metres."""
    full, coarse = levels
    vertices = full.vertices()
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    blades = [blade for shoot in (plan.main, *plan.tillers) for blade in shoot.blades]
    area = full.leaf_area_m2()
    sizes = np.array([blade.length_m * blade.width_m for blade in blades])
    green = np.array([blade.dryness < _GREEN for blade in blades])
    longest = max(blades, key=lambda blade: blade.length_m)
    widest = max(blades, key=lambda blade: blade.width_m)

    def metres(value: float) -> float:
        return round(float(value), 5)

    return {
        "species": params.species,
        "stage": params.stage_name,
        "season": params.stage.season,
        "seed": seed,
        "label": params.label,
        "height_m": metres(high[2]),
        "stalk_height_m": metres(full.organ("Stem").mesh.vertices[:, 2].max()),
        "stalk_radius_m": metres(cylinder.radius_m),
        "stalk_diameter_m": metres(_stalk_diameter(full.organ("Stem").mesh.vertices, cylinder)),
        "leaf_number": plan.main.emerged,
        "leaf_count": len(blades),
        "tiller_count": len(plan.tillers),
        "leaf_area_m2": metres(area),
        "green_leaf_area_m2": metres(area * float(sizes @ green) / float(sizes.sum())),
        "density_per_m2": params.density_per_m2,
        "leaf_area_index": round(area * params.density_per_m2, 3),
        "leaf_length_max_m": metres(longest.length_m),
        "leaf_width_max_m": metres(widest.width_m),
        "leaf_length_to_width": round(longest.length_m / longest.width_m, 3),
        **_leaf_heights(full),
        "lateral_extent_m": metres(np.linalg.norm(vertices[:, :2], axis=1).max()),
        "triangles": full.triangle_count(),
        "triangles_lod1": coarse.triangle_count(),
        "bounds_m": [[metres(v) for v in corner] for corner in (low, high)],
    }
