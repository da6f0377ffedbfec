# SPDX-License-Identifier: MIT
"""Motion of a camera while it takes a picture: where its shutter lets points appear."""

from dataclasses import dataclass
from typing import Dict, Tuple

import numpy as np
from scipy.spatial.transform import Rotation

from ardee_datasets.rows import Size, project

_CLOSE_ROWS, _MOST_STEPS = 1e-3, 100  # between a point's row and the time of that row


@dataclass(frozen=True)
class Motion:
    """Constant motion of a camera in the world's axes [m/s, rad/s], exposure of a row and readout of all rows.

    The pose of a picture is that in the middle of the exposure of its middle row.
    """

    v_m_s: np.ndarray
    w_rad_s: np.ndarray
    exposure_time_s: float = 0.0
    readout_time_s: float = 0.0

    def begin(self, xyz_m: np.ndarray, rotation: Rotation) -> Tuple[np.ndarray, Rotation]:
        """Returns a camera's place and rotation when the exposure of the first row begins."""
        before_s = -(self.exposure_time_s + self.readout_time_s) / 2
        turn = before_s * self.w_rad_s
        begun = Rotation.from_rotvec(turn) * rotation if turn.any() else rotation
        return xyz_m + before_s * self.v_m_s, begun

    def apparent(
        self, points_m: np.ndarray, K: np.ndarray, X_WC: np.ndarray, size: Size
    ) -> np.ndarray:
        """Returns the places [n, 3] where points [n, 3] would lie if the camera stood still at its pose X_WC."""
        if not self.readout_time_s:
            return points_m
        apparent, row = points_m, np.full(len(points_m), np.inf)
        for _ in range(_MOST_STEPS):
            pixels, depth = project(apparent, K, X_WC)
            before = row
            row = np.where(depth > 0.0, np.clip(pixels[:, 1], 0.0, size[1]), size[1] / 2)
            if (np.abs(row - before) < _CLOSE_ROWS).all():
                break
            time_s = self.readout_time_s * (row / size[1] - 0.5)[:, None]
            turned = Rotation.from_rotvec(-time_s * self.w_rad_s)
            eye_m = X_WC[:3, 3]
            apparent = eye_m + turned.apply(points_m - eye_m - time_s * self.v_m_s)
        return apparent

    def description(self) -> Dict[str, object]:
        """Returns the entries of a sample."""
        return {
            "v_m_s": self.v_m_s.tolist(),
            "w_rad_s": self.w_rad_s.tolist(),
            "exposure_time_s": self.exposure_time_s,
            "readout_time_s": self.readout_time_s,
        }
