# SPDX-License-Identifier: MIT
"""The crop models that the build makes, in as many processes as there are cores."""

import concurrent.futures
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Dict, Optional, Sequence

from ardee_common.config import build_group, read_yaml_lines
from ardee_common.options import bounded
from ardee_models.config_dir import config_dir
from ardee_models.plant.crops import make_crop


@dataclass(frozen=True)
class Variant:
    """An entry of config/variants.yaml: one crop model."""

    species: str
    stage: str
    seed: int = bounded(0, 2**63)


def load_variants(path: Optional[Path] = None) -> Dict[str, Variant]:
    """Variants by model name."""
    path = path or config_dir() / "variants.yaml"
    mapping = read_yaml_lines(path)
    return {name: build_group(Variant, mapping, name) for name in mapping}


def _make(name: str, variant: Variant, models: Path) -> Path:
    return make_crop(variant.species, variant.stage, variant.seed, name, models)


def build_crops(
    models: Path, processes: Optional[int] = None, names: Optional[Sequence[str]] = None
) -> None:
    """Writes variants, all by default, into `models`; the files do not depend on the number of processes."""
    workers = processes or len(os.sched_getaffinity(0))
    models.mkdir(parents=True, exist_ok=True)
    with concurrent.futures.ProcessPoolExecutor(workers) as pool:
        variants = load_variants()
        jobs = [pool.submit(_make, name, variants[name], models) for name in names or variants]
        for job in jobs:
            job.result()
