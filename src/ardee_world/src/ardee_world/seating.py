# SPDX-License-Identifier: MIT
"""Sets the plants of a generated field on another ground: the z of every include becomes the ground's height."""

import re

import numpy as np

from ardee_models.errors import GeneratorError
from ardee_models.terrain import Ground
from ardee_world.writers.sdf import EXTENSION_NAMESPACE

_POSE = re.compile(r"(<include>.*?<pose>)([^<]*)(</pose>)", re.DOTALL)


def is_generated(model: str) -> bool:
    """Whether the field generator wrote it; only of its plants is it known that they stand on the ground."""
    return EXTENSION_NAMESPACE in model[:400]


def seat(model: str, ground: Ground) -> str:
    """The text of model.sdf with its includes, in a world that includes it without a turn, on the ground."""
    poses = [match.group(2).split() for match in _POSE.finditer(model)]
    if not poses:
        return model
    try:
        xy = np.array([pose[:2] for pose in poses], dtype=float)
    except ValueError as error:
        raise GeneratorError(f"field: found a pose that is no six numbers: {error}") from error
    heights = iter(ground.height_at(xy[:, 0], xy[:, 1]).tolist())

    def placed(match: "re.Match") -> str:
        x, y, _, *turn = match.group(2).split()
        return f"{match.group(1)}{x} {y} {next(heights) + 0.0:.4f} {' '.join(turn)}{match.group(3)}"

    return _POSE.sub(placed, model)
