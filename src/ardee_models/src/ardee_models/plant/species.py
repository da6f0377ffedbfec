# SPDX-License-Identifier: MIT
"""Parameters of a crop, read from config/species/<species>.yaml (which gives their sources)."""

from dataclasses import dataclass
from pathlib import Path
from typing import Optional, Tuple

from ardee_common.config import build, read_yaml_lines
from ardee_common.errors import GeneratorError, known_names
from ardee_common.options import bounded
from ardee_models.config_dir import config_dir
from ardee_models.plant.organ_params import (
    BraceRoots,
    Colours,
    Ears,
    Flowers,
    Panicle,
    Tassel,
    Tillers,
    Wear,
)
from ardee_models.plant.stages import Stage, resolve_stage


@dataclass(frozen=True)
class Stalk:
    """The stem: spacing of leaves along it, its surface, its lean."""

    ligule_ratio: float = bounded(0.5, 2.0)
    node_swelling: float = bounded(1, 2)
    sheath_m: float = bounded(0, 0.02)
    lean_sd_deg: float = bounded(0, 20)
    height_cv: float = bounded(0, 0.3)
    diameter_cv: float = bounded(0, 0.3)


@dataclass(frozen=True)
class Phyllotaxy:
    """Angle from each leaf to the next, seen from above."""

    mean_deg: float = bounded(0, 360)
    sd_deg: float = bounded(0, 90)


@dataclass(frozen=True)
class Leaves:
    """Number, size by rank, blade outline and posture; angles from the vertical in degrees, lengths in metres."""

    venation: str
    number: int = bounded(3, 60)
    number_sd: float = bounded(0, 5)
    length_max_m: float = bounded(0.01, 3)
    length_cv: float = bounded(0, 0.3)
    rank_of_largest: float = bounded(0.05, 1)
    area_skew: float = bounded(1e-6, 0.5)
    length_to_width: float = bounded(1, 50)
    length_to_width_ends: float = bounded(1, 50)
    blade_klig: float = bounded(0.02, 1)
    blade_s_wmax: float = bounded(0.1, 0.9)
    blade_tip_power: float = bounded(0.5, 5)
    insertion_angle_deg: float = bounded(0, 90)
    insertion_angle_top_deg: float = bounded(0, 90)
    insertion_sd_deg: float = bounded(0, 30)
    curvature_deg: float = bounded(0, 180)
    curvature_top_deg: float = bounded(0, 180)
    curvature_sd_deg: float = bounded(0, 60)
    curvature_power: float = bounded(0.5, 5)
    azimuth_drift_sd_deg: float = bounded(0, 60)
    twist_sd_deg: float = bounded(0, 90)
    fold_base_deg: float = bounded(0, 89)
    fold_blade_deg: float = bounded(0, 89)
    edge_droop_deg: float = bounded(0, 89)
    wave_amplitude: float = bounded(0, 1)
    wave_count: float = bounded(0, 20)
    dry_droop_deg: float = bounded(0, 120)
    dry_fold_deg: float = bounded(0, 85)
    azimuth_sd_deg: float = bounded(0, 90)
    buckle_probability: float = bounded(0, 1)
    buckle_deg: float = bounded(0, 120)
    hanging_deg: float = bounded(0, 170)
    hanging_sd_deg: float = bounded(0, 60)


@dataclass(frozen=True)
class YoungLeaves:
    """Leaves that have not reached their final size, from the lowest to the topmost."""

    length_first: float = bounded(0.05, 1)
    length_last: float = bounded(0.02, 1)
    insertion_deg: float = bounded(0, 90)
    curvature_factor: float = bounded(0, 2)
    fold_extra_deg: float = bounded(0, 60)


@dataclass(frozen=True)
class Architecture:
    """Parameters that all stages of a species share; a section that a species lacks is None."""

    stalk: Stalk
    phyllotaxy: Phyllotaxy
    leaves: Leaves
    young_leaves: YoungLeaves
    tassel: Optional[Tassel] = None
    ears: Optional[Ears] = None
    panicle: Optional[Panicle] = None
    flowers: Optional[Flowers] = None
    tillers: Optional[Tillers] = None
    brace_roots: Optional[BraceRoots] = None
    wear: Optional[Wear] = None


@dataclass(frozen=True)
class CropParams:
    """One species at one stage: all that the generator needs besides the random stream."""

    species: str
    label: int
    density_per_m2: float
    stage_name: str
    architecture: Architecture
    colours: Colours
    stage: Stage


@dataclass(frozen=True)
class SpeciesFile:
    """A species' parameter file."""

    species: str
    architecture: Architecture
    colours: Colours
    counters: Tuple[str, ...]
    stages: dict
    label: int = bounded(0, 65535)
    density_per_m2: float = bounded(0.01, 1000)


def known_species() -> list:
    """Species that have a parameter file."""
    return sorted(path.stem for path in (config_dir() / "species").glob("*.yaml"))


def load_species(species: str, path: Optional[Path] = None) -> tuple:
    """Parameter file of `species`, from `path` or the package's own: content and path."""
    if path is None:
        if species not in known_species():
            known = known_names(species, known_species())
            raise GeneratorError(f"unknown species {species!r}, {known}")
        path = config_dir() / "species" / f"{species}.yaml"
    data = build(SpeciesFile, read_yaml_lines(path))
    if data.architecture.leaves.venation not in ("parallel", "pinnate"):
        raise GeneratorError(
            f"{path}.architecture.leaves.venation: found {data.architecture.leaves.venation!r},"
            " expected 'parallel' or 'pinnate'"
        )
    return data, path


def load_params(species: str, stage: str, path: Optional[Path] = None) -> CropParams:
    """Parameters of `species` at `stage`, one of the file's rows or a count between them."""
    data, path = load_species(species, path)
    row = resolve_stage(data.stages, data.counters, stage, f"{path}: stages")
    most = data.architecture.leaves.number
    if row.collared_leaves > most:
        raise GeneratorError(
            f"{path}: stages.{stage}.collared_leaves: found {row.collared_leaves},"
            f" expected at most leaves.number, {most}"
        )
    return CropParams(
        data.species,
        data.label,
        data.density_per_m2,
        stage,
        data.architecture,
        data.colours,
        row,
    )
