# SPDX-License-Identifier: MIT
"""A picture of crop models side by side, read back from their COLLADA files: look before you use them."""

import argparse
from pathlib import Path
from typing import List

import collada
import matplotlib
import numpy as np

from ardee_models.errors import GeneratorError

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402  (the backend is chosen first)
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # noqa: E402

_COLOURS = {"Stem": (0.5, 0.6, 0.3), "LeavesBase": (0.45, 0.5, 0.2), "LeavesMid": (0.3, 0.5, 0.16)}
_OTHER = {"LeavesTop": (0.35, 0.58, 0.22), "Tassel": (0.78, 0.7, 0.4)}
_LIGHT = np.array([0.4, -0.5, 0.77])


def _draw(axes: "pyplot.Axes", dae: Path) -> None:
    for geometry in collada.Collada(str(dae)).scene.objects("geometry"):
        for primitive in geometry.primitives():
            corners = primitive.vertex[primitive.vertex_index]
            normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
            normal /= np.linalg.norm(normal, axis=1, keepdims=True)
            shade = 0.55 + 0.45 * np.abs(normal @ _LIGHT)
            colour = np.array({**_COLOURS, **_OTHER}.get(geometry.original.name, (0.5, 0.5, 0.5)))
            axes.add_collection3d(
                Poly3DCollection(corners, facecolors=np.clip(shade[:, None] * colour, 0, 1))
            )


def draw_contact_sheet(models: List[Path], output: Path, height_m: float) -> None:
    """Draw each model directory at one scale."""
    figure = pyplot.figure(figsize=(3.2 * len(models), 6.4))
    for i, model in enumerate(models):
        dae = model / "meshes" / f"{model.name}.dae"
        if not dae.is_file():
            raise GeneratorError(f"{dae}: no such file")
        axes = figure.add_subplot(1, len(models), i + 1, projection="3d", proj_type="ortho")
        _draw(axes, dae)
        half = height_m / 4
        axes.set(xlim=(-half, half), ylim=(-half, half), zlim=(0, height_m), title=model.name)
        axes.set_box_aspect((1, 1, 2), zoom=1.6)
        axes.view_init(elev=2, azim=-60)
        axes.set_axis_off()
    figure.subplots_adjust(0, 0, 1, 0.95, 0, 0)
    figure.savefig(output, dpi=80)


def main() -> int:
    """Command `crop_contact_sheet`."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("models", nargs="+", type=Path, help="crop model directories")
    parser.add_argument("--output", type=Path, required=True, help="PNG to write")
    parser.add_argument("--height", type=float, default=2.4, help="height of each frame [m]")
    args = parser.parse_args()
    try:
        draw_contact_sheet(args.models, args.output, args.height)
    except GeneratorError as error:
        parser.exit(2, f"{parser.prog}: {error}\n")
    return 0
