# SPDX-License-Identifier: MIT
"""Reads models back: the folder of a model, the figures of its plant, the ground of its heightmap."""

import argparse
import json
import os
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from pathlib import Path
from typing import List, Sequence

import numpy as np
from PIL import Image

from ardee_common import data
from ardee_common.errors import GeneratorError, known_names
from ardee_models.plant.plant_metrics import METRICS_FILE
from ardee_models.terrain.height_map import Terrain

DEFAULT_OUTPUT = "the first of GAZEBO_MODEL_PATH that can be written and that no build made, else ~/.gazebo/models"


@dataclass(frozen=True)
class CropModel:
    """The figures of a crop model that a field generator needs."""

    name: str
    height_m: float
    stalk_radius_m: float
    label: int
    species: str = ""
    stage: str = ""


def own_models() -> Path:
    """The folder in the user's home where Gazebo and the simulator look for models."""
    return Path.home() / ".gazebo" / "models"


def search_path(extra: Sequence[Path] = ()) -> List[Path]:
    """Folders of models: `extra`, GAZEBO_MODEL_PATH, the one in the user's home, those of a wheel."""
    entries = os.environ.get("GAZEBO_MODEL_PATH", "").split(":")
    return [
        *extra,
        *(Path(entry) for entry in entries if entry),
        own_models(),
        *data.model_folders(),
    ]


def default_output() -> Path:
    """The first writable folder of GAZEBO_MODEL_PATH that no build made, else the one in the user's home.

    Models are found in both at once. A catkin space, marked by its file .catkin, goes when it is built anew,
    and a wheel's folder when it is installed anew.
    """
    for folder in search_path():
        if folder in data.model_folders():
            continue
        is_built = any((parent / ".catkin").exists() for parent in folder.resolve().parents)
        if folder.is_dir() and os.access(folder, os.W_OK) and not is_built:
            return folder
    return own_models()


def named_folder(text: str) -> Path:
    """Folder that an argument --output names."""
    if not text:
        raise argparse.ArgumentTypeError("found '', expected the name of a folder")
    return Path(text)


def find_model(name: str, folders: Sequence[Path]) -> Path:
    """The first folder/name that is a model directory."""
    if name in (".", "..") or "/" in name:
        raise GeneratorError(f"model {name!r}: expected the name of a folder, not a path")
    for folder in folders:
        if (folder / name / "model.config").is_file():
            return folder / name
    there = {path.parent.name for folder in folders for path in folder.glob("*/model.config")}
    raise GeneratorError(
        f"model {name!r}: not found, {known_names(name, sorted(there))}"
        f" (looked in {':'.join(map(str, folders))})"
    )


def sdf_root(model: Path) -> ElementTree.Element:
    """The root element of a model's SDF."""
    path = model / "model.sdf"
    try:
        return ElementTree.parse(path).getroot()
    except OSError as error:
        raise GeneratorError(f"{path}: cannot be read: {error.strerror}") from error
    except ElementTree.ParseError as error:
        raise GeneratorError(f"{path}: not valid XML: {error}") from error


def numbers(element: ElementTree.Element, tag: str, count: int, where: Path) -> List[float]:
    """Finite numbers that the text below a tag of a model's SDF holds."""
    text = element.findtext(tag, "")
    try:
        values = [float(word) for word in text.split()]
    except ValueError:
        values = []
    if len(values) != count or not np.isfinite(values).all():
        raise GeneratorError(
            f"{where}/model.sdf: <{tag}>: found {text!r}, expected {count} number(s)"
        )
    return values


def crop_model(name: str, folders: Sequence[Path]) -> CropModel:
    """Figures of a crop model from its metrics file, else from the cylinder it collides with, and then unlabelled."""
    model = find_model(name, folders)
    path = model / METRICS_FILE
    if not path.is_file():
        cylinder = sdf_root(model).find(".//collision/geometry/cylinder")
        if cylinder is None:
            raise GeneratorError(
                f"{model}: found neither {METRICS_FILE} nor a collision cylinder to tell its height"
            )
        height, radius = (
            numbers(cylinder, "length", 1, model)[0],
            numbers(cylinder, "radius", 1, model)[0],
        )
        data = {"height_m": height, "stalk_radius_m": radius, "label": 0}
        species = stage = ""
    else:
        try:
            data = json.loads(path.read_text(encoding="utf-8"))
            species, stage = (str(data.get(key, "")) for key in ("species", "stage"))
            data = {key: float(data[key]) for key in ("height_m", "stalk_radius_m", "label")}
        except (ValueError, KeyError, TypeError, AttributeError) as error:
            raise GeneratorError(
                f"{path}: expected numbers height_m, stalk_radius_m, label: {error!r}"
            ) from error
    if not 0 <= data["label"] <= 65535:
        raise GeneratorError(f"{model}: found label {data['label']:g}, expected 0 to 65535")
    if not (0.0 < data["height_m"] < 100.0 and 0.0 < data["stalk_radius_m"] < 10.0):
        raise GeneratorError(
            f"{model}: found height {data['height_m']} m, radius {data['stalk_radius_m']} m"
        )
    return CropModel(
        name, data["height_m"], data["stalk_radius_m"], int(data["label"]), species, stage
    )


def resource(uri: str, folders: Sequence[Path]) -> Path:
    """The file of file://a/b or model://a/b: in the first of `folders`, then of GAZEBO_RESOURCE_PATH, that has it."""
    path = Path(uri.split("://", 1)[-1])
    entries = os.environ.get("GAZEBO_RESOURCE_PATH", "").split(":")
    for folder in [*folders, *(Path(entry) for entry in entries if entry)]:
        if (folder / path).is_file():
            return folder / path
    return folders[0] / path


def _shares(pixels: np.ndarray, mode: str) -> np.ndarray:
    """Heights from 0 to 1. In 8 bits the brightest pixel is 1, or 1/255 if its value is 1. Floats are elevations."""
    if mode == "F":
        span = float(np.ptp(pixels))
        return (pixels - pixels.min()) / span if span > 0.0 else np.zeros(pixels.shape)
    if mode != "L":
        return pixels / 65535
    brightest = float(pixels.max())
    return pixels / (brightest if brightest > 1.0 else 255.0)


def terrain_model(name: str, folders: Sequence[Path]) -> Terrain:
    """The ground of a heightmap model as the simulator reads it: height = pos.z + share of the highest * size.z."""
    model = find_model(name, folders)
    heightmap = sdf_root(model).find(".//collision/geometry/heightmap")
    if heightmap is None:
        raise GeneratorError(f"{model}/model.sdf: no <heightmap> in a collision")
    uri = heightmap.findtext("uri", "").strip()
    size, pos = numbers(heightmap, "size", 3, model), numbers(heightmap, "pos", 3, model)
    image_path = resource(uri, [model.parent, *folders])
    if size[0] != size[1] or size[0] <= 0 or pos[:2] != [0.0, 0.0]:
        raise GeneratorError(
            f"{model}/model.sdf: <heightmap>: expected a square size, and pos 0 0 z"
        )
    try:
        with Image.open(image_path) as image:
            pixels = np.array(image)
            shares = _shares(pixels.astype(float), image.mode)
    except (OSError, ValueError) as error:
        raise GeneratorError(f"{image_path}: not a readable image: {error}") from error
    if pixels.ndim != 2 or pixels.shape[0] != pixels.shape[1] or pixels.shape[0] < 2:
        raise GeneratorError(
            f"{image_path}: found shape {pixels.shape}, expected a square grey image"
        )
    return Terrain(pos[2] + shares * size[2], size[0])
