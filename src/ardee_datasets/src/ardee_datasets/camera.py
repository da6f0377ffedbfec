# SPDX-License-Identifier: MIT
"""Keys of a recipe's cameras."""

from dataclasses import dataclass
from typing import Any, Optional

from ardee_common.errors import GeneratorError
from ardee_common.options import converted, option
from ardee_datasets.lens import LensKeys
from ardee_datasets.ranges import Range

_HEIGHT_M = (0.05, 20.0)
_TEMPERATURE_K, _GAIN = (4000.0, 25000.0), (0.01, 100.0)  # of Simulation.render()
_EXPOSURE = (1e-3, 1e3)  # of Simulation.render()


def white_balance(given: Any) -> Any:
    """Returns what Simulation.render() takes as white_balance."""
    if given is False or given == "off":  # YAML 1.1 reads off as false
        return "off"
    if given == "auto":
        return given
    numbers = given if isinstance(given, list) else [given]
    limits = _TEMPERATURE_K if given is not numbers else _GAIN
    is_number = [isinstance(n, (int, float)) and not isinstance(n, bool) for n in numbers]
    if not all(is_number) or not all(limits[0] <= n <= limits[1] for n in numbers):
        raise ValueError(given)
    if given is numbers and len(numbers) != 3:
        raise ValueError(given)
    return given


def exposure(given: Any) -> Optional[float]:
    """Returns what Simulation.render() takes as exposure."""
    if given is None or given == "auto":
        return None
    is_number = isinstance(given, (int, float)) and not isinstance(given, bool)
    if not is_number or not _EXPOSURE[0] <= given <= _EXPOSURE[1]:
        raise ValueError(given)
    return float(given)


@dataclass(frozen=True)
class CameraKeys:
    """A camera that looks along the rows; a pose is drawn for each picture."""

    sensor: Optional[str] = option(None, "camera of ardee_sensors, such as realsense_d435")
    width_px: Optional[int] = option(None, "width of the picture", (8, 8192))
    height_px: Optional[int] = option(None, "height of the picture", (8, 8192))
    horizontal_fov_deg: Optional[float] = option(None, "horizontal field of view", (1.0, 170.0))
    height_m: Range = option((0.5, 0.5), "height above the ground", _HEIGHT_M)
    pitch_deg: Range = option((0.0, 0.0), "tilt below the horizon", (-90.0, 90.0))
    yaw_deg: Range = option((0.0, 0.0), "turn to the left of the lane", (-180.0, 180.0))
    near_m: float = option(0.0, "what is nearer is invisible", (0.0, 10.0))
    offset_m: Range = option((0.0, 0.0), "offset to the left of the lane's middle", (-10.0, 10.0))
    speed_m_s: Range = option(
        (0.0, 0.0), "along the lane, ahead; its shutter sees it", (-10.0, 10.0)
    )
    exposure_time_s: float = option(
        0.0, "of each row: motion blur of a camera in motion", (0.0, 1.0)
    )
    readout_time_s: float = option(
        0.0, "from the first row to the last: rolling shutter", (0.0, 1.0)
    )
    exposure: Optional[float] = converted(  # factor on the light; auto: each picture has its own
        exposure, "auto or a number, 0.001 to 1000", None
    )
    white_balance: Any = converted(  # gains of red, green and blue; those of a daylight; grey world
        white_balance, "off, auto, 4000 to 25000 [K] or three gains of 0.01 to 100", "off"
    )
    lens: Optional[LensKeys] = option(None, "dust and drops on the lens")

    def __post_init__(self) -> None:
        for key in ("height_m", "pitch_deg", "yaw_deg", "offset_m", "speed_m_s"):
            low, high = getattr(self, key)
            if low > high:
                raise GeneratorError(f"{key}: found [{low}, {high}], expected [least, most]")
        numbers = ("width_px", "height_px", "horizontal_fov_deg")
        missing = [key for key in numbers if getattr(self, key) is None]
        if not self.sensor and missing:
            raise GeneratorError(f"found neither sensor nor {', '.join(missing)}, expected one")
