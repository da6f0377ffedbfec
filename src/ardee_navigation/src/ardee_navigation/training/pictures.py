# SPDX-License-Identifier: MIT
"""Pictures of a data set with their crop rows, and the heat of these as a network is to answer it."""
import json
from dataclasses import dataclass
from pathlib import Path
from typing import List, Optional, Tuple

import cv2
import numpy as np

from ardee_common.errors import GeneratorError

SIZE_PX = 320, 224  # width, height of the network's picture
HEAT_PX = 160, 112  # of its answer
_WIDTH = 0.14  # of a row's heat: standard deviation, rows' distances
_LEAST_PX = 0.75  # least standard deviation
_FAR_PX = 4.0  # rows that are nearer to each other are not told apart


@dataclass(frozen=True)
class Picture:
    """A picture with its truth.

    rgb : uint8[h, w, 3]
    is_plant : uint8[h, w], 1 on crops and weeds
    rows : lines [n, 2] of pixels, along the crop rows
    meeting_px : vanishing point of the rows before the camera
    """

    rgb: np.ndarray
    is_plant: np.ndarray
    rows: List[np.ndarray]
    meeting_px: np.ndarray


def heat_of(rows: List[np.ndarray]) -> np.ndarray:
    """Returns the heat of crop rows, lines [n, 2] in pixels of HEAT_PX, float32[h, w]: 1 on a row, 0 between; NaN: any.

    Pixel i reaches from i to i + 1.
    """
    width, height = HEAT_PX
    v = np.arange(height) + 0.5
    places = np.full((len(rows), height), np.nan)
    for place, line in zip(places, rows):
        line = line[np.argsort(line[:, 1])]
        inside = (v >= line[0, 1]) & (v <= line[-1, 1])
        place[inside] = np.interp(v[inside], line[:, 1], line[:, 0])
    if not np.isfinite(places).any():
        return np.zeros((height, width), np.float32)
    distance = _distance(np.sort(places, axis=0), v)
    if distance is None:
        return np.full((height, width), np.nan, np.float32)
    u = (np.arange(width) + 0.5).astype(np.float32)
    nearest = np.full((height, width), np.inf, np.float32)
    for place in places:
        nearest = np.fmin(nearest, np.abs(u - place[:, None].astype(np.float32)))
    sigma = np.maximum(_WIDTH * distance, _LEAST_PX)[:, None].astype(np.float32)
    heat = np.exp(-0.5 * (nearest / sigma) ** 2)
    heat[(distance > 0.0) & (distance < _FAR_PX)] = np.nan
    return heat


def _distance(places: np.ndarray, v: np.ndarray) -> Optional[np.ndarray]:
    """Returns the rows' distance in each picture row, from places [row, v] in order; None if none is known.

    It grows evenly from the horizon down; where fewer than two rows are seen it is what it is below and above.
    """
    gaps = np.diff(places, axis=0)
    known = np.isfinite(gaps).any(axis=0) if len(gaps) else np.zeros(len(v), bool)
    if known.sum() < 2:
        return None
    middle = np.nanmedian(gaps[:, known], axis=0)
    return np.maximum(np.polyval(np.polyfit(v[known], middle, 1), v), 0.0)


def read_split(folder: Path, split: str) -> List[Picture]:
    """Returns the pictures of a part of a data set in which rows are seen from along them."""
    files = sorted((folder / split / "samples").glob("*.json"))
    if not files:
        raise GeneratorError(
            f"{folder}: found no samples in {split}, expected a data set of ardee_datasets"
        )
    pictures = []
    for file in files:
        sample = json.loads(file.read_text())
        if sample["vanishing_point_px"] is None:
            continue
        layers = [folder / split / layer / f"{file.stem}.png" for layer in ("rgb", "labels")]
        picture, labels = (cv2.imread(str(path), cv2.IMREAD_UNCHANGED) for path in layers)
        if picture is None or labels is None:
            raise GeneratorError(f"{file}: found no picture of it in {split}/rgb and labels")
        rows = [np.array(row["line_px"]) + 0.5 for row in sample["rows"]]
        is_plant = ((labels > 0) & (labels <= 10)).astype(np.uint8)
        meeting = np.array(sample["vanishing_point_px"]) + 0.5
        pictures.append(Picture(np.ascontiguousarray(picture[:, :, ::-1]), is_plant, rows, meeting))
    return pictures


def whole(picture: Picture) -> Tuple[np.ndarray, np.ndarray]:
    """Returns a picture at SIZE_PX, uint8[h, w, 3], and the heat of its rows."""
    height, width = picture.rgb.shape[:2]
    scale = np.array(HEAT_PX) / (width, height)
    rgb = cv2.resize(picture.rgb, SIZE_PX, interpolation=cv2.INTER_AREA)
    return rgb, heat_of([line * scale for line in picture.rows])
