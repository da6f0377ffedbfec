# SPDX-License-Identifier: MIT
"""Folder of the package's YAML files."""

from pathlib import Path

from ardee_common.errors import GeneratorError


def config_dir() -> Path:
    """Folder of the YAML files, in the source tree or in an installed workspace."""
    here = Path(__file__).resolve().parent
    candidates = (here.parents[1] / "config", here.parents[3] / "share" / "ardee_models" / "config")
    for candidate in candidates:
        if candidate.is_dir():
            return candidate
    raise GeneratorError(
        f"no config folder of ardee_models, looked in {candidates[0]} and {candidates[1]}"
    )
