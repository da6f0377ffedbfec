# SPDX-License-Identifier: MIT
"""Pictures of a data set with the heat of their crop rows, and what makes them differ from one another."""
import json
import math
from pathlib import Path
from typing import List, Tuple

import cv2
import numpy as np

from ardee_common.errors import GeneratorError

SIZE_PX = 160, 112  # width, height of the network's picture
HEAT_PX = 80, 56  # of its answer
_WIDTH = 0.14  # of a row's heat: standard deviation, rows' distances
_LEAST_PX = 1.5  # least standard deviation
_FAR_PX = 8.0  # rows that are nearer to each other are not told apart


def heat_of(sample: dict) -> np.ndarray:
    """Returns the heat of the crop rows of a sample, float32[h, w] of SIZE_PX: 1 on a row, 0 between; NaN: any."""
    width, height = SIZE_PX
    scale = np.array([width / sample["width_px"], height / sample["height_px"]])
    lines = [(np.array(row["line_px"]) + 0.5) * scale for row in sample["rows"]]
    v = np.arange(height) + 0.5
    places = np.full((len(lines), height), np.nan)
    for place, line in zip(places, lines):
        line = line[np.argsort(line[:, 1])]
        inside = (v >= line[0, 1]) & (v <= line[-1, 1])
        place[inside] = np.interp(v[inside], line[:, 1], line[:, 0])
    horizon = (sample["vanishing_point_px"][1] + 0.5) * scale[1]
    gaps = np.diff(np.sort(places, axis=0), axis=0) / np.maximum(v - horizon, 1.0)
    heat = np.zeros((height, width), np.float32)
    if not np.isfinite(gaps).any():
        return heat
    distance = np.nanmedian(gaps) * np.maximum(v - horizon, 0.0)
    sigma = np.maximum(_WIDTH * distance, _LEAST_PX)[:, None]
    u = np.arange(width) + 0.5
    for place in places:
        bump = np.exp(-0.5 * ((u - place[:, None]) / sigma) ** 2)
        heat = np.fmax(heat, bump.astype(np.float32))
    heat[(distance > 0.0) & (distance < _FAR_PX)] = np.nan
    return heat


def read_split(folder: Path, split: str) -> Tuple[np.ndarray, np.ndarray]:
    """Returns the pictures uint8[n, h, w, 3] of a part of a data set, and their heats float32[n, h, w]."""
    files = sorted((folder / split / "samples").glob("*.json"))
    if not files:
        raise GeneratorError(
            f"{folder}: found no samples in {split}, expected a data set of ardee_datasets"
        )
    pictures: List[np.ndarray] = []
    heats = []
    for file in files:
        sample = json.loads(file.read_text())
        if sample["vanishing_point_px"] is None:
            continue
        picture = cv2.imread(str(folder / split / "rgb" / f"{file.stem}.png"))
        if picture is None:
            raise GeneratorError(f"{file}: found no picture of it in {split}/rgb")
        pictures.append(cv2.resize(picture[:, :, ::-1], SIZE_PX, interpolation=cv2.INTER_AREA))
        heats.append(heat_of(sample))
    return np.array(pictures), np.array(heats)


def answer(heat: np.ndarray) -> np.ndarray:
    """Returns a heat at the size of the network's answer."""
    return cv2.resize(heat, HEAT_PX, interpolation=cv2.INTER_AREA)


def varied(
    picture: np.ndarray, heat: np.ndarray, rng: np.random.Generator
) -> Tuple[np.ndarray, np.ndarray]:
    """Returns a picture and its heat as another camera, another light and another soil might have shown them."""
    width, height = SIZE_PX
    turn = cv2.getRotationMatrix2D(
        (width / 2, height / 2), float(rng.normal(0.0, 4.0)), float(rng.uniform(1.0, 1.5))
    )
    turn[:, 2] += rng.uniform(-0.1, 0.1, 2) * SIZE_PX
    if rng.random() < 0.5:
        turn = turn @ np.array([[-1.0, 0.0, width - 1.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
    seen = cv2.warpAffine(picture, turn, SIZE_PX, borderMode=cv2.BORDER_REFLECT)
    heat = cv2.warpAffine(heat, turn, SIZE_PX, borderMode=cv2.BORDER_CONSTANT, borderValue=math.nan)
    return coloured(seen, rng), heat


def coloured(picture: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Returns a picture with other hues, exposure, shadows, blur and noise."""
    hsv = cv2.cvtColor(picture, cv2.COLOR_RGB2HSV).astype(np.float32)
    hsv[..., 0] = (hsv[..., 0] + rng.normal(0.0, 8.0)) % 180.0
    hsv[..., 1] = np.clip(hsv[..., 1] * rng.uniform(0.3, 1.3), 0, 255)
    x = cv2.cvtColor(hsv.astype(np.uint8), cv2.COLOR_HSV2RGB).astype(np.float32) / 255.0
    x = x ** rng.uniform(0.5, 1.8) * rng.uniform(0.7, 1.4) * rng.uniform(0.85, 1.15, 3)
    for cells in (4, 16):  # spots of soil and light
        spots = rng.normal(0.0, 1.0, (cells, cells, 1)).astype(np.float32)
        spots = cv2.resize(spots, SIZE_PX, interpolation=cv2.INTER_CUBIC)
        x = x * np.exp(rng.uniform(0.0, 0.35) * spots)[..., None]
    if rng.random() < 0.5:
        x = cv2.GaussianBlur(x, (0, 0), float(rng.uniform(0.3, 1.5)))
    x = x + rng.normal(0.0, rng.uniform(0.0, 0.06), x.shape)
    return np.clip(255.0 * x, 0, 255).astype(np.uint8)
