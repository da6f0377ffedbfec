# SPDX-License-Identifier: MIT
"""Lines y = m x + b, of a crop row or of a lane's middle, in the frame of the sensor that found them."""
import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Line:
    """A line along the rows: y = slope x + offset_m in the sensor's frame, x forward, y left."""

    slope: float
    offset_m: float

    @property
    def angle_rad(self) -> float:
        """Angle of the row to the robot, counter-clockwise."""
        return math.atan(self.slope)

    @property
    def distance_m(self) -> float:
        """Lateral distance: orthogonal, from the sensor; positive where the line passes on the left."""
        return self.offset_m / math.hypot(1.0, self.slope)

    def at(self, x_m: float) -> float:
        """y [m] of the line at x."""
        return self.slope * x_m + self.offset_m

    def shifted(self, distance_m: float) -> "Line":
        """Returns the parallel line at this distance to the left."""
        return Line(self.slope, self.offset_m + distance_m * math.hypot(1.0, self.slope))


def line_at(distance_m: float, slope: float) -> Line:
    """Returns the line of this slope at an orthogonal distance from the sensor, positive to the left."""
    return Line(slope, distance_m * math.hypot(1.0, slope))


def blend(before: Line, found: Line, weight: float) -> Line:
    """Returns a line between the one before (weight 0) and the one found (weight 1)."""
    return Line(
        before.slope + weight * (found.slope - before.slope),
        before.offset_m + weight * (found.offset_m - before.offset_m),
    )


def turned(line: Line, turn_rad: float, forward_m: float, sensor_ahead_m: float) -> Line:
    """A line as the sensor sees it after the robot has turned and moved, to first order in the turn.

    The sensor stands before the turning centre, so a turn also moves it sideways by turn x sensor_ahead.
    """
    moved = line.offset_m + line.slope * forward_m - turn_rad * sensor_ahead_m
    return Line(line.slope - turn_rad, moved)
