# SPDX-License-Identifier: MIT
"""Tests that the camera of each shipped world has the crop in its picture."""
import pathlib
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
from PIL import Image

from ardee_common.ros_graph import RosGraph

WORLDS = pathlib.Path(__file__).resolve().parents[1] / "src/ardee_world/worlds"
FIELDS = sorted(path.stem for path in WORLDS.glob("*.world") if path.stem != "empty")
SMALLEST_SHARE = 0.15  # of the picture's pixels; Listing A.15's camera has 0.07 in farm.world
SIZE = "160x90"


def picture(graph: RosGraph, world: ElementTree.ElementTree) -> np.ndarray:
    """Returns the pixels that a world's own camera sees, without shadows."""
    file, image = graph.folder / "seen.world", graph.folder / "seen.png"
    world.write(file)
    command = ["rosrun", "ardee_sim_cpp", "render_world", str(file), "--output", str(image)]
    graph.run(*command, "--size", SIZE, "--samples", "1", "--no-shadows")
    return np.asarray(Image.open(image).convert("RGB")).astype(int)


def crop_share(graph: RosGraph, path: pathlib.Path) -> float:
    """Returns the share of pixels that change if the field is left out."""
    world = ElementTree.parse(path)
    seen = picture(graph, world)
    root = world.getroot().find("world")
    root.remove(root.findall("include")[1])
    return float((np.abs(picture(graph, world) - seen).max(axis=2) > 2).mean())


@pytest.mark.parametrize("name", FIELDS)
def test_a_worlds_camera_shows_its_crop(graph: RosGraph, name: str) -> None:
    assert crop_share(graph, WORLDS / f"{name}.world") > SMALLEST_SHARE
