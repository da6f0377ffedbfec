# SPDX-License-Identifier: MIT
"""Sources of variation of a field: placement, emergence, model, yaw, height, size. One stream each."""

from typing import Optional

import numpy as np


def placement_offsets(count: int, covariance: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Zero-mean bivariate Gaussian offsets (count, 2); the matrix is positive definite or zero."""
    draws = rng.standard_normal((count, 2))
    if not covariance.any():
        return np.zeros_like(draws)
    return draws @ np.linalg.cholesky(covariance).T


def emerged(count: int, low: float, high: float, rng: np.random.Generator) -> np.ndarray:
    """Tells which stalks emerge: each one's probability is uniform in [low, high] (thesis Figure 4.4, lines 13-14)."""
    probability = rng.uniform(low, high, count)
    return rng.random(count) < probability


def target_heights(
    count: int, low: Optional[float], high: Optional[float], rng: np.random.Generator
) -> Optional[np.ndarray]:
    """Uniform heights in [low, high], or None if the models keep their own."""
    return None if low is None else rng.uniform(low, high, count)


def sizes(
    count: int, cv: float, late: float, late_size: float, rng: np.random.Generator
) -> np.ndarray:
    """Sizes of plants over their models': lognormal, cut at three SD; a late one's times `late_size` to 1."""
    own = np.exp(cv * rng.standard_normal(count).clip(-3.0, 3.0))
    is_late, share = rng.random((2, count))
    return np.where(is_late < late, own * (late_size + (1.0 - late_size) * share), own)
