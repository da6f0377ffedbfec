# SPDX-License-Identifier: MIT
"""Update heuristics (thesis 5.1.2): the lines that are used from now on, from those that were found valid."""
from dataclasses import dataclass
from typing import Optional

from ardee_navigation.lbirnt.lines import Estimate, Line
from ardee_navigation.lbirnt.parameters import Parameters


@dataclass(frozen=True)
class Lane:
    """The two lines in use, a row each, and the one in the middle."""

    left: Line
    right: Line

    @property
    def centre(self) -> Line:
        """Middle of the lane: mean of the two in distance and slope."""
        slope = (self.left.slope + self.right.slope) / 2.0
        return Line(slope, (self.left.offset_m + self.right.offset_m) / 2.0)

    @property
    def width_m(self) -> float:
        """Perceived width from row to row."""
        return self.left.distance_m - self.right.distance_m


def straight_lane(parameters: Parameters) -> Lane:
    """Returns the lane assumed before the first scan: the robot stands in the middle and looks along the lane."""
    half = parameters.lane_width_m / 2.0
    return Lane(Line(0.0, half), Line(0.0, -half))


def blend(before: Line, found: Line, weight: float) -> Line:
    """Returns a line between the one before (weight 0) and the one found (weight 1)."""
    return Line(
        before.slope + weight * (found.slope - before.slope),
        before.offset_m + weight * (found.offset_m - before.offset_m),
    )


def turned(line: Line, turn_rad: float, forward_m: float, lidar_ahead_m: float) -> Line:
    """A line as the lidar sees it after the robot has turned and moved, to first order in the turn.

    The lidar stands before the turning centre, so a turn also moves it sideways by turn x lidar_ahead.
    """
    moved = line.offset_m + line.slope * forward_m - turn_rad * lidar_ahead_m
    return Line(line.slope - turn_rad, moved)


def update_lane(
    before: Lane,
    left: Optional[Estimate],
    right: Optional[Estimate],
    parameters: Parameters,
) -> Lane:
    """The next lane; pass None for a line that is not valid.

    Both valid: each is blended with its predecessor. One valid: it is, and the other is laid parallel at the lane's
    width. None: the lane before is kept.
    """
    weight = parameters.blend
    if left is None and right is None:
        return before
    if left is not None and right is not None:
        return Lane(blend(before.left, left.line, weight), blend(before.right, right.line, weight))
    if left is not None:
        line = left.line
        other = line.shifted(-parameters.lane_width_m)
        return Lane(blend(before.left, line, weight), blend(before.right, other, weight))
    line = right.line
    other = line.shifted(parameters.lane_width_m)
    return Lane(blend(before.left, other, weight), blend(before.right, line, weight))
