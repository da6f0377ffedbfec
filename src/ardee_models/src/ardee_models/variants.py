# SPDX-License-Identifier: MIT
"""The crop models that the build makes, in as many processes as there are cores."""

import concurrent.futures
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Dict, Optional

from ardee_models.config import bounded, config_dir, from_mapping, read_yaml
from ardee_models.crops import make_crop


@dataclass(frozen=True)
class Variant:
    """An entry of config/variants.yaml: one crop model."""

    species: str
    stage: str
    seed: int = bounded(0, 2**63)


def load_variants(path: Optional[Path] = None) -> Dict[str, Variant]:
    """Variants by model name."""
    path = path or config_dir() / "variants.yaml"
    return {
        name: from_mapping(Variant, entry, f"{path}: {name}")
        for name, entry in read_yaml(path).items()
    }


def _make(name: str, variant: Variant, models: Path) -> Path:
    return make_crop(variant.species, variant.stage, variant.seed, name, models)


def build_crops(models: Path, processes: Optional[int] = None) -> None:
    """Write every variant into `models`; what is written does not depend on the number of processes."""
    workers = processes or len(os.sched_getaffinity(0))
    models.mkdir(parents=True, exist_ok=True)
    with concurrent.futures.ProcessPoolExecutor(workers) as pool:
        jobs = [pool.submit(_make, name, v, models) for name, v in load_variants().items()]
        for job in jobs:
            job.result()
