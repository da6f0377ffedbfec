# SPDX-License-Identifier: MIT
"""Tests that the meshes are the output of their script, and closed surfaces that face outwards."""
import importlib.util
import pathlib
import sys
from collections import Counter

import numpy as np
import pytest
from generations import Generation
from xacro_runner import read_stl

PACKAGE = pathlib.Path(__file__).resolve().parents[1]
FOLDER = PACKAGE / "meshes"
FILES = sorted(str(path.relative_to(FOLDER)) for path in FOLDER.glob("*/*"))


def load_script():
    """Returns the mesh script as a module."""
    spec = importlib.util.spec_from_file_location(
        "robot_meshes", PACKAGE / "scripts/make_meshes.py"
    )
    sys.path.insert(0, str(PACKAGE / "scripts"))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_script_makes_the_same_meshes(tmp_path: pathlib.Path):
    script = load_script()
    for generation, parts in script.meshes().items():
        script.shapes.write_all(parts, tmp_path / generation)
    assert sorted(str(path.relative_to(tmp_path)) for path in tmp_path.glob("*/*")) == FILES
    for name in FILES:
        made, kept = tmp_path / name, FOLDER / name
        assert made.read_bytes()[:84] == kept.read_bytes()[:84], name
        # Numbers are micrometres; processors round a half-way value differently.
        assert np.abs(read_stl(made) - read_stl(kept)).max() < 1.1e-6, name
        assert (tmp_path / name).stat().st_size < 200_000, name


@pytest.mark.parametrize("name", FILES)
def test_surface_is_closed(name: str):
    corners = np.round(read_stl(FOLDER / name) * 1e6).astype(int)
    edges = Counter()
    for a, b, c in corners:
        edges.update([(*a, *b), (*b, *c), (*c, *a)])
    assert all(edges[(*edge[3:], *edge[:3])] == count for edge, count in edges.items())


@pytest.mark.parametrize("name", FILES)
def test_every_part_faces_outwards(name: str):
    triangles = read_stl(FOLDER / name)
    for part in connected_parts(triangles):
        a, b, c = (part[:, i] for i in range(3))
        volume = np.einsum("ij,ij->", a, np.cross(b, c)) / 6
        assert volume > 0


def connected_parts(triangles: np.ndarray) -> list:
    """Returns groups of triangles that share corners."""
    keys = np.round(triangles * 1e6).astype(int)
    _, labels = np.unique(keys.reshape(-1, 3), axis=0, return_inverse=True)
    labels = labels.reshape(-1, 3)
    group = np.arange(labels.max() + 1)
    while True:
        smallest = group[labels].min(axis=1)
        before = group.copy()
        for column in range(3):
            np.minimum.at(group, labels[:, column], smallest)
        if (group == before).all():
            break
    return [triangles[group[labels[:, 0]] == number] for number in np.unique(group[labels[:, 0]])]


def test_the_leg_types_mirror_each_other(generation: Generation):
    folder = FOLDER / generation.name
    first, second = read_stl(folder / "leg_type_1.STL"), read_stl(folder / "leg_type_2.STL")
    mirrored = (first * (-1, 1, 1))[:, ::-1]
    assert second == pytest.approx(mirrored, abs=1e-9)
