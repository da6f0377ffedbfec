# SPDX-License-Identifier: MIT
"""A 3D mesh as terrain (thesis Figure 4.11): read by assimp, as the simulator reads it, turned z upwards, in metres."""

import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ardee_common.errors import GeneratorError
from ardee_models.terrain.surface import MeshGround

UPS = ("auto", "y", "z")
_TIMEOUT_S = 300
_MAX_BYTES = 1 << 30
_MAX_TRIANGLES = 5_000_000
_STL_HEADER_BYTES = 84
_STL = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
# formats that assimp turns to y upwards when it reads them
_Y_UP_FORMATS = (".dae", ".gltf", ".glb")


@dataclass(frozen=True)
class MeshOptions:
    """Options by which a mesh becomes ground."""

    scale: float = 1.0  # length of the file's unit [m], if the file does not give it
    up: str = "auto"
    center: bool = True  # move the middle of its bounds to the origin, and the ground there to zero


def _to_stl(path: Path, folder: Path) -> np.ndarray:
    """Corners (n, 3, 3) of all triangles in the scene, read by a separate process because files may be hostile."""
    tool = shutil.which("assimp")
    if tool is None:
        raise GeneratorError(
            "found no program 'assimp', expected the one of Debian's package assimp-utils"
        )
    made = folder / "mesh.stl"
    command = [tool, "export", str(path.resolve()), str(made), "-fstlb", "-tri", "-ptv"]
    try:
        result = subprocess.run(command, capture_output=True, text=True, timeout=_TIMEOUT_S)
    except subprocess.TimeoutExpired as error:
        raise GeneratorError(f"{path}: could not be read in {_TIMEOUT_S} s") from error
    if not made.is_file():
        lines = [line for line in result.stdout.splitlines() if line.startswith("ERROR")]
        raise GeneratorError(
            f"{path}: not a readable mesh: {lines[0] if lines else 'assimp failed'}"
        )
    return np.fromfile(made, dtype=_STL, offset=_STL_HEADER_BYTES)["corners"].astype(float)


def read_mesh(path: Path, options: MeshOptions) -> MeshGround:
    """Reads the mesh and joins equal corners."""
    if not (np.isfinite(options.scale) and 1e-6 <= options.scale <= 1e6):
        raise GeneratorError(f"mesh scale: found {options.scale}, expected 1e-6 to 1e6")
    if options.up not in UPS:
        raise GeneratorError(f"mesh up: found {options.up!r}, expected one of {', '.join(UPS)}")
    if not path.is_file():
        raise GeneratorError(f"{path}: cannot be read: no such file")
    if path.stat().st_size > _MAX_BYTES:
        raise GeneratorError(f"{path}: found more than {_MAX_BYTES} bytes, expected fewer")
    with tempfile.TemporaryDirectory() as folder:
        corners = _to_stl(path, Path(folder))
    if not 1 <= len(corners) <= _MAX_TRIANGLES or not np.isfinite(corners).all():
        raise GeneratorError(
            f"{path}: found {len(corners)} triangles, expected 1 to {_MAX_TRIANGLES} with finite corners"
        )
    up = options.up
    if up == "auto":
        up = "y" if path.suffix.lower() in _Y_UP_FORMATS else "z"
    if up == "y":
        corners = np.stack((corners[..., 0], -corners[..., 2], corners[..., 1]), axis=-1)
    corners = corners * options.scale
    vertices, index = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    triangles = index.reshape(-1, 3)
    a, b, c = (triangles[:, k] for k in range(3))
    ground = MeshGround(vertices, triangles[(a != b) & (b != c) & (c != a)])
    if len(ground.triangles) == 0 or np.ptp(vertices[:, :2], axis=0).min() < 1e-3:
        raise GeneratorError(
            f"{path}: found no area seen from above, expected a surface that spans x and y"
        )
    return _centred(ground) if options.center else ground


def _centred(ground: MeshGround) -> MeshGround:
    low, high = ground.vertices_m.min(axis=0), ground.vertices_m.max(axis=0)
    middle = 0.5 * (low + high)
    here = float(ground.height_at(middle[:1], middle[1:2])[0])
    shift = np.array([middle[0], middle[1], here])
    return MeshGround(ground.vertices_m - shift, ground.triangles)
