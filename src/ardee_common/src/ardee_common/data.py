# SPDX-License-Identifier: MIT
"""Finds the worlds, robots and models that come in a wheel; a workspace has them in its packages."""

from pathlib import Path
from typing import List

SHARE = Path(__file__).resolve().parent / "share"  # a folder for each package


def model_folders() -> List[Path]:
    """Returns folders of crops, terrains and fields; none in a workspace."""
    folders = (SHARE / name / "models" for name in ("ardee_world", "ardee_models", "ardee_sensors"))
    return [folder for folder in folders if folder.is_dir()]
