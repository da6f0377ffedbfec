# SPDX-License-Identifier: MIT
"""One random stream for each source of variation, so that a changed argument changes only what it names."""

import numpy as np

# The number of a stream determines the fields of a seed: never reuse one of these for another source.
_NUMBERS = {
    "placement": (0,),
    "emergence": (1,),
    "model": (2,),
    "yaw": (3,),
    "height": (4,),
    "gaps": (5,),
    "doubles": (6,),
    "double_emergence": (8,),
    "double_model": (9,),
    "double_yaw": (10,),
    "double_height": (11,),
    "lodging": (12,),
    "lodging_angle": (13,),
    "lodging_direction": (14,),
    "double_lodging": (15,),
    "double_lodging_angle": (16,),
    "double_lodging_direction": (17,),
    "weed": (18,),
    "stone": (19,),
    "litter": (20,),
    "size": (21,),
    "double_size": (22,),
    "edge_weed": (23,),
}


class Streams:
    """Random streams of a root seed, by name."""

    def __init__(self, seed: int) -> None:
        self._seed = seed

    def of(self, name: str, *numbers: int) -> np.random.Generator:
        """A fresh generator of the stream, or of one of its own streams."""
        key = _NUMBERS[name] + numbers
        return np.random.default_rng(np.random.SeedSequence(self._seed, spawn_key=key))
