# SPDX-License-Identifier: MIT
"""Writes pieces as binary glTF 2.0, which browsers show, with their textures inside."""

import io
import json
import struct
import warnings
from functools import lru_cache
from typing import Any, Dict, List, Optional, Sequence, Tuple

import numpy as np
from ardee_sim.view.shapes import Piece
from PIL import Image

_MOST_PX = 512  # width and height of a texture in the page
_FLOAT, _UINT = 5126, 5125  # component types of glTF


@lru_cache(maxsize=256)
def _encoded(path: str) -> Optional[Tuple[str, bytes]]:
    """Returns MIME type and bytes of a texture, no larger than the page needs; None if it cannot be read."""
    try:
        with Image.open(path) as opened:
            picture = opened.convert("RGBA")
    except (OSError, ValueError) as error:
        warnings.warn(f"{path}: {error}; shown without it", stacklevel=1)
        return None
    picture.thumbnail((_MOST_PX, _MOST_PX))
    output = io.BytesIO()
    if picture.getextrema()[3][0] == 255:
        picture.convert("RGB").save(output, "JPEG", quality=85)
        return "image/jpeg", output.getvalue()
    picture.save(output, "PNG")
    return "image/png", output.getvalue()


class _Writer:
    """Collects the parts of a glTF file."""

    def __init__(self) -> None:
        self.binary = bytearray()
        self.tree: Dict[str, List[Any]] = {
            name: []
            for name in ("accessors", "bufferViews", "images", "materials", "meshes", "textures")
        }
        self._images: Dict[str, Optional[int]] = {}

    def _add(self, name: str, value: Any) -> int:
        self.tree[name].append(value)
        return len(self.tree[name]) - 1

    def _block(self, data: bytes) -> int:
        self.binary += b"\0" * (-len(self.binary) % 4)
        view = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)}
        self.binary += data
        return self._add("bufferViews", view)

    def array(self, values: np.ndarray, with_bounds: bool = False) -> int:
        """Adds an array of float32 or uint32, and returns the number of its accessor."""
        component = _UINT if values.dtype == np.uint32 else _FLOAT
        kind = "SCALAR" if values.ndim == 1 else f"VEC{values.shape[1]}"
        accessor: Dict[str, Any] = {
            "bufferView": self._block(np.ascontiguousarray(values).tobytes()),
            "componentType": component,
            "count": len(values),
            "type": kind,
        }
        if with_bounds:
            accessor.update(min=values.min(axis=0).tolist(), max=values.max(axis=0).tolist())
        return self._add("accessors", accessor)

    def _texture(self, path: str) -> Optional[int]:
        if path not in self._images:
            encoded = _encoded(path)
            self._images[path] = None
            if encoded:
                image = {"mimeType": encoded[0], "bufferView": self._block(encoded[1])}
                self._images[path] = self._add(
                    "textures", {"source": self._add("images", image), "sampler": 0}
                )
        return self._images[path]

    def material(self, material: Dict[str, Any]) -> int:
        """Adds a material, and returns its number."""
        rgba = np.asarray(material["rgba"], float)
        linear = [*(rgba[:3] ** 2.2).tolist(), float(rgba[3])]  # files have sRGB, glTF has light
        look: Dict[str, Any] = {
            "baseColorFactor": linear,
            "metallicFactor": 0.0,
            "roughnessFactor": 1.0,
        }
        texture = self._texture(material["texture"]) if material["texture"] else None
        if texture is not None:
            look["baseColorTexture"] = {"index": texture}
        made: Dict[str, Any] = {"pbrMetallicRoughness": look, "doubleSided": material["two_sided"]}
        made["emissiveFactor"] = (np.clip(material["emissive"], 0, 1) ** 2.2).tolist()
        if rgba[3] < 1:
            made["alphaMode"] = "BLEND"
        elif material["alpha_rejection"] >= 0 and texture is not None:
            made.update(alphaMode="MASK", alphaCutoff=material["alpha_rejection"])
        return self._add("materials", made)

    def mesh(self, piece: Piece) -> None:
        """Adds a piece as a mesh."""
        attributes = {"POSITION": self.array(piece.vertices_m, with_bounds=True)}
        if piece.normals is not None:
            attributes["NORMAL"] = self.array(piece.normals)
        if len(piece.texcoords):
            # from v upwards to v downwards
            flipped = np.array([0, 1], np.float32) + piece.texcoords * np.array([1, -1], np.float32)
            attributes["TEXCOORD_0"] = self.array(flipped)
        primitive = {
            "attributes": attributes,
            "indices": self.array(piece.triangles.reshape(-1)),
            "material": self.material(piece.material),
        }
        self._add("meshes", {"primitives": [primitive]})

    def to_bytes(self) -> bytes:
        """Returns the file."""
        count = len(self.tree["meshes"])
        self.binary += b"\0" * (-len(self.binary) % 4)
        tree = {
            "asset": {"version": "2.0"},
            "scene": 0,
            "scenes": [{"nodes": list(range(count))}],
            "nodes": [{"mesh": k} for k in range(count)],
            "buffers": [{"byteLength": len(self.binary)}],
            "samplers": [{}],  # repeats
            **{name: values for name, values in self.tree.items() if values},
        }
        text = json.dumps(tree).encode()
        text += b" " * (-len(text) % 4)
        chunks = b"".join(
            struct.pack("<I4s", len(data), name) + data
            for name, data in ((b"JSON", text), (b"BIN\0", bytes(self.binary)))
        )
        return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def _joined(pieces: Sequence[Piece]) -> List[Piece]:
    """Returns the pieces with those of equal materials as one."""
    groups: Dict[str, List[Piece]] = {}
    for piece in pieces:
        if len(piece.triangles):
            key = repr((piece.material, piece.normals is None, len(piece.texcoords) > 0))
            groups.setdefault(key, []).append(piece)
    joined = []
    for group in groups.values():
        starts = np.cumsum([0] + [len(piece.vertices_m) for piece in group[:-1]])
        triangles = [piece.triangles + start for piece, start in zip(group, starts)]
        normals = [piece.normals for piece in group if piece.normals is not None]
        joined.append(
            Piece(
                np.concatenate([piece.vertices_m for piece in group]),
                np.concatenate(triangles).astype(np.uint32),
                group[0].material,
                np.concatenate([piece.texcoords for piece in group]),
                np.concatenate(normals) if normals else None,
            )
        )
    return joined


def write_glb(pieces: Sequence[Piece]) -> bytes:
    """Returns a binary glTF file of the pieces, in their own axes; empty if there is nothing to show."""
    writer = _Writer()
    for piece in _joined(pieces):
        writer.mesh(piece)
    return writer.to_bytes() if writer.tree["meshes"] else b""
