# SPDX-License-Identifier: MIT
"""Tests what the viewer sends to the page: triangles, files, points, pictures, rows."""
import json
import struct
from pathlib import Path
from typing import Any, Dict

import ardee_sim
import numpy as np
import pytest
from ardee_sim.view.glb import write_glb
from ardee_sim.view.readings import picture_of, points_of
from ardee_sim.view.rows import row_lines
from ardee_sim.view.shapes import Piece, ground_pieces, pieces_of
from PIL import Image

PLAIN = {
    "rgba": np.array([1.0, 0.5, 0.0, 1.0]),
    "emissive": np.zeros(3),
    "texture": "",
    "two_sided": False,
    "alpha_rejection": -1.0,
}
TURNED = np.array([0.0, 0.0, np.sqrt(0.5), np.sqrt(0.5)])  # a quarter to the left


def shape(kind: str, **numbers: Any) -> Dict[str, Any]:
    pose = dict(xyz_m=np.array([1.0, 2.0, 3.0]), quat_xyzw=TURNED)
    return {"kind": kind, "material": PLAIN, "has_material": True, **pose, **numbers}


def volume_m3(piece: Piece) -> float:
    """Returns the volume within a closed surface, negative if its triangles look inwards."""
    a, b, c = (piece.vertices_m[piece.triangles[:, k]].astype(float) for k in range(3))
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


@pytest.mark.parametrize(
    "solid, expected_m3",
    [
        (shape("box", size_m=np.array([1.0, 2.0, 3.0])), 6.0),
        (shape("sphere", radius_m=0.5), 4 / 3 * np.pi * 0.5**3),
        (shape("cylinder", radius_m=0.5, length_m=2.0), np.pi * 0.5),
    ],
)
def test_solids_are_closed_and_look_outwards(solid: Dict[str, Any], expected_m3: float) -> None:
    (piece,) = pieces_of([solid])
    assert volume_m3(piece) == pytest.approx(expected_m3, rel=0.05)  # of 24 sides
    middle = (piece.vertices_m.min(axis=0) + piece.vertices_m.max(axis=0)) / 2
    assert middle == pytest.approx([1, 2, 3], abs=1e-6)


def test_a_plane_looks_along_its_normal() -> None:
    plane = shape("plane", normal=np.array([0.0, 1.0, 0.0]), size_m=np.array([2.0, 4.0]))
    (piece,) = pieces_of([plane])
    a, b, c = (piece.vertices_m[piece.triangles[:, k]] for k in range(3))
    # y of the shape is -x of the link, and each triangle half of 8 m2
    assert np.cross(b - a, c - a) == pytest.approx(np.array([[-8.0, 0, 0]] * 2), abs=1e-5)


def test_a_ground_near_a_place_has_its_heights_and_the_textures_of_its_heights() -> None:
    y, x = np.mgrid[-50:50:501j, -50:50:501j]
    ground = shape(
        "heightmap",
        heights_m=(0.1 * x + 0.02 * y).astype(np.float32),
        size_m=np.array([100.0, 100.0]),
        position_m=np.array([0.0, 0.0, 0.5]),
        textures=[("low.png", 1.0), ("high.png", 2.0)],
        blends=[(1.0, 0.0)],
    )
    pieces = ground_pieces(ground, 1.0, 12.0, 5.0)  # 10 m along x of the map
    assert [piece.material["texture"] for piece in pieces] == ["low.png", "high.png"]
    for piece in pieces:
        # the map's x is the link's y - 2, its y the link's 1 - x
        x_m, y_m = piece.vertices_m[:, 1] - 2, 1 - piece.vertices_m[:, 0]
        assert np.abs(np.stack([x_m - 10, y_m])).max() == pytest.approx(5.0, abs=0.21)
        assert piece.vertices_m[:, 2] == pytest.approx(3.5 + 0.1 * x_m + 0.02 * y_m, abs=1e-4)
        assert piece.normals is not None
        slope = np.array([0.02, -0.1, 1.0]) / np.linalg.norm([0.02, 0.1, 1.0])
        assert piece.normals == pytest.approx(np.tile(slope, (len(x_m), 1)), abs=1e-3)
    assert sum(len(piece.triangles) for piece in pieces) == 2 * 50 * 50
    assert ground_pieces(ground, 1.0, 200.0, 5.0) == []


