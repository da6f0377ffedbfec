# SPDX-License-Identifier: MIT
"""Puts a field, a terrain and a geofence together into a world, as the shell script of thesis Listing A.22 does."""

import argparse
import json
import shutil
from pathlib import Path
from typing import Dict, List, Optional, Sequence

import numpy as np

from ardee_common.cli import Parser, add_model_path, run, say
from ardee_common.errors import GeneratorError, known_names
from ardee_common.output import model_directory, write_file
from ardee_models.lookup import find_model, search_path
from ardee_models.metadata import model_config
from ardee_models.terrain.ground import ground_model
from ardee_models.terrain.height_map import Ground
from ardee_world.field_config import FAR_M
from ardee_world.moving import (
    Truth,
    move_model,
    move_plots,
    move_start,
    origin_of,
    place_truth,
    read_truth,
    seat_plots,
)
from ardee_world.seating import is_generated, own_pose, read_table, seat, seat_table, table_name
from ardee_world.start import Start, read_start, start_file
from ardee_world.urdf_file import check_xml, split_field
from ardee_world.writers.truth_files import csv_text
from ardee_world.writers.world import world_text

FIELD, HEIGHTMAP = "custom_field", "custom_heightmap"
GEOFENCE = Path("ardee_geofence") / "custom_gps_behavior.geofence"


def find_file(name: str, folders: Sequence[Path], what: str) -> Path:
    """A file by its path, or its path below one of the folders."""
    for path in (Path(name), *(folder / name for folder in folders)):
        if path.is_file():
            return path
    ending = "".join(Path(name).suffixes)
    beside = {
        str(path.relative_to(folder))
        for folder in folders
        for path in (folder / name).parent.glob(f"*{ending}")
    }
    looked = ", ".join(map(str, dict.fromkeys((Path.cwd(), *folders))))
    raise GeneratorError(
        f"{what} {name!r}: no such file, {known_names(name, sorted(beside))} (looked in {looked})"
    )


def find_field(name: str, folders: Sequence[Path], models: Sequence[Path]) -> Path:
    """A .urdf.xacro file by its path, or that of a field's model directory by its path or its name."""
    for path in (Path(name), *(folder / name for folder in folders)):
        if (path / "model.config").is_file():
            return path.resolve() / f"{path.resolve().name}.urdf.xacro"
    if "/" not in name and not name.endswith(".xacro"):
        return find_model(name, models) / f"{name}.urdf.xacro"
    return find_file(name, folders, "field")


def find_terrain(name: str, folders: Sequence[Path], models: Sequence[Path]) -> Path:
    """A terrain's model directory by its path, else by its last part as name on the model path."""
    for path in (Path(name), *(folder / name for folder in folders)):
        if (path / "model.config").is_file():
            return path.resolve()
    return find_model(Path(name).name, models)


def _table(field: Path, model: str, ground: Optional[Ground]) -> Dict[str, str]:
    """Name and text of the table of plants beside a field's file, if it has one; seated on `ground` if given."""
    name = table_name(model)
    if name is None:
        return {}
    path = field.parent / name
    text = read_table(path)
    return {name: seat_table(text, path, ground, own_pose(model)) if ground else text}


def _truth(field: Path, models: Sequence[Path]) -> Optional[Truth]:
    """Ground truth beside a field's file, else that of the model of its name, if that has the same file."""
    name = field.name.replace(".urdf.xacro", "")
    for folder in (field.parent, *(path / name for path in models)):
        same, path = folder / field.name, folder / "truth.json"
        if path.is_file() and same.is_file() and same.read_bytes() == field.read_bytes():
            return read_truth(path)
    return None


def _write_truth(truth: Truth, folder: Path) -> None:
    (folder / "truth.json").write_text(json.dumps(truth) + "\n")
    for name, columns in (("truth.csv", truth["plants"]), ("clutter.csv", truth["clutter"])):
        if columns:
            with (folder / name).open("w") as file:
                file.writelines(csv_text(columns))


def _write_field(
    text: str, plots: str, table: Dict[str, str], truth: Optional[Truth], models: Path
) -> None:
    with model_directory(models, FIELD) as folder:
        about = "Field of customized crop plots"
        (folder / "model.config").write_text(model_config(FIELD, about))
        (folder / "model.sdf").write_text(text)
        (folder / "plots.xacro").write_text(plots)
        for name, rows in table.items():
            (folder / name).write_text(rows)
        if truth:
            _write_truth(truth, folder)


