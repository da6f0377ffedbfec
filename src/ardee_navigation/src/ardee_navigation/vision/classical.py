# SPDX-License-Identifier: MIT
"""Perception of the lane by a vegetation index and a model of its rows."""
import numpy as np

from ardee_navigation.vision.camera import Camera, Sight
from ardee_navigation.vision.lane_fit import LaneFitter
from ardee_navigation.vision.vegetation import excess_green

_WIDTH_PX = 160  # to which pictures are shrunk
_BARE, _GREEN = 0.05, 0.2  # excess green: most soil's, a plant's


class Classical:
    """Finds the lane in pictures of a camera."""

    def __init__(self, camera: Camera, lane_width_m: float) -> None:
        self._camera = camera
        self._fitter = LaneFitter(camera.shrunk(_WIDTH_PX), lane_width_m)

    def look(self, rgb: np.ndarray) -> Sight:
        """Returns what a picture uint8[h, w, 3] shows."""
        index = np.clip((excess_green(rgb, _WIDTH_PX) - _BARE) / (_GREEN - _BARE), 0.0, 1.0)
        rows, contrast = self._fitter.fit(index)
        return self._camera.sight(rows.scaled(self._camera.width_px / _WIDTH_PX), contrast)
