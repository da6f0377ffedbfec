# SPDX-License-Identifier: MIT
"""The command `generate_dataset`: labelled pictures of the fields of a recipe."""

import argparse
import json
import os
import socket
from pathlib import Path
from typing import Dict, Iterator, List, Optional, Sequence, Tuple

from ardee_sim import ArdeeError

from ardee_common.cli import Parser, run, say, whole_in
from ardee_common.errors import GeneratorError, WorkersError
from ardee_common.output import FULL, locked, output_folder, scratch_folder, write_file
from ardee_common.process import end_if_told
from ardee_datasets.assemble import assemble, damaged, yolo_lack
from ardee_datasets.camera import CameraKeys
from ardee_datasets.drive import Drive
from ardee_datasets.inputs import digests
from ardee_datasets.lidar import Lidar
from ardee_datasets.plan import Scene, Shot, scenes, shot_count, shots
from ardee_datasets.recipe import Recipe, read_recipe
from ardee_datasets.sample import json_bytes, take
from ardee_datasets.scenery import CameraPose, Scenery

_TRUTH = ("truth.csv", "truth.json", "clutter.csv")


def _is_done(folder: Path, scene: Scene, shot: Shot) -> bool:
    file = folder / scene.keys.split / "samples" / f"{shot.id}.json"
    return file.is_file() and file.stat().st_size > 0


def is_complete(folder: Path, recipe: Recipe, scene: Scene) -> bool:
    """Returns whether all pictures of a scene are there."""
    return all(_is_done(folder, scene, shot) for shot in shots(recipe, scene))


def _todo(folder: Path, recipe: Recipe) -> List[Scene]:
    """Returns the scenes of which pictures are missing, or were changed after the set was finished."""
    changed: Dict[str, str] = {}
    for name in sorted(damaged(folder)):
        path = Path(name)  # such as train/rgb/corn_0000_000003.png, truth/corn_0000/truth.csv
        changed.setdefault(path.stem.rpartition("_")[0], name)
        changed.setdefault(path.parent.name, name)
    todo = []
    for scene in scenes(recipe):
        if scene.name in changed:
            say(
                "generate_dataset",
                f"{changed[scene.name]}: missing or changed, {scene.name} is made again",
            )
        if scene.name in changed or not is_complete(folder, recipe, scene):
            todo.append(scene)
    return todo


def _views(
    recipe: Recipe, scene: Scene, scenery: Scenery
) -> Iterator[Tuple[Shot, CameraKeys, CameraPose]]:
    """Yields the pictures of a scene with their cameras and poses; robots come and drive after all other cameras."""
    drive = None
    for shot in shots(recipe, scene):
        if not shot.robot:
            keys = recipe.cameras[shot.camera]
            yield shot, keys, scenery.draw_pose(keys, shot.seed)
            continue
        robot = recipe.robots[shot.robot]
        if drive is None or drive.name != shot.robot:
            if drive is not None:
                drive.close()
            drive = Drive(scenery, shot.robot, robot, scene.seed)
        drive.to((shot.place + 0.5) / scene.keys.frames * drive.length_m)
        camera = robot.cameras[shot.camera]
        yield shot, camera.keys, drive.pose(camera)


def make_scene(folder: Path, recipe: Recipe, scene: Scene) -> str:
    """Sows the field of a scene and takes its pictures; returns the name of the scene.

    All in order, also those that are there: a picture may depend on the ones that its simulation took before.
    """
    host = socket.gethostname()
    if not folder.is_dir():
        expected = "expected the folder of the data set under the same path on all workers"
        raise GeneratorError(f"{folder}: found no such folder on {host}, {expected}")
    try:
        with scratch_folder("ardee_field_") as temporary:
            _take_pictures(folder, recipe, scene, Scenery(scene, temporary))
    except (GeneratorError, ArdeeError) as error:
        raise GeneratorError(f"{scene.name}: {error}") from None
    except OSError as error:
        if error.errno not in FULL:
            raise
        disk = f"{error.filename or folder} on {host}: {error.strerror}"
        raise WorkersError(f"{disk}; free some and start again to go on") from None
    return scene.name


def _take_pictures(folder: Path, recipe: Recipe, scene: Scene, scenery: Scenery) -> None:
    for name in _TRUTH:
        if (scenery.folder / name).is_file():
            truth = (scenery.folder / name).read_bytes()
            write_file(folder / "truth" / scene.name / name, truth)
    lidars = {
        name: Lidar(scenery.simulation, name, keys)
        for name, keys in sorted((recipe.lidars or {}).items())
    }
    for shot, camera, pose in _views(recipe, scene, scenery):
        take(scene, shot, camera, pose, scenery, lidars, folder)


