# SPDX-License-Identifier: MIT
"""Sources of variation of a field: placement, emergence, model, yaw, height. One stream each."""

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