def _say_what_hangs(start: Start, truth: Optional[Truth], ground: Ground, terrain: str) -> None:
    """Warns of a start and of plants beside the terrain, where a robot falls and plants stand on air."""
    plants = truth["plants"] if truth else {"world_x_m": [], "world_y_m": []}
    places = np.column_stack(
        ([start.x_m, *plants["world_x_m"]], [start.y_m, *plants["world_y_m"]])
    ).astype(float)
    low, high = ground.bounds_m()
    beside = ((places < low) | (places > high)).any(axis=1)
    found = [f"the robot's start at ({start.x_m:g}, {start.y_m:g})"] * bool(beside[0])
    found += [f"{beside[1:].sum()} of {len(beside) - 1} plants"] * bool(beside[1:].any())
    if found:
        extent = f"x {low[0]:g} to {high[0]:g} m, y {low[1]:g} to {high[1]:g} m"
        say("assemble_world", f"found {' and '.join(found)} beside terrain {terrain} ({extent})")


def _refer_to_itself(folder: Path, old_name: str, new_name: str) -> None:
    """Makes the URIs of a copied model name the copy, so that the original need not be on a model path."""
    old, new = (f"://{name}/".encode() for name in (old_name, new_name))
    for sdf in sorted(folder.glob("*.sdf")):
        sdf.write_bytes(sdf.read_bytes().replace(old, new))


def assemble(args: argparse.Namespace) -> Path:
    """Writes a folder with models/, worlds/custom.world and ardee_geofence/; returns the world's path."""
    models: List[Path] = search_path(args.model_path)
    field = find_field(args.field, args.search, models)
    terrain = find_terrain(args.terrain, args.search, models)
    geofence = find_file(args.geofence, args.search, "geofence")
    model, plots = split_field(field)
    check_xml(geofence.read_text(encoding="utf-8", errors="replace"), geofence)
    start, truth = read_start(start_file(field)), _truth(field, models)
    if args.world_pose:
        if not is_generated(model):
            raise GeneratorError(f"{field}: not made by generate_field, so it cannot be moved")
        pose = own_pose(model)
        plots, start = move_plots(plots, pose, args.world_pose), move_start(
            start, pose, args.world_pose
        )
        model = move_model(model, args.world_pose)
    ground = ground_model(terrain.name, [terrain.parent, *models])
    seated = is_generated(model) and not args.keep_heights
    table = _table(field, model, ground if seated else None)
    if seated:
        model, plots = seat(model, ground), seat_plots(plots, ground)
    if truth:
        place_truth(truth, own_pose(model), ground if seated else None)
    start = start.on(ground)
    _say_what_hangs(start, truth, ground, terrain.name)
    out = args.output
    _write_field(model, plots, table, truth, out / "models")
    with model_directory(out / "models", HEIGHTMAP) as folder:
        shutil.copytree(terrain, folder, dirs_exist_ok=True)
        _refer_to_itself(folder, terrain.name, HEIGHTMAP)
    write_file(out / GEOFENCE, geofence.read_bytes())
    world = out / "worlds" / "custom.world"
    write_file(world.with_suffix(".start.yaml"), start.text().encode())
    origin = origin_of(truth) if truth else None
    write_file(world, world_text(HEIGHTMAP, FIELD, origin).encode())
    return world


def _place(text: str) -> float:
    """A number of a pose, within what a world holds."""
    value = float(text)
    if not abs(value) <= FAR_M:
        raise argparse.ArgumentTypeError(f"found {text}, expected at most {FAR_M:g}")
    return value


def make_parser() -> argparse.ArgumentParser:
    """Makes the parser of `python3 -m ardee_world.assemble_world`."""
    parser = Parser(prog="assemble_world", description=__doc__)
    parser.add_argument(
        "field", help=".urdf.xacro file of a field, or its model directory or that one's name"
    )
    parser.add_argument("terrain", help="model directory of a terrain, or its name")
    parser.add_argument("geofence", help="geofence file")
    parser.add_argument("--output", type=Path, required=True, help="folder to write into")
    parser.add_argument(
        "--search", type=Path, nargs="*", default=[], help="folders to which paths may be relative"
    )
    add_model_path(parser)
    parser.add_argument(
        "--world-pose",
        type=_place,
        nargs=3,
        metavar=("X", "Y", "YAW"),
        help="pose of the field in the world [m m rad]; default: the one that it was generated for",
    )
    parser.add_argument(
        "--keep-heights", action="store_true", help="do not set plants on the terrain"
    )
    return parser


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """Runs the command; prints the path of the world file."""
    return run(make_parser(), assemble, arguments)


if __name__ == "__main__":
    raise SystemExit(main())
