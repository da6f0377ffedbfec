# SPDX-License-Identifier: MIT
"""Vegetation index of a picture."""
import cv2
import numpy as np

from ardee_navigation.vision.camera import shrunk_height_px


def excess_green(rgb: np.ndarray, width_px: int) -> np.ndarray:
    """Returns (2 g - r - b) / (r + g + b) of a picture uint8[h, w, 3] shrunk to a width, float32[h, w].

    The index of Woebbecke et al., Transactions of the ASAE 38 (1), 1995; as a share of the sum it does not depend on
    the exposure.
    """
    height_px = shrunk_height_px(rgb.shape[1], rgb.shape[0], width_px)
    small = cv2.resize(rgb, (width_px, height_px), interpolation=cv2.INTER_AREA)
    total = small.sum(axis=2, dtype=np.float32)
    green = small[:, :, 1].astype(np.float32)
    return 3.0 * green / np.maximum(total, 1.0) - (total > 0.0)
