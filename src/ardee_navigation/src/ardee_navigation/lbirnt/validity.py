# SPDX-License-Identifier: MIT
"""Validity of the two fitted lines (thesis 5.1.2, equation 5.3)."""
from typing import Optional, Tuple

from ardee_navigation.lane_following.line import Line
from ardee_navigation.lbirnt.lines import Estimate
from ardee_navigation.lbirnt.parameters import Parameters


def is_acceptable(
    found: Optional[Estimate], before: Optional[Line], parameters: Parameters
) -> bool:
    """First checks, of one line: enough of it, lateral distance within bounds, near the line before in both."""
    if found is None or found.points < parameters.min_points:
        return False
    if found.length_m < parameters.min_length_m:
        return False
    if not parameters.lateral_min_m <= abs(found.line.distance_m) <= parameters.lateral_max_m:
        return False
    angle = found.line.angle_rad
    if abs(angle) > parameters.max_angle_rad:
        return False
    return before is None or (
        abs(angle - before.angle_rad) <= parameters.max_angle_change_rad
        and found.change_m <= parameters.max_change_m
    )


def _share(own: float, other: float) -> float:
    """own / (own + other); one half where both are zero."""
    return own / (own + other) if own + other > 0.0 else 0.5


def line_grade(own: Estimate, other: Estimate) -> float:
    """Equation 5.3 for the side `own`: 0 to 4; both sides' grades add up to 4."""
    return (
        _share(own.points, other.points)
        + _share(own.length_m, other.length_m)
        + (1.0 - _share(own.deviation_m, other.deviation_m))
        + (1.0 - _share(own.change_m, other.change_m))
    )


def fit_together(left: Estimate, right: Estimate, parameters: Parameters) -> bool:
    """Second checks: the two lie a lane's width apart and are parallel."""
    width = left.line.distance_m - right.line.distance_m
    between = abs(left.line.angle_rad - right.line.angle_rad)
    return (
        abs(width - parameters.lane_width_m) <= parameters.lane_width_tolerance_m
        and between <= parameters.max_angle_between_rad
    )


def valid_sides(
    left: Optional[Estimate],
    right: Optional[Estimate],
    before: Tuple[Optional[Line], Optional[Line]],
    parameters: Parameters,
) -> Tuple[bool, bool]:
    """Returns whether the left and the right line are valid. If they do not fit together, the better graded one is."""
    left_good = is_acceptable(left, before[0], parameters)
    right_good = is_acceptable(right, before[1], parameters)
    if left_good and right_good and not fit_together(left, right, parameters):
        left_good = line_grade(left, right) >= line_grade(right, left)
        right_good = not left_good
    return left_good, right_good


def leading_side(left: Estimate, right: Estimate, led: int, parameters: Parameters) -> int:
    """Returns the better graded of two valid lines: 0 left, 1 right; `led` is the side that led before."""
    grades = [line_grade(left, right), line_grade(right, left)]
    grades[led] += parameters.lead_bonus
    return int(grades[1] > grades[0])