def _work_off(
    folder: Path, recipe: Recipe, todo: Sequence[Scene], args: argparse.Namespace
) -> None:
    """Makes the scenes, in any order. Raises WorkersError if it cannot go on."""
    for number, name in enumerate(_made(folder.resolve(), recipe, todo, args), 1):
        end_if_told()
        say("generate_dataset", f"{name}: {number} of {len(todo)} fields")


def _made(
    folder: Path, recipe: Recipe, todo: Sequence[Scene], args: argparse.Namespace
) -> Iterator[str]:
    """Makes the scenes; yields the name of each."""
    workers = min(args.workers, len(todo))
    if not todo or (workers == 1 and not args.scheduler):
        yield from (make_scene(folder, recipe, scene) for scene in todo)
        return
    try:
        from ardee_common.cluster import worked_off
    except ImportError as error:
        expected = "expected dask (pip install 'ardee[data]'), or --workers 1"
        raise GeneratorError(f"found {error}, {expected}") from None
    inputs = {scene.name: (folder, recipe, scene) for scene in todo}
    yield from worked_off(make_scene, inputs, args.scheduler, workers)


def _check_same(folder: Path, recipe_file: Path, recipe: Recipe) -> None:
    """Refuses a folder that holds another data set, or something else."""
    given = {"dataset.yaml": recipe_file.read_bytes(), "inputs.json": json_bytes(digests(recipe))}
    there = {path.name for path in folder.iterdir()}
    is_begun = there < set(given) and all(
        (folder / name).read_bytes() == given[name] for name in there
    )
    if is_begun or there == set(given):
        for name, content in given.items():
            write_file(folder / name, content)  # new, or of a recipe that was refused
        return
    for name in given:
        if not (folder / name).is_file():
            found = f"found files in {folder} and no {name}"
            raise GeneratorError(f"--output: {found}, expected an empty folder")
    if (folder / "dataset.yaml").read_bytes() != given["dataset.yaml"]:
        raise GeneratorError(f"--output: found {folder} of another recipe, expected {recipe_file}")
    before, now = (
        json.loads(text) for text in ((folder / "inputs.json").read_bytes(), given["inputs.json"])
    )
    changed = sorted(name for name in {**before, **now} if before.get(name) != now.get(name))
    if changed:
        found = f"found {folder} of another {changed[0]} than there is now"
        raise GeneratorError(f"--output: {found}, expected a new folder")


def plan_text(recipe: Recipe) -> str:
    """Returns the plan of a recipe in words: a line for each field, and the count."""
    planned = scenes(recipe)
    counts = [shot_count(recipe, scene) for scene in planned]
    lines = [
        f"{scene.name}  {scene.keys.split}  {count} pictures"
        for scene, count in zip(planned, counts)
    ]
    return "\n".join((*lines, f"{len(planned)} fields, {sum(counts)} pictures"))


def generate(args: argparse.Namespace) -> Optional[str]:
    """Writes the data set that the arguments ask for, or the rest of it."""
    recipe = read_recipe(args.recipe)
    if args.list:
        return plan_text(recipe)
    if args.output is None:
        raise GeneratorError("found no --output, expected a folder for the data set")
    with output_folder(args.output) as folder, locked(folder):
        _check_same(folder, args.recipe, recipe)
        lack = yolo_lack({keys.split for keys in recipe.fields.values()})
        if lack:
            say("generate_dataset", f"warning: {lack}")
        _work_off(folder, recipe, _todo(folder, recipe), args)
        assemble(folder, recipe)
    return str(args.output)


def make_parser() -> argparse.ArgumentParser:
    """Makes the parser of generate_dataset."""
    parser = Parser(
        prog="generate_dataset",
        description="Write a data set of labelled pictures; one that was interrupted goes on.",
    )
    parser.add_argument("recipe", type=Path, metavar="RECIPE.yaml", help="recipe of the data set")
    parser.add_argument("--output", type=Path, metavar="DIR", help="folder of the data set")
    parser.add_argument("--list", action="store_true", help="print the plan and write nothing")
    parser.add_argument(
        "--workers",
        type=whole_in(1, 1024),
        default=len(os.sched_getaffinity(0)),
        metavar="N",
        help="number of processes of this machine, which share the fields (default: that of its processors)",
    )
    parser.add_argument(
        "--scheduler",
        metavar="tcp://HOST:PORT",
        help="dask scheduler whose workers take the pictures instead of this machine's; the output folder has the same"
        " path on all of them",
    )
    return parser


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """Runs `generate_dataset RECIPE.yaml --output DIR`."""
    return run(make_parser(), generate, arguments)
