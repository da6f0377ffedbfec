# SPDX-License-Identifier: MIT
"""Finds the folders of ROS packages and of the data that comes with ARDEE, without ROS."""

import contextlib
import os
from pathlib import Path
from typing import Iterator, List

from ardee_sim.errors import ArdeeError

from ardee_common import data


def package_folders() -> List[str]:
    """Returns folders that hold packages, besides those of ROS_PACKAGE_PATH."""
    return [str(data.SHARE)] if data.SHARE.is_dir() else []


def model_folders() -> List[str]:
    """Returns folders of crops, terrains and fields, besides those of GAZEBO_MODEL_PATH."""
    return [str(folder) for folder in data.model_folders()]


def media_folders() -> List[str]:
    """Returns folders of worlds, textures and fields, besides those of GAZEBO_RESOURCE_PATH."""
    names = ("ardee_world/models", "ardee_models", "ardee_models/models")
    folders = [str(data.SHARE / name) for name in names]
    with contextlib.suppress(ArdeeError):
        folders.append(str(find_package("ardee_world") / "worlds"))
    return [folder for folder in folders if os.path.isdir(folder)]


def _places(name: str) -> Iterator[Path]:
    path = filter(None, os.environ.get("ROS_PACKAGE_PATH", "").split(os.pathsep))
    for root in (*package_folders(), *path, "/usr/share"):
        yield Path(root) / name
        if Path(root).name == name:
            yield Path(root)


def find_package(name: str) -> Path:
    """Returns the folder of a ROS package. Raises ArdeeError if there is none."""
    for place in _places(name):
        if (place / "package.xml").is_file():
            return place
    raise ArdeeError(
        f"found no package '{name}', expected one below {package_folders() or 'ROS_PACKAGE_PATH'}"
    )
