# SPDX-License-Identifier: MIT
"""Gaps in the rows, doubles, and plants that lean."""

from dataclasses import dataclass
from typing import Optional

import numpy as np
from scipy.spatial.transform import Rotation

from ardee_common.errors import GeneratorError
from ardee_world.field_config import Stand
from ardee_world.plots import Plan
from ardee_world.streams import Streams


@dataclass(frozen=True)
class Gap:
    """Consecutive places of a row where nothing was sown, as indices into the plan."""

    places: np.ndarray


def _plants_of_a_gap(row_m: np.ndarray, gap_length_m: float) -> int:
    """Number of plants in a gap of a row, by the median distance of the row's plants, to 0.1 mm as in the files."""
    if len(row_m) < 2:
        return 1
    spacing_m = round(float(np.median(np.hypot(*np.diff(row_m, axis=0).T))), 4)
    return max(int(round(gap_length_m / max(spacing_m, 1e-4))), 1)


def draw_gaps(plan: Plan, stand: Stand, rng: np.random.Generator) -> tuple:
    """Draws gaps of whole plants that touch neither each other nor a row's end; all places are equally likely."""
    if stand.gaps == 0:
        return ()
    total = len(plan.centres_m)
    order = np.lexsort((plan.place, plan.row, plan.plot))  # a user's rows may be interleaved
    new_row = (np.diff(plan.row[order]) != 0) | (np.diff(plan.plot[order]) != 0)
    starts = np.concatenate(([0], np.flatnonzero(new_row) + 1))
    ends = np.append(starts[1:], total)
    rows = np.split(plan.centres_m[order], starts[1:])
    counts = np.array([_plants_of_a_gap(row_m, stand.gap_length_m) for row_m in rows])
    row_of = np.repeat(np.arange(len(starts)), ends - starts)
    place = np.arange(total)
    candidates = place[(place > starts[row_of]) & (place + counts[row_of] < ends[row_of])]
    taken = np.zeros(total, bool)
    firsts = []
    for first in rng.permutation(candidates).tolist():
        count = counts[row_of[first]]
        if not taken[first - 1 : first + count + 1].any():
            taken[first : first + count] = True
            firsts.append(first)
            if len(firsts) == stand.gaps:
                firsts.sort()
                return tuple(Gap(order[i : i + counts[row_of[i]]]) for i in firsts)
    raise GeneratorError(
        f"gaps: found {stand.gaps} of {stand.gap_length_m:g} m, expected at most about {len(firsts)} in these rows"
    )


@dataclass(frozen=True)
class Lean:
    """Tilt from the vertical and the direction of the top, from the field's x axis; zero where a plant stands."""

    tilt_rad: np.ndarray
    direction_rad: np.ndarray

    def at(self, index: np.ndarray) -> "Lean":
        """Returns the lean of some of the plants."""
        return Lean(self.tilt_rad[index], self.direction_rad[index])


def draw_lean(count: int, stand: Stand, streams: Streams, prefix: str = "") -> Lean:
    """Draws the lean: with probability `lodging`, by a uniform angle, in a normal or uniform direction."""
    if stand.lodging == 0.0:
        return Lean(np.zeros(count), np.zeros(count))
    leans = streams.of(prefix + "lodging").random(count) < stand.lodging
    low, high = np.radians((stand.lodging_angle_min_deg, stand.lodging_angle_max_deg))
    tilt = streams.of(prefix + "lodging_angle").uniform(low, high, count)
    rng = streams.of(prefix + "lodging_direction")
    mean = stand.lodging_direction_deg  # type: Optional[float]
    if mean is None:
        towards = rng.uniform(-np.pi, np.pi, count)
    else:
        deviation = np.radians(stand.lodging_direction_sd_deg)
        towards = np.radians(mean) + deviation * rng.standard_normal(count)
        towards = (towards + np.pi) % (2.0 * np.pi) - np.pi
    return Lean(np.where(leans, tilt, 0.0), np.where(leans, towards, 0.0))


def roll_pitch_yaw(yaw_rad: np.ndarray, lean: Lean) -> np.ndarray:
    """Angles (n, 3) about fixed axes for plants turned by yaw, then tilted about their foot."""
    angles = np.zeros((len(yaw_rad), 3))
    angles[:, 2] = yaw_rad
    leaning = np.flatnonzero(lean.tilt_rad)
    if len(leaning):
        tilt, towards = lean.tilt_rad[leaning], lean.direction_rad[leaning]
        turns = np.column_stack((towards, tilt, yaw_rad[leaning] - towards))
        angles[leaning] = Rotation.from_euler("ZYZ", turns).as_euler("xyz")
    return angles
