# SPDX-License-Identifier: MIT
"""Smooth random images that tile: filtered white noise."""

import numpy as np


def smooth_noise(shape: tuple, correlation_px: float, rng: np.random.Generator) -> np.ndarray:
    """Zero mean, unit SD, Gaussian correlation exp(-d^2 / (4 c^2)) at d pixels, periodic over the image."""
    white = rng.standard_normal(shape)
    fy = np.fft.fftfreq(shape[0])[:, None]
    fx = np.fft.rfftfreq(shape[1])[None, :]
    transfer = np.exp(-2.0 * (np.pi * correlation_px) ** 2 * (fy**2 + fx**2))
    field = np.fft.irfft2(np.fft.rfft2(white) * transfer, s=shape)
    field -= field.mean()
    return field / field.std()


def layered_noise(shape: tuple, correlations_px: tuple, rng: np.random.Generator) -> np.ndarray:
    """Mean of several octaves of smooth noise, unit SD."""
    total = sum(smooth_noise(shape, c, rng) for c in correlations_px)
    return total / total.std()
