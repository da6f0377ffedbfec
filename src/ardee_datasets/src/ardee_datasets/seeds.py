# SPDX-License-Identifier: MIT
"""Seeds of a data set: of its fields, and the random streams below them."""

import hashlib

import numpy as np


def child_seed(seed: int, *names: object) -> int:
    """Returns the seed of a named stream below another seed."""
    text = "/".join(map(str, (seed, *names)))
    return int.from_bytes(hashlib.sha256(text.encode()).digest()[:4], "little")


def stream(seed: int, *names: object) -> np.random.Generator:
    """Returns the random stream of this name."""
    return np.random.default_rng(child_seed(seed, *names))


def scene_name(kind: str, number: int) -> str:
    """Returns the name of the field of this number of a kind."""
    return f"{kind}_{number:04d}"


def field_seed(seed: int, scene: str) -> int:
    """Returns the seed of a field below that of the recipe."""
    return child_seed(seed, "field", scene)
