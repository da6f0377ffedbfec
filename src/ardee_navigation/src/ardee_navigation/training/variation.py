# SPDX-License-Identifier: MIT
"""Pictures as another camera, another light, other plants and another soil might have shown them."""
import math
from typing import Tuple

import cv2
import numpy as np

from ardee_navigation.training.pictures import HEAT_PX, SIZE_PX, Picture, heat_of

_WIDTH, _HEIGHT = SIZE_PX
_CORNERS = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])
_SMALLEST = 0.55  # part of a picture that is shown


def varied(picture: Picture, rng: np.random.Generator) -> Tuple[np.ndarray, np.ndarray]:
    """Returns a part of a picture at SIZE_PX, uint8[h, w, 3], altered, and the heat of its rows."""
    turn = _turn(picture.rgb.shape[:2], rng)
    seen = cv2.warpPerspective(picture.rgb, turn, SIZE_PX, borderMode=cv2.BORDER_REFLECT)
    plant = cv2.warpPerspective(picture.is_plant.astype(np.float32), turn, SIZE_PX)
    (meeting,) = _carried(turn, picture.meeting_px[None])
    to_heat = np.diag([HEAT_PX[0] / _WIDTH, HEAT_PX[1] / _HEIGHT, 1.0]) @ turn
    heat = heat_of([_carried(to_heat, line) for line in picture.rows])
    inside = cv2.warpPerspective(np.ones_like(picture.is_plant), to_heat, HEAT_PX)
    heat[inside == 0] = math.nan
    x = _recoloured(seen, plant, meeting, rng)
    if rng.random() < 0.15:
        _grow_verge(x, heat, rng)
    return _developed(x, rng), heat


def _carried(turn: np.ndarray, points: np.ndarray) -> np.ndarray:
    return cv2.perspectiveTransform(points[None].astype(float), turn)[0]


def _turn(shape: Tuple[int, ...], rng: np.random.Generator) -> np.ndarray:
    """Returns the matrix 3x3 from a picture of a shape to a part of it at SIZE_PX: turned, tilted, mirrored or not."""
    height, width = shape
    size = rng.uniform(_SMALLEST, 1.0) * np.array([1.0, rng.uniform(0.85, 1.15)]).clip(0.0, 1.0)
    angle = math.radians(rng.normal(0.0, 3.0))
    roll = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
    corners = (_CORNERS + rng.uniform(-0.05, 0.05, (4, 2))) * size * (width, height) @ roll
    middle = 0.5 + rng.uniform(-0.5, 0.5, 2) * (1.0 - size)
    corners = corners + middle * (width, height)
    if rng.random() < 0.5:
        corners = corners[[1, 0, 3, 2]]
    to = ((_CORNERS + 0.5) * SIZE_PX).astype(np.float32)
    return cv2.getPerspectiveTransform(corners.astype(np.float32), to)


def _noise(cells: Tuple[int, int], rng: np.random.Generator) -> np.ndarray:
    """Returns smooth noise of variance about 1, float32[h, w], of so many spots across and down."""
    spots = rng.standard_normal(cells[::-1], np.float32)
    return cv2.resize(spots, SIZE_PX, interpolation=cv2.INTER_LINEAR)


def _tinted(x: np.ndarray, spread: float, rng: np.random.Generator) -> np.ndarray:
    """Returns colours float32[h, w, 3] with another saturation, hue and brightness."""
    grey = x.mean(axis=2, keepdims=True)
    gains = rng.uniform(0.5, 1.5) * np.exp(rng.normal(0.0, spread, 3))
    return (grey + rng.uniform(0.2, 1.3) * (x - grey)) * gains.astype(np.float32)


