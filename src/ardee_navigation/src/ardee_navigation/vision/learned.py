# SPDX-License-Identifier: MIT
"""Perception of the lane by a network that finds the heat of crop rows in a picture, and the model of its rows."""
from pathlib import Path

import cv2
import numpy as np

from ardee_common.errors import GeneratorError
from ardee_navigation.vision.camera import Camera, Sight, shrunk_height_px
from ardee_navigation.vision.lane_fit import LaneFitter

NETWORK = Path(__file__).with_name("row_network.onnx")
_WIDTH_PX = 160  # of the heat that rows are fitted to
_INPUT_PX = 320, 224  # width, height of the network's picture


class RowHeat:
    """The network."""

    def __init__(self, path: Path = NETWORK) -> None:
        try:
            self._network = cv2.dnn.readNetFromONNX(str(path))
        except cv2.error:
            raise GeneratorError(
                f"{path}: found no network, expected a file of train_row_network"
            ) from None

    def look(self, rgb: np.ndarray) -> np.ndarray:
        """Returns the heat of rows in a picture uint8[h, w, 3], shrunk to a width of 160, float32[h, w]: 0 to 1."""
        small = cv2.resize(rgb, _INPUT_PX, interpolation=cv2.INTER_AREA)
        self._network.setInput(cv2.dnn.blobFromImage(small))
        logits = np.clip(self._network.forward()[0, 0], -30.0, 30.0)
        height_px = shrunk_height_px(rgb.shape[1], rgb.shape[0], _WIDTH_PX)
        heat = 1.0 / (1.0 + np.exp(-logits))
        return cv2.resize(heat, (_WIDTH_PX, height_px), interpolation=cv2.INTER_LINEAR)


class Learned:
    """Finds the lane in pictures of a camera."""

    def __init__(self, camera: Camera, lane_width_m: float, network: Path = NETWORK) -> None:
        self._camera = camera
        self._heat = RowHeat(network)
        self._fitter = LaneFitter(camera.shrunk(_WIDTH_PX), lane_width_m)

    def look(self, rgb: np.ndarray) -> Sight:
        """Returns what a picture uint8[h, w, 3] shows."""
        rows, contrast = self._fitter.fit(self._heat.look(rgb))
        return self._camera.sight(rows.scaled(self._camera.width_px / _WIDTH_PX), contrast)
