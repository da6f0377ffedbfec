# SPDX-License-Identifier: MIT
"""Update heuristics (thesis 5.1.2): the lines that are used from now on, from those that were found valid."""
from dataclasses import dataclass
from typing import Optional

from ardee_navigation.lane_following.line import Line, blend, line_at
from ardee_navigation.lbirnt.lines import Estimate
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


def update_lane(
    before: Lane,
    left: Optional[Estimate],
    right: Optional[Estimate],
    lead: int,
    parameters: Parameters,
) -> Lane:
    """The next lane; pass None for a line that is not valid.

    Both valid: each at its own distance, both with the slope of the one that leads (0 left, 1 right). One valid: the
    other is laid parallel at the lane's width. None: the lane before is kept. New lines are blended with those before.
    """
    weight = parameters.blend
    if left is None and right is None:
        return before
    if left is not None and right is not None:
        slope = (left, right)[lead].line.slope
        lines = [line_at(one.line.distance_m, slope) for one in (left, right)]
        return Lane(blend(before.left, lines[0], weight), blend(before.right, lines[1], weight))
    if left is not None:
        line = left.line
        other = line.shifted(-parameters.lane_width_m)
        return Lane(blend(before.left, line, weight), blend(before.right, other, weight))
    line = right.line
    other = line.shifted(parameters.lane_width_m)
    return Lane(blend(before.left, other, weight), blend(before.right, line, weight))