def _stripes(meeting: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Returns stripes along the rows, float32[h, w]: tracks and dry or wet ground between."""
    v, u = np.indices((_HEIGHT, _WIDTH), np.float32) + 0.5
    across = (u - meeting[0]) / np.maximum(v - meeting[1], 1.0)
    profile = cv2.GaussianBlur(
        rng.standard_normal((1, 400), np.float32), (0, 0), rng.uniform(1, 6)
    )[0]
    return np.interp(across, np.linspace(-4.0, 4.0, 400), profile / profile.std()).astype(
        np.float32
    )


def _recoloured(
    seen: np.ndarray, plant: np.ndarray, meeting: np.ndarray, rng: np.random.Generator
) -> np.ndarray:
    """Returns a picture float32[h, w, 3] with plants and soil of other colours, and more on the soil."""
    x = seen.astype(np.float32) / 255.0
    soil, leaves = _tinted(x, 0.06, rng), _tinted(x, 0.06, rng)
    shade = np.zeros(plant.shape, np.float32)
    for cells in ((5, 4), (20, 20), (80, 80), (160, 160)):
        shade += rng.uniform(0.0, 0.25) * _noise(cells, rng)
    if rng.random() < 0.6:
        shade += rng.uniform(0.0, 0.3) * _stripes(meeting, rng)
    soil *= np.exp(shade)[..., None]
    if rng.random() < 0.3:  # weeds too small to be modelled
        density = _noise((160, 112), rng) + rng.uniform(0.0, 1.0) * _noise((8, 6), rng)
        green = np.array([0.35, 0.5, 0.25], np.float32) * rng.uniform(0.5, 1.5)
        share = 0.6 * (density > rng.uniform(1.2, 2.5))[..., None]
        soil = soil + share.astype(np.float32) * (green - soil)
    plant = (plant * rng.uniform(0.5, 1.0))[..., None]
    return soil + plant * (leaves - soil)


def _grow_verge(x: np.ndarray, heat: np.ndarray, rng: np.random.Generator) -> None:
    """Covers an upper corner of a picture with the grass of a field's edge, and takes its rows."""
    reach = rng.uniform(0.2, 0.7), rng.uniform(0.1, 0.4)  # of the picture's sides
    is_left = rng.random() < 0.5

    def corner(shape: Tuple[int, ...]) -> np.ndarray:
        down, across = (np.linspace(0.0, 1.0, n) for n in shape[:2])
        return (across if is_left else across[::-1]) / reach[0] + down[:, None] / reach[1] < 1.0

    green = np.array([0.3, 0.45, 0.2]) * rng.uniform(0.5, 1.5)
    spots = np.exp(0.4 * (_noise((60, 40), rng) + _noise((160, 112), rng)))
    is_grass = corner(x.shape)
    x[is_grass] = green * spots[is_grass][:, None]
    heat[corner(heat.shape)] = 0.0


def _developed(x: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Returns a picture as a camera might have made it: light, shadow, exposure, haze, blur, noise, JPEG."""
    down, across = (np.linspace(-1.0, 1.0, n, dtype=np.float32) for n in (_HEIGHT, _WIDTH))
    x = (
        x
        * np.exp(rng.normal(0.0, 0.15) * down[:, None] + rng.normal(0.0, 0.15) * across)[..., None]
    )
    if rng.random() < 0.2:  # of who stands there, or of a cloud
        angle, place = rng.uniform(0.0, 2.0 * math.pi), rng.uniform(-0.8, 0.8)
        side = math.cos(angle) * across + math.sin(angle) * down[:, None] > place
        x = x * np.where(side, np.float32(rng.uniform(0.4, 0.8)), np.float32(1.0))[..., None]
    x = np.maximum(x, 0.0) ** rng.uniform(0.6, 1.5)
    x = x * rng.uniform(0.25, 0.6) / max(float(x.mean()), 1e-3)
    x = x * rng.uniform(0.92, 1.08, 3).astype(np.float32)
    haze = max(rng.uniform(-0.3, 0.4), 0.0)
    x = (1.0 - haze) * x + haze * rng.uniform(0.3, 0.8)
    if rng.random() < 0.4:
        x = cv2.GaussianBlur(x, (0, 0), rng.uniform(0.4, 1.6))
    x = x + rng.uniform(0.0, 0.06) * rng.standard_normal(x.shape, np.float32)
    made = np.clip(255.0 * x, 0, 255).astype(np.uint8)
    if rng.random() < 0.5:
        quality = [cv2.IMWRITE_JPEG_QUALITY, int(rng.integers(25, 95))]
        made = cv2.imdecode(cv2.imencode(".jpg", made, quality)[1], cv2.IMREAD_COLOR)
    return made
