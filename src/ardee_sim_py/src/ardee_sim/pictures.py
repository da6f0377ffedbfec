# SPDX-License-Identifier: MIT
"""Pictures of cameras that belong to no robot."""

import math
import numbers
from typing import Any, Dict, Optional, Sequence, Tuple, Union

import numpy as np
from ardee_sim import checks
from ardee_sim.checks import Vector

_MOST_PX = 10_000
_WIDEST_RAD = math.pi - 1e-6
_LONGEST_SHUTTER_S = 1.0
_LEAST_EXPOSURE, _MOST_EXPOSURE = 1e-6, 1e6
Camera = Tuple[np.ndarray, np.ndarray, int, int, float, float, np.ndarray, np.ndarray, float, float]


def _words(values: Any) -> str:
    if isinstance(values, str):
        return checks.text(values, "white_balance")
    if isinstance(values, numbers.Real):
        return str(checks.number(values, "white_balance"))
    return " ".join(map(str, checks.vector(values, "white_balance").tolist()))


def camera_of(
    xyz_m: Vector,
    quat_xyzw: Vector,
    *,
    width_px: int = 640,
    height_px: int = 480,
    horizontal_fov_rad: float = 1.2,
    near_m: float = 0.0,
    v_m_s: Vector = (0, 0, 0),
    w_rad_s: Vector = (0, 0, 0),
    exposure_time_s: float = 0.0,
    readout_time_s: float = 0.0,
) -> Camera:
    """Returns a camera as the engine takes it; arguments: Simulation.render()."""
    return (
        checks.vector(xyz_m, "xyz_m"),
        checks.quaternion(quat_xyzw),
        checks.whole(width_px, "width_px", 1, _MOST_PX),
        checks.whole(height_px, "height_px", 1, _MOST_PX),
        checks.number(horizontal_fov_rad, "horizontal_fov_rad", 1e-6, _WIDEST_RAD),
        checks.number(near_m, "near_m", 0.0),
        checks.vector(v_m_s, "v_m_s"),
        checks.vector(w_rad_s, "w_rad_s"),
        checks.number(exposure_time_s, "exposure_time_s", 0.0, _LONGEST_SHUTTER_S),
        checks.number(readout_time_s, "readout_time_s", 0.0, _LONGEST_SHUTTER_S),
    )


def take_picture(
    core: Any,
    xyz_m: Vector,
    quat_xyzw: Vector,
    parts: Sequence[str],
    *,
    exposure: Optional[float] = None,
    white_balance: Union[str, float, Sequence[float]] = "off",
    **lens: Any,
) -> Dict[str, np.ndarray]:
    """Returns the layers `parts` of a picture; arguments: Simulation.render()."""
    camera = camera_of(xyz_m, quat_xyzw, **lens)
    has_ids = "labels" in parts or "instances" in parts
    wanted = ("rgb" in parts, "depth_m" in parts, has_ids, "visuals" in parts)
    if exposure is not None:
        checks.number(exposure, "exposure", _LEAST_EXPOSURE, _MOST_EXPOSURE)
    return core.picture(camera, exposure, _words(white_balance), *wanted)
