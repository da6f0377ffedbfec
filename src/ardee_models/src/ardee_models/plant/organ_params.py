# SPDX-License-Identifier: MIT
"""Parameters of organs that only some species have, and of colours; metres, degrees from the vertical."""

from dataclasses import dataclass
from typing import Tuple

from ardee_common.errors import GeneratorError
from ardee_common.options import bounded


@dataclass(frozen=True)
class Tassel:
    """Male inflorescence of corn."""

    branches: int = bounded(0, 40)
    length_m: float = bounded(0.01, 1)
    branch_length_m: float = bounded(0.01, 1)


@dataclass(frozen=True)
class Ears:
    """Ears of corn: their place, size and angle."""

    relative_rank: float = bounded(0.1, 1)
    length_m: float = bounded(0.02, 0.6)
    diameter_m: float = bounded(0.01, 0.15)
    silk_length_m: float = bounded(0.01, 0.4)
    angle_deg: float = bounded(0, 90)
    angle_ripe_deg: float = bounded(0, 180)
    second_probability: float = bounded(0, 1)


@dataclass(frozen=True)
class Panicle:
    """Head of sorghum on its peduncle."""

    peduncle_m: float = bounded(0.01, 1)
    length_m: float = bounded(0.02, 1)
    diameter_m: float = bounded(0.01, 0.4)
    clusters: int = bounded(4, 80)


@dataclass(frozen=True)
class Flowers:
    """Branched head of tubular flowers, later capsules (tobacco)."""

    axis_m: float = bounded(0.01, 1)
    branches: int = bounded(1, 20)
    branch_length_m: float = bounded(0.01, 0.6)
    flowers_per_branch: int = bounded(1, 12)
    corolla_length_m: float = bounded(0.005, 0.2)
    corolla_diameter_m: float = bounded(0.005, 0.1)


@dataclass(frozen=True)
class Tillers:
    """Shoots from the foot of the main stem."""

    angle_deg: float = bounded(0, 80)
    angle_top_deg: float = bounded(0, 45)
    size_mean: float = bounded(0.1, 1)
    size_sd: float = bounded(0, 0.3)
    fewer_leaves: int = bounded(0, 20)


@dataclass(frozen=True)
class BraceRoots:
    """Roots from the lowest nodes above the ground."""

    count: int = bounded(0, 40)
    height_m: float = bounded(0.005, 0.5)
    spread_m: float = bounded(0.01, 0.5)


@dataclass(frozen=True)
class Wear:
    """Damage by wind and age to leaves with parallel veins."""

    tears_green: float = bounded(0, 3)
    tears_dead: float = bounded(0, 3)
    tear_length: float = bounded(0, 0.5)
    stand_off_sd_deg: float = bounded(0, 40)
    lost_tip: float = bounded(0, 0.5)


@dataclass(frozen=True)
class Colours:
    """Mean colours, RGB 0..255."""

    leaf: Tuple[float, ...] = bounded(0, 255)
    midrib: Tuple[float, ...] = bounded(0, 255)
    yellowing: Tuple[float, ...] = bounded(0, 255)
    dry: Tuple[float, ...] = bounded(0, 255)
    stem: Tuple[float, ...] = bounded(0, 255)
    foot: Tuple[float, ...] = bounded(0, 255)
    head: Tuple[float, ...] = bounded(0, 255)
    head_ripe: Tuple[float, ...] = bounded(0, 255)

    def __post_init__(self) -> None:
        for name, given in list(vars(self).items()):
            colour = tuple(map(float, given))
            object.__setattr__(self, name, colour)
            if len(colour) != 3:
                raise GeneratorError(f"colours.{name}: found {colour}, expected red, green, blue")
