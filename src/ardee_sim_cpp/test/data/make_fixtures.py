#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the small pictures and meshes that the readers' tests use, whole and broken, beside this file."""
import pathlib
import struct

import numpy as np
from PIL import Image

HERE = pathlib.Path(__file__).resolve().parent
CORNERS = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
# Twelve triangles of the unit cube, counter-clockwise from outside; vertex = x + 2 y + 4 z.
CUBE = [
    (0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4),
    (2, 6, 7), (2, 7, 3), (0, 4, 6), (0, 6, 2), (1, 3, 7), (1, 7, 5),
]  # fmt: skip


def pictures(folder: pathlib.Path) -> None:
    """Writes 4 x 3 pixels: grey value 20 * (column + 4 * row), 16 bits 5000 times that index, RGBA with a hole."""
    index = np.arange(12).reshape(3, 4)
    grey = Image.fromarray((20 * index).astype(np.uint8))
    for name in ("grey8.png", "grey8.bmp", "grey8.tga", "grey8.tif"):
        grey.save(folder / name)
    grey.save(folder / "grey8.jpg", quality=100)
    Image.fromarray((5000 * index).astype(np.uint16)).save(folder / "grey16.png")
    Image.fromarray((5000 * index).astype(np.uint16)).save(folder / "grey16.tif")
    rgba = np.zeros((3, 4, 4), np.uint8)
    rgba[..., 0], rgba[..., 1], rgba[..., 2] = 10 * index, 250 - 10 * index, 128
    rgba[..., 3] = np.where(index == 5, 0, 255)
    Image.fromarray(rgba).save(folder / "rgba.png")
    Image.fromarray(rgba[..., :3]).save(folder / "rgb.png")
    for name in ("rgba.tga", "rgba.tif"):
        Image.fromarray(rgba).save(folder / name)
    for name in ("rgb.bmp", "rgb.tga", "rgb.tif"):
        Image.fromarray(rgba[..., :3]).save(folder / name)
    Image.fromarray(rgba[..., :3]).quantize(12).save(folder / "palette.png")
    flat = Image.new("RGB", (4, 3), (200, 100, 50))
    flat.save(folder / "flat.jpg", quality=100)
    flat.convert("CMYK").save(folder / "cmyk.jpg", quality=100)


def stl(scale: float, nan: bool = False) -> bytes:
    """Writes the cube as binary STL."""
    data = b"cube".ljust(80, b"\0") + struct.pack("<I", len(CUBE))
    for triangle in CUBE:
        data += struct.pack("<3f", 0, 0, 0)
        for vertex in triangle:
            data += struct.pack("<3f", *(scale * c for c in CORNERS[vertex]))
        data += b"\0\0"
    return data if not nan else data[:96] + struct.pack("<f", float("nan")) + data[100:]


def dae(unit: float, up: str, nodes: str, double_sided: bool = False, index_shift: int = 0) -> str:
    """Returns a Collada file of the unit cube's geometry under the given <node> elements."""
    places = " ".join(str(c) for corner in CORNERS for c in corner)
    corners = " ".join(str(v + index_shift) for triangle in CUBE for v in triangle)
    extra = (
        '<extra><technique profile="GOOGLEEARTH"><double_sided>1</double_sided></technique></extra>'
        if double_sided
        else ""
    )
    return f"""<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit name="u" meter="{unit}"/><up_axis>{up}</up_axis></asset>
  <library_effects><effect id="e"><profile_COMMON><technique sid="common"><lambert>
    <diffuse><color>0.2 0.4 0.6 1</color></diffuse>
  </lambert></technique>{extra}</profile_COMMON></effect></library_effects>
  <library_materials><material id="m" name="blueish"><instance_effect url="#e"/></material></library_materials>
  <library_geometries><geometry id="g" name="geometry"><mesh>
    <source id="p"><float_array id="a" count="24">{places}</float_array>
      <technique_common><accessor source="#a" count="8" stride="3">
        <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
      </accessor></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <triangles count="12" material="s"><input semantic="VERTEX" source="#v" offset="0"/><p>{corners}</p></triangles>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="vs">{nodes}</visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#vs"/></scene>
</COLLADA>
"""


def node(name: str, transform: str) -> str:
    """Returns a scene node that shows the cube."""
    return f"""
    <node id="id_{name}" name="{name}">{transform}<instance_geometry url="#g"><bind_material>
      <technique_common><instance_material symbol="s" target="#m"/></technique_common>
    </bind_material></instance_geometry></node>"""


