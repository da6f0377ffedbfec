# SPDX-License-Identifier: MIT
"""Tests the package as a whole: every device file is included, every mesh reproduces, the helpers are correct."""
import importlib.util
import pathlib
import xml.etree.ElementTree as ElementTree

import collada
import numpy as np
import pytest
from device_numbers import devices, load
from xacro_runner import SOURCES, expand, read_stl

PACKAGE = SOURCES / "ardee_sensors"
HELPERS = """<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:include filename="$(find ardee_sensors)/urdf/all_sensors.urdf.xacro" />
  {body}
</robot>"""


def expand_body(folder: pathlib.Path, body: str) -> ElementTree.Element:
    """Returns the URDF of the macro calls in `body`."""
    file = folder / "helpers.urdf.xacro"
    file.write_text(HELPERS.format(body=body))
    return ElementTree.fromstring(expand(file))


def test_every_file_is_in_the_collection():
    lists = [PACKAGE / "urdf/all_sensors.urdf.xacro", PACKAGE / "urdf/includes/helpers.urdf.xacro"]
    collection = "".join(file.read_text() for file in lists)
    for file in set((PACKAGE / "urdf").rglob("*.urdf.xacro")) - set(lists):
        assert f"/{file.relative_to(PACKAGE)}" in collection


def vertices(path: pathlib.Path) -> np.ndarray:
    """Returns the corners of the triangles of a COLLADA file, m."""
    (triangles,) = collada.Collada(str(path)).geometries[0].primitives
    return triangles.vertex[triangles.vertex_index].reshape(-1, 3)


def assert_same_vertices(made: pathlib.Path, kept: pathlib.Path) -> None:
    assert vertices(made) == pytest.approx(vertices(kept), abs=1.1e-5)  # written to 0.01 mm


def test_the_encoder_of_listing_a_5_is_the_other_one_about_its_middle():
    corners = read_stl(PACKAGE / "meshes/encoder.stl").reshape(-1, 3)
    size_z_m = load("encoder")["size_z_m"]
    assert vertices(PACKAGE / "meshes/rotary_encoder.dae") == pytest.approx(
        corners - (0, 0, size_z_m / 2), abs=1e-5
    )


def test_the_script_makes_the_same_meshes(tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.syspath_prepend(str(PACKAGE / "scripts"))
    spec = importlib.util.spec_from_file_location("meshes", PACKAGE / "scripts/make_meshes.py")
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    script.write_meshes(tmp_path)
    names = sorted(path.name for path in (PACKAGE / "meshes").iterdir())
    assert sorted(path.name for path in tmp_path.iterdir()) == names
    assert_same_vertices(tmp_path / "rotary_encoder.dae", PACKAGE / "meshes/rotary_encoder.dae")
    names.remove("rotary_encoder.dae")
    for name in names:
        made, kept = tmp_path / name, PACKAGE / "meshes" / name
        assert made.read_bytes()[:84] == kept.read_bytes()[:84], name
        # Numbers are micrometres; processors round a half-way value differently.
        assert np.abs(read_stl(made) - read_stl(kept)).max() < 1.1e-6, name
        assert len(made.read_bytes()) < 200_000


@pytest.mark.parametrize("mesh", sorted(p.stem for p in (PACKAGE / "meshes").glob("*.stl")))
def test_meshes_have_the_sizes_of_the_devices(mesh: str):
    """The middle of the mounting face is the origin; each part of a device in parts has its own size."""
    if mesh == "checkerboard_black":  # a part of the scene, not a device
        return
    device, part = ("gps" if mesh == "antenna_3GO16" else mesh), ""
    if device not in devices():
        device, part = mesh.rsplit("_", 1)
        part += "_"
    x, y, z = (load(device)[f"{part}size_{axis}_m"] for axis in "xyz")
    corners = read_stl(PACKAGE / f"meshes/{mesh}.stl").reshape(-1, 3)
    assert corners.min(axis=0) == pytest.approx([-x / 2, -y / 2, 0], abs=1e-6)
    assert corners.max(axis=0) == pytest.approx([x / 2, y / 2, z], abs=1e-6)


@pytest.mark.parametrize(
    "call, moments",
    [
        ('inertial_box mass="12" x="1" y="2" z="3"', [13, 10, 5]),
        ('inertial_cylinder mass="12" radius="1" length="3"', [12, 12, 6]),
        ('inertial_sphere mass="5" radius="2"', [8, 8, 8]),
    ],
)
def test_inertia_of_simple_bodies(tmp_path: pathlib.Path, call: str, moments: list):
    name = call.split()[0]
    root = expand_body(
        tmp_path,
        f'<link name="a"><xacro:{call}><origin xyz="1 2 3" rpy="0 0 0"/></xacro:{name}></link>',
    )
    inertia = root.find("link/inertial/inertia")
    assert [float(inertia.get(k)) for k in ("ixx", "iyy", "izz")] == pytest.approx(moments)
    assert [float(inertia.get(k)) for k in ("ixy", "ixz", "iyz")] == [0, 0, 0]
    assert np.array_equal(root.find("link/inertial/origin").get("xyz").split(), ["1", "2", "3"])


def test_friction_block_holds_what_is_given_and_nothing_else(tmp_path: pathlib.Path):
    call = '<xacro:add_friction_gazebo parent="a" mu1="1.0" mu2="0.5" fdir1="{}" {}/>'
    plain = expand_body(tmp_path, call.format("0 0 0", "")).find("gazebo")
    assert {child.tag: child.text for child in plain} == {"mu1": "1.0", "mu2": "0.5"}
    full = expand_body(tmp_path, call.format("0 0 1", 'kp="5" kd="6" max_vel_m_s="0.1"'))
    values = {child.tag: child.text for child in full.find("gazebo")}
    expected = {"mu1": "1.0", "mu2": "0.5", "fdir1": "0 0 1", "kp": "5", "kd": "6", "maxVel": "0.1"}
    assert values == expected


def test_colors(tmp_path: pathlib.Path):
    body = '<link name="a"><visual><xacro:color_material color="orange"/></visual></link>'
    root = expand_body(tmp_path, body + '<xacro:color_gazebo parent="a" color="orange"/>')
    assert root.find("link/visual/material").get("name") == "orange"
    rgba = [float(v) for v in root.find("link/visual/material/color").get("rgba").split()]
    assert len(rgba) == 4 and all(0 <= v <= 1 for v in rgba)
    assert root.find("gazebo[@reference='a']/material").text == "Gazebo/Orange"
