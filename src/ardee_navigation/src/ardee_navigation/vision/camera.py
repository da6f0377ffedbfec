# SPDX-License-Identifier: MIT
"""Geometry of a camera that looks along a lane: what rows in its picture say about heading and lateral offset."""
import math
from dataclasses import dataclass

from ardee_common.errors import GeneratorError
from ardee_navigation.vision.rows import RowModel

_LEAST_PX, _LARGEST_RATIO = 16, 4  # of a picture's sides


def shrunk_height_px(width_px: int, height_px: int, to_width_px: int) -> int:
    """Returns the height of a picture shrunk to a width."""
    return round(height_px * to_width_px / width_px)


def check_size(width_px: int, height_px: int) -> None:
    """Raises GeneratorError for a picture too small or narrow: shrunk to a width, the latter is without bound."""
    shorter, longer = sorted((width_px, height_px))
    if shorter < _LEAST_PX or longer > _LARGEST_RATIO * shorter:
        expected = f"at least {_LEAST_PX} a side, and 1:{_LARGEST_RATIO} to {_LARGEST_RATIO}:1"
        raise GeneratorError(
            f"found a picture of {width_px} x {height_px} pixels, expected {expected}"
        )


@dataclass(frozen=True)
class Sight:
    """Sight of the lane before the camera, in one picture.

    heading_rad : of the camera, counter-clockwise from the rows
    lateral_offset_m : of the camera, to the left of the lane's middle
    confidence : 0 to 1
    rows : in the picture; rows 0 and 1 are the lane's
    """

    heading_rad: float
    lateral_offset_m: float
    confidence: float
    rows: RowModel


@dataclass(frozen=True)
class Camera:
    """Calibration of a camera without distortion and roll; its axis passes the middle of the picture.

    pitch_rad : below the horizon, on level ground
    """

    width_px: int
    height_px: int
    focal_px: float
    height_m: float
    pitch_rad: float = 0.0

    @property
    def horizon_px(self) -> float:
        """Picture row of the horizon of level ground."""
        return self.height_px / 2.0 - self.focal_px * math.tan(self.pitch_rad)

    def shrunk(self, width_px: int) -> "Camera":
        """Returns the camera of the picture shrunk to a width."""
        factor = width_px / self.width_px
        height_px = shrunk_height_px(self.width_px, self.height_px, width_px)
        return Camera(width_px, height_px, self.focal_px * factor, self.height_m, self.pitch_rad)

    def spacing(self, lane_width_m: float) -> float:
        """Returns the spacing of rows that lie a lane's width apart, as seen along them."""
        return lane_width_m * math.cos(self.pitch_rad) / self.height_m

    def sight(self, rows: RowModel, confidence: float) -> Sight:
        """Returns heading and offset of the camera that sees rows 0 and 1 on both sides of its lane.

        A line at a distance D to the left passes picture row v at
        u_c + f tan(heading) / cos(pitch) - (v - h) (D / cos(heading) + H tan(heading) tan(pitch)) cos(pitch) / H.
        """
        pitch_rad = math.atan((self.height_px / 2.0 - rows.horizon_px) / self.focal_px)
        tangent = rows.heading_px * math.cos(pitch_rad) / self.focal_px
        slope = (rows.phase + 0.5) * rows.spacing / math.cos(pitch_rad)
        offset_m = self.height_m * (slope + tangent * math.tan(pitch_rad))
        heading_rad = math.atan(tangent)
        return Sight(heading_rad, offset_m * math.cos(heading_rad), confidence, rows)

    def rows(self, heading_rad: float, lateral_offset_m: float, like: RowModel) -> RowModel:
        """Returns the rows that give this heading and offset by `sight`; horizon and spacing are those of `like`."""
        pitch_rad = math.atan((self.height_px / 2.0 - like.horizon_px) / self.focal_px)
        tangent = math.tan(heading_rad)
        offset_m = lateral_offset_m / math.cos(heading_rad)
        slope = offset_m / self.height_m - tangent * math.tan(pitch_rad)
        phase = slope * math.cos(pitch_rad) / like.spacing - 0.5
        heading_px = tangent * self.focal_px / math.cos(pitch_rad)
        return RowModel(like.horizon_px, like.spacing, phase, heading_px)