def meshes(folder: pathlib.Path) -> None:
    """Writes cubes of all formats; the Collada ones with parts, units and up-axes."""
    (folder / "cube.stl").write_bytes(stl(1.0))
    (folder / "cube_mm.stl").write_bytes(stl(1000.0))
    (folder / "solid_header.stl").write_bytes(b"solid " + stl(1.0)[6:])
    obj = "o Cube\n" + "".join(f"v {x} {y} {z}\n" for x, y, z in CORNERS)
    (folder / "cube.obj").write_text(
        obj + "".join("f %d %d %d\n" % tuple(v + 1 for v in t) for t in CUBE)
    )
    parts = node("Stem", "") + node(
        "Leaf", "<translate>10 0 0</translate><rotate>0 0 1 90</rotate>"
    )
    (folder / "parts_z_up.dae").write_text(dae(1.0, "Z_UP", parts))
    (folder / "parts_y_up.dae").write_text(dae(1.0, "Y_UP", parts))
    (folder / "parts_inch.dae").write_text(dae(0.0254, "Z_UP", parts))
    (folder / "two_sided.dae").write_text(dae(1.0, "Z_UP", node("Leaf", ""), double_sided=True))
    (folder / "mirrored.dae").write_text(dae(1.0, "Z_UP", node("Leaf", "<scale>-1 1 1</scale>")))


def broken(folder: pathlib.Path) -> None:
    """Writes the same, broken in one way each."""
    png = (HERE / "images/grey16.png").read_bytes()
    noise = Image.fromarray(np.random.default_rng(0).integers(0, 256, (64, 64), np.uint8))
    noise.save(folder / "truncated.png")
    whole = (folder / "truncated.png").read_bytes()
    (folder / "truncated.png").write_bytes(whole[: len(whole) // 2])
    noise.save(folder / "truncated.jpg")
    whole = (folder / "truncated.jpg").read_bytes()
    (folder / "truncated.jpg").write_bytes(whole[: len(whole) // 2])
    # The header promises 2^30 x 2^30 pixels, with a right checksum.
    import zlib

    header = b"IHDR" + struct.pack(">IIBBBBB", 1 << 30, 1 << 30, 8, 0, 0, 0, 0)
    (folder / "huge.png").write_bytes(
        png[:12] + header + struct.pack(">I", zlib.crc32(header)) + png[33:]
    )
    (folder / "empty.png").write_bytes(b"")
    (folder / "text.png").write_text("this is no picture at all\n")
    Image.fromarray(np.zeros((1, 1), np.uint8)).save(folder / "one_pixel.png")
    (folder / "truncated.stl").write_bytes(stl(1.0)[:300])
    (folder / "truncated_ascii.stl").write_text(
        "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"
    )
    (folder / "nan.stl").write_bytes(stl(1.0, nan=True))
    (folder / "no_triangles.stl").write_bytes(b"cube".ljust(80, b"\0") + struct.pack("<I", 0))
    (folder / "lying_count.stl").write_bytes(
        stl(1.0)[:80] + struct.pack("<I", 4_000_000_000) + stl(1.0)[84:]
    )
    whole_dae = dae(1.0, "Z_UP", node("Leaf", ""))
    (folder / "truncated.dae").write_text(whole_dae[: len(whole_dae) * 2 // 3])
    (folder / "wrong_index.dae").write_text(dae(1.0, "Z_UP", node("Leaf", ""), index_shift=1000))
    (folder / "lying_count.dae").write_text(whole_dae.replace('count="24"', 'count="24000000000"'))
    (folder / "no_count.dae").write_text(whole_dae.replace('id="a" count', 'id="a" co9nt'))
    (folder / "word_index.dae").write_text(whole_dae.replace("<p>0 2 3", "<p>0 2 x"))
    (folder / "no_source.dae").write_text(whole_dae.replace('source="#a"', 'source="#b"'))
    (folder / "long_accessor.dae").write_text(whole_dae.replace('count="8"', 'count="80"'))
    (folder / "node_in_itself.dae").write_text(
        dae(1.0, "Z_UP", '<node id="n"><instance_node url="#n"/></node>')
    )
    (folder / "empty.dae").write_text("")
    (folder / "points.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\n")
    (folder / "huge_vertex.obj").write_text("v 0 0 0\nv 1e300 0 0\nv 0 1 0\nf 1 2 3\n")


if __name__ == "__main__":
    pictures(HERE / "images")
    meshes(HERE / "meshes")
    broken(HERE / "invalid")