def test_a_file_joins_equal_materials_and_holds_its_texture(tmp_path: Path) -> None:
    path = tmp_path / "leaf.png"
    Image.new("RGBA", (1024, 512), (0, 255, 0, 100)).save(path)
    leaf = {**PLAIN, "texture": str(path), "two_sided": True, "alpha_rejection": 0.5}
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32)
    one = Piece(corners, np.array([[0, 1, 2]], np.uint32), leaf, corners[:, :2])
    other = Piece(corners + 1, np.array([[0, 1, 2]], np.uint32), leaf, corners[:, :2])
    data = write_glb([one, *pieces_of([shape("box", size_m=np.ones(3))]), other])
    magic, version, length, json_length = struct.unpack("<4sIII", data[:16])
    assert (magic, version, length) == (b"glTF", 2, len(data))
    tree = json.loads(data[20 : 20 + json_length])
    assert len(tree["meshes"]) == len(tree["materials"]) == 2 and len(tree["images"]) == 1
    leaves, box = tree["materials"]
    assert (leaves["alphaMode"], leaves["alphaCutoff"], leaves["doubleSided"]) == (
        "MASK",
        0.5,
        True,
    )
    assert box["pbrMetallicRoughness"]["baseColorFactor"] == pytest.approx(
        [1, 0.5**2.2, 0, 1], abs=1 / 255
    )
    binary = data[28 + json_length :]
    image = tree["bufferViews"][tree["images"][0]["bufferView"]]
    begin = image["byteOffset"]
    (tmp_path / "back.png").write_bytes(binary[begin : begin + image["byteLength"]])
    assert Image.open(tmp_path / "back.png").size == (512, 256)
    indices = tree["accessors"][tree["meshes"][0]["primitives"][0]["indices"]]
    begin = tree["bufferViews"][indices["bufferView"]]["byteOffset"]
    assert np.frombuffer(binary, np.uint32, 6, begin).tolist() == [0, 1, 2, 3, 4, 5]


def test_a_texture_that_cannot_be_read_is_said_and_left_out(tmp_path: Path) -> None:
    (piece,) = pieces_of([shape("box", size_m=np.ones(3))])
    lost = {**PLAIN, "texture": str(tmp_path / "lost.png")}
    with pytest.warns(UserWarning, match="lost.png.*shown without it"):
        data = write_glb([Piece(piece.vertices_m, piece.triangles, lost, piece.vertices_m[:, :2])])
    assert b'"images"' not in data


def test_points_of_a_scan_lie_where_its_beams_ended() -> None:
    ranges_m = np.array([1.0, np.inf, 2.0, -np.inf], np.float32)
    scan = ardee_sim.LidarReading(
        0, "lidar", 0.0, 3.0, np.pi / 4, 0.0, 0.025, 0.1, 30.0, ranges_m, ranges_m
    )
    assert points_of(scan) == pytest.approx(np.array([[1.0, 0, 0], [0, 2.0, 0]]), abs=1e-6)


def test_pictures_of_all_kinds_become_rgb() -> None:
    def shown(encoding: str, pixels: np.ndarray) -> np.ndarray:
        return picture_of(ardee_sim.ImageReading(0, "camera", encoding, pixels))

    assert shown("bgr8", np.array([[[1, 2, 3]]], np.uint8)).tolist() == [[[3, 2, 1]]]
    depths = np.array([[5.0, np.inf, np.nan, 20.0]], np.float32)
    assert shown("32FC1", depths)[0, :, 0].tolist() == [127, 255, 255, 255]
    assert shown("mono16", np.array([[0x8001]], np.uint16)).tolist() == [[[128, 128, 128]]]
    labels = shown("16UC1", np.array([[0, 1, 2]], np.uint16))
    assert labels[0, 0].tolist() == [0, 0, 0] and len({tuple(pixel) for pixel in labels[0]}) == 3
    assert shown("rgb8", np.zeros((720, 1280, 3), np.uint8)).shape == (240, 427, 3)


def test_rows_are_lines_from_stalk_to_stalk(corn: ardee_sim.World) -> None:
    segments, colors = row_lines(corn)
    rows = {(plant.plot, plant.row) for plant in corn.plants()}
    assert len(segments) == len(corn.plants()) - len(rows) and colors.shape == segments.shape
    lengths_m = np.linalg.norm(segments[:, 1] - segments[:, 0], axis=1)
    assert 0.05 < np.median(lengths_m) < 0.5 and lengths_m.max() < 2.0
