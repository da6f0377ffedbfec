# SPDX-License-Identifier: MIT
"""Folder of the package's YAML files."""

from pathlib import Path

from ardee_common import data
from ardee_common.errors import GeneratorError


def config_dir() -> Path:
    """Folder of the YAML files: in the source tree, in an installed workspace, or in a wheel."""
    here = Path(__file__).resolve().parent
    shares = (here.parents[3] / "share", data.SHARE)
    candidates = (here.parents[1] / "config", *(s / "ardee_models" / "config" for s in shares))
    for candidate in candidates:
        if candidate.is_dir():
            return candidate
    raise GeneratorError(
        f"no config folder of ardee_models, looked in {', '.join(map(str, candidates))}"
    )
