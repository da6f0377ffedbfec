# SPDX-License-Identifier: MIT
"""Tests that the camera of each shipped world has the crop in its picture."""
import pathlib
import subprocess
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
from PIL import Image

WORLDS = pathlib.Path(__file__).resolve().parents[1] / "src/ardee_world/worlds"
FIELDS = sorted(path.stem for path in WORLDS.glob("*.world") if path.stem != "empty")
SMALLEST_SHARE = 0.15  # of the picture's pixels; Listing A.15's camera has 0.07 in farm.world
SIZE = "160x90"


def picture(folder: pathlib.Path, world: ElementTree.ElementTree) -> np.ndarray:
    """Returns the pixels that a world's own camera sees, without shadows."""
    file, image = folder / "seen.world", folder / "seen.png"
    world.write(file)
    command = ["rosrun", "ardee_sim_cpp", "render_world", str(file), "--output", str(image)]
    command += ["--size", SIZE, "--samples", "1", "--no-shadows"]
    subprocess.run(command, check=True, timeout=60)
    return np.asarray(Image.open(image).convert("RGB")).astype(int)


def crop_share(folder: pathlib.Path, path: pathlib.Path) -> float:
    """Returns the share of pixels that change if the field is left out."""
    world = ElementTree.parse(path)
    seen = picture(folder, world)
    root = world.getroot().find("world")
    root.remove(root.findall("include")[1])
    return float((np.abs(picture(folder, world) - seen).max(axis=2) > 2).mean())


@pytest.mark.parametrize("name", FIELDS)
def test_a_worlds_camera_shows_its_crop(tmp_path: pathlib.Path, name: str) -> None:
    assert crop_share(tmp_path, WORLDS / f"{name}.world") > SMALLEST_SHARE
