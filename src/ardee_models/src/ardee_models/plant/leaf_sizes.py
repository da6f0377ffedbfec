# SPDX-License-Identifier: MIT
"""Length and width of leaves by rank."""

import numpy as np

from ardee_models.plant.species import Leaves, YoungLeaves

_RANK_SD = 0.03  # SD of a leaf's length about its rank's mean, over that mean (estimate)


def relative_leaf_area(rank: np.ndarray, r_max: float, skew: float) -> np.ndarray:
    """Leaf area over the largest leaf's at relative rank 0..1: exp(-k/r_max (2 d^2 + d^3)), k = -ln(skew) r_max."""
    d = rank - r_max
    return np.exp(np.log(skew) * (2.0 * d**2 + d**3))


def length_to_width(rank: np.ndarray, shape: Leaves) -> np.ndarray:
    """Length over width by rank: a parabola from the first to the last leaf, largest at the middle rank."""
    off = (2.0 * rank - 1.0) ** 2
    return shape.length_to_width + (shape.length_to_width_ends - shape.length_to_width) * off


def full_sizes(count: int, number: int, shape: Leaves, rng: np.random.Generator) -> tuple:
    """Final lengths and widths of leaves 1..count of a shoot that makes `number`.

    With area = c length^2 / ratio, length goes as the root of relative area times ratio.
    """
    rank = np.arange(1, count + 1) / number
    ratio = length_to_width(rank, shape)
    ratio_at_largest = length_to_width(np.array(shape.rank_of_largest), shape)
    area = relative_leaf_area(rank, shape.rank_of_largest, shape.area_skew)
    vigour = np.exp(rng.normal(0.0, shape.length_cv))
    own = np.exp(rng.normal(0.0, _RANK_SD, count))
    lengths = shape.length_max_m * vigour * own * np.sqrt(area * ratio / ratio_at_largest)
    return lengths, lengths / ratio


def young_fractions(count: int, young: YoungLeaves) -> np.ndarray:
    """Visible over final length of the leaves that still grow, from the lowest to the topmost."""
    return np.linspace(young.length_first, young.length_last, count) if count else np.zeros(0)
