# SPDX-License-Identifier: MIT
"""The row follower by camera: a picture in, a motion command and what was seen on the way out."""
import math
from dataclasses import dataclass
from typing import Union

import numpy as np

from ardee_common.errors import GeneratorError
from ardee_navigation.lane_following import LaneFollower, Line, State
from ardee_navigation.lane_following.control import centre_error_m
from ardee_navigation.lane_following.line import blend, turned
from ardee_navigation.vision.camera import Camera, Sight, check_size
from ardee_navigation.vision.classical import Classical
from ardee_navigation.vision.learned import Learned
from ardee_navigation.vision.parameters import VisionParameters


@dataclass(frozen=True)
class Output:
    """Command and perception after one picture."""

    state: State
    speed_m_s: float
    turn_rad_s: float
    centre: Line  # of the lane, in use
    is_valid: bool  # whether this picture's was
    sight: Sight
    error_m: float


def camera_of(width_px: int, height_px: int, parameters: VisionParameters) -> Camera:
    """Returns the calibration of a camera by its field of view."""
    focal_px = width_px / 2.0 / math.tan(math.radians(parameters.horizontal_fov_deg) / 2.0)
    pitch_rad = math.radians(parameters.camera_pitch_deg)
    return Camera(width_px, height_px, focal_px, parameters.camera_height_m, pitch_rad)


def centre_line(sight: Sight) -> Line:
    """Returns the lane's middle in the camera's frame."""
    offset_m = -sight.lateral_offset_m / math.cos(sight.heading_rad)
    return Line(-math.tan(sight.heading_rad), offset_m)


class VisionFollower:
    """Follows the lane between two rows, picture by picture, of one camera; its pictures may change their size."""

    def __init__(self, parameters: VisionParameters = VisionParameters()) -> None:
        self._parameters = parameters
        self._run = LaneFollower(parameters)
        self._perception = None  # type: Union[Classical, Learned, None]
        self._size_px = (0, 0)  # of the pictures that it is for: width, height
        self.reset()

    def reset(self) -> None:
        """Restores the state before the first picture; call it after the robot was set down anew."""
        self._run.reset()
        self._forget()

    def _forget(self) -> None:
        self._centre = Line(0.0, 0.0)
        self._unseen_s = math.inf

    def update(self, rgb: np.ndarray, time_s: float) -> Output:
        """Returns the output for the picture uint8[h, w, 3] taken at `time_s`; GeneratorError if it is none."""
        if rgb.dtype != np.uint8 or rgb.ndim != 3 or rgb.shape[2] != 3:
            raise GeneratorError(
                f"found a picture {rgb.dtype}{[*rgb.shape]}, expected uint8[h, w, 3]"
            )
        check_size(rgb.shape[1], rgb.shape[0])
        dt_s = self._run.elapsed_s(time_s)
        if dt_s is None:
            self._forget()
            dt_s = 0.0
        sight = self._look(rgb)
        found, before = centre_line(sight), self._predict(dt_s)
        is_valid = self._is_acceptable(sight, found, before)
        is_new = self._unseen_s > self._parameters.max_coast_s
        self._unseen_s = 0.0 if is_valid else self._unseen_s + dt_s
        weight = (1.0 if is_new else self._parameters.blend) if is_valid else 0.0
        self._centre = blend(before, found, weight)
        is_gone = sight.confidence < self._parameters.end_confidence
        command = self._run.steer(self._centre, is_valid, is_gone, dt_s)
        error_m = centre_error_m(self._centre, self._parameters)
        return Output(self._run.state, *command, self._centre, is_valid, sight, error_m)

    def _look(self, rgb: np.ndarray) -> Sight:
        size_px = rgb.shape[1], rgb.shape[0]
        if self._perception is None or size_px != self._size_px:
            self._size_px = size_px
            camera = camera_of(*size_px, self._parameters)
            estimator = {"classical": Classical, "learned": Learned}[self._parameters.estimator]
            self._perception = estimator(camera, self._parameters.lane_width_m)
        return self._perception.look(rgb)

    def _predict(self, dt_s: float) -> Line:
        """The centre line in use, seen from where the last command has taken the robot."""
        speed, turn = self._run.command
        return turned(self._centre, turn * dt_s, speed * dt_s, self._parameters.camera_ahead_m)

    def _is_acceptable(self, sight: Sight, found: Line, before: Line) -> bool:
        """Returns whether a picture's line is sure, bearable and, if one was seen just now, near that."""
        p = self._parameters
        if sight.confidence < p.min_confidence or abs(sight.heading_rad) > p.max_angle_rad:
            return False
        if self._unseen_s > p.max_coast_s:
            return True
        change_rad = abs(found.angle_rad - before.angle_rad)
        change_m = abs(found.distance_m - before.distance_m)
        return change_rad <= p.max_angle_change_rad and change_m <= p.max_change_m
