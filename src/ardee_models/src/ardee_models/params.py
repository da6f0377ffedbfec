# SPDX-License-Identifier: MIT
"""Parameters of a crop plant, read from config/<species>.yaml (which gives their sources)."""

from dataclasses import dataclass
from pathlib import Path
from typing import Optional, Tuple

from ardee_models.config import bounded, config_dir, from_mapping, read_yaml
from ardee_models.errors import GeneratorError


@dataclass(frozen=True)
class Architecture:
    """What all stages of a species share; angles in degrees, lengths in metres."""

    leaf_number: int = bounded(3, 60)
    phyllotaxy_mean_deg: float = bounded(0, 360)
    phyllotaxy_sd_deg: float = bounded(0, 90)
    ligule_ratio: float = bounded(0.5, 2.0)
    leaf_length_max_m: float = bounded(0.01, 3)
    leaf_length_cv: float = bounded(0, 0.3)
    rank_of_largest: float = bounded(0.05, 1)
    area_skew: float = bounded(1e-6, 0.5)
    width_to_length: float = bounded(0.01, 1)
    blade_klig: float = bounded(0.05, 1)
    blade_s_wmax: float = bounded(0.1, 0.9)
    insertion_angle_deg: float = bounded(0, 90)
    insertion_angle_top_deg: float = bounded(0, 90)
    insertion_sd_deg: float = bounded(0, 30)
    curvature_deg: float = bounded(0, 180)
    curvature_sd_deg: float = bounded(0, 60)
    curvature_power: float = bounded(0.5, 5)
    azimuth_drift_sd_deg: float = bounded(0, 60)
    fold_base_deg: float = bounded(0, 89)
    fold_blade_deg: float = bounded(0, 89)
    wave_amplitude: float = bounded(0, 1)
    wave_count: float = bounded(0, 20)
    node_swelling: float = bounded(1, 2)
    whorl_length_fractions: Tuple[float, ...] = bounded(0.05, 1)
    stalk_height_cv: float = bounded(0, 0.3)
    tassel_branches: int = bounded(0, 40)
    tassel_length_m: float = bounded(0.01, 1)
    tassel_branch_length_m: float = bounded(0.01, 1)


@dataclass(frozen=True)
class Stage:
    """What changes as the plant grows."""

    collared_leaves: int = bounded(1, 60)
    lost_leaves: int = bounded(0, 59)
    stalk_height_m: float = bounded(0.02, 6)
    base_diameter_m: float = bounded(0.001, 0.2)
    top_diameter_m: float = bounded(0.001, 0.2)
    tassel: bool
    senescence: float = bounded(0, 1)


@dataclass(frozen=True)
class CropParams:
    """One species at one stage: all that `generate` needs besides the random stream."""

    species: str
    material_prefix: str
    label: int
    stage_name: str
    architecture: Architecture
    stage: Stage


@dataclass(frozen=True)
class _File:
    species: str
    material_prefix: str
    label: int = bounded(0, 65535)
    architecture: dict
    stages: dict


def known_species() -> list:
    """Species that have a parameter file."""
    files = config_dir().glob("*.yaml")
    return sorted(path.stem for path in files if not path.stem.endswith("_variants"))


def load_params(species: str, stage: str, path: Optional[Path] = None) -> CropParams:
    """Parameters of `species` at `stage`, from `path` or the package's own file."""
    if path is None:
        if species not in known_species():
            raise GeneratorError(
                f"unknown species {species!r}, known: {', '.join(known_species())}"
            )
        path = config_dir() / f"{species}.yaml"
    data = from_mapping(_File, read_yaml(path), str(path))
    if stage not in data.stages:
        known = ", ".join(map(str, data.stages))
        raise GeneratorError(f"{path}: unknown stage {stage!r} of {species}, known: {known}")
    architecture = from_mapping(Architecture, data.architecture, f"{path}: architecture")
    where = f"{path}: stages.{stage}"
    parsed = from_mapping(Stage, data.stages[stage], where)
    if parsed.collared_leaves > architecture.leaf_number:
        raise GeneratorError(
            f"{where}.collared_leaves: found {parsed.collared_leaves}, expected at most leaf_number"
        )
    if parsed.lost_leaves >= parsed.collared_leaves:
        raise GeneratorError(
            f"{where}.lost_leaves: found {parsed.lost_leaves}, expected less than collared_leaves"
        )
    return CropParams(data.species, data.material_prefix, data.label, stage, architecture, parsed)
