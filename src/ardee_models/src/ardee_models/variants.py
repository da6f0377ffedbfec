# SPDX-License-Identifier: MIT
"""An entry of config/<species>_variants.yaml."""

from dataclasses import dataclass

from ardee_models.config import bounded


@dataclass(frozen=True)
class Variant:
    """One crop model made by the build."""

    species: str
    stage: str
    seed: int = bounded(0, 2**63)
