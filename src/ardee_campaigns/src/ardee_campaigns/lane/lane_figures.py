# SPDX-License-Identifier: MIT
"""Figures of a lane as a lidar sees it, measured alike on real and on simulated scans, and their table."""
import math
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Dict, List, Sequence, Tuple

import numpy as np
import yaml

from ardee_campaigns.lane.real_run import RealRun
from ardee_campaigns.lane.scan_speed import scan_speed_m_s
from ardee_campaigns.lane.scans import Perceived, Scans, follow
from ardee_campaigns.report.statistics import Quantity, mean_interval
from ardee_common.config import build, read_yaml_lines
from ardee_navigation.lbirnt import Parameters

AHEAD_DEG, SIDE_DEG = 10.0, 30.0  # half widths of the sectors straight ahead and abeam
AXIS_M, AXIS_FROM_M, AXIS_TO_M = 0.25, 0.3, 2.0  # rectangle of the robot's axis before the lidar
FLICKER_M = 0.1
CONSECUTIVE_S = 0.1  # scans and answers farther apart are not compared: the robot was set down anew
BEARING_DEG = 5.0  # width of a bin of bearings
NOWHERE_M = 30.0  # stands for no return in quantiles by bearing
QUANTILES = (0.1, 0.5, 0.9)


@dataclass(frozen=True)
class LaneFigures:
    """Figures of a run; nan where there is nothing to measure. Quantiles of range are of the beams with a return."""

    no_return_share: float
    ahead_no_return_share: float  # within AHEAD_DEG of straight ahead
    ahead_median_m: float
    ahead_p10_m: float
    axis_returns: float  # mean of a scan, in the rectangle before the lidar along the robot's axis
    range_median_m: float
    range_p90_m: float
    side_median_m: float  # within SIDE_DEG of abeam
    flicker_median_m: float  # change of a side beam from scan to scan
    flicker_share: float  # of the changes that are larger than FLICKER_M
    left_spread_m: float  # fitted points about their line, SD in this follower, mean of the scans
    right_spread_m: float
    width_m: float
    width_sd_m: float
    left_change_median_m: float  # of the perceived left distance from answer to answer, absolute
    left_change_p95_m: float
    heading_sd_rad: float
    speed_m_s: float = math.nan  # mean, from the scans alone
    # The ride itself, SD; unknown of a real run whose log has no attitude
    roll_sd_rad: float = math.nan
    pitch_sd_rad: float = math.nan
    yaw_sd_rad: float = math.nan  # of the robot's true heading in the lane


MEASURES = (
    Quantity("no_return_share", "beams without return [%]", 100.0, 1),
    Quantity("ahead_no_return_share", "straight ahead (± 10°): without return [%]", 100.0, 1),
    Quantity("ahead_median_m", "straight ahead: median [m]", 1.0, 2),
    Quantity("ahead_p10_m", "straight ahead: 10th percentile [m]", 1.0, 2),
    Quantity("axis_returns", "returns 0.3 to 2 m ahead, 0.25 m beside the axis, a scan", 1.0, 1),
    Quantity("range_median_m", "range: median [m]", 1.0, 2),
    Quantity("range_p90_m", "range: 90th percentile [m]", 1.0, 2),
    Quantity("side_median_m", "range at the sides (± 30°): median [m]", 1.0, 2),
    Quantity("flicker_median_m", "change of a side beam, scan to scan: median [mm]", 1e3, 0),
    Quantity("flicker_share", "changes of a side beam above 0.1 m [%]", 100.0, 1),
    Quantity("left_spread_m", "left points about their line: SD [cm]", 100.0, 1),
    Quantity("right_spread_m", "right points about their line: SD [cm]", 100.0, 1),
    Quantity("width_m", "perceived width [m]", 1.0, 3),
    Quantity("width_sd_m", "perceived width: SD [m]", 1.0, 3),
    Quantity("left_change_median_m", "change of the left distance: median [mm]", 1e3, 1),
    Quantity("left_change_p95_m", "change of the left distance: 95th percentile [mm]", 1e3, 1),
    Quantity("heading_sd_rad", "perceived heading: SD [deg]", 180.0 / np.pi, 1),
    Quantity("yaw_sd_rad", "true heading in the lane: SD [deg]", 180.0 / np.pi, 1),
    Quantity("roll_sd_rad", "roll: SD [deg]", 180.0 / np.pi, 2),
    Quantity("pitch_sd_rad", "pitch: SD [deg]", 180.0 / np.pi, 2),
    Quantity("speed_m_s", "speed, from scan to scan [m/s]", 1.0, 2),
)


@dataclass(frozen=True)
class RealLane:
    """Figures of a real run and its quantiles of range by bearing, as real_lane.yaml has them."""

    source: str
    scans: int
    figures: LaneFigures
    ranges_p10_m: Tuple[float, ...]  # by bearing, from -135 degrees in steps of BEARING_DEG
    ranges_p50_m: Tuple[float, ...]
    ranges_p90_m: Tuple[float, ...]


def _median(values: np.ndarray) -> float:
    return _quantile(values, 0.5)


def _quantile(values: np.ndarray, q: float) -> float:
    """Quantile of the finite values."""
    finite = values[np.isfinite(values)]
    return float(np.quantile(finite, q)) if len(finite) else float("nan")


def _changes(time_s: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Absolute changes between consecutive scans, where both have a value."""
    near = np.diff(time_s) < CONSECUTIVE_S
    before, after = values[:-1][near], values[1:][near]
    both = np.isfinite(before) & np.isfinite(after)
    return np.abs(after[both] - before[both])


def _mean(values: np.ndarray) -> float:
    finite = values[np.isfinite(values)]
    return float(finite.mean()) if len(finite) else float("nan")


def _share_none(ranges_m: np.ndarray) -> float:
    return float(np.mean(~np.isfinite(ranges_m)))


def measure(scans: Scans, perceived: Perceived, spread_m: np.ndarray) -> LaneFigures:
    """Measures a run; `spread_m` (n, 2) is that of this workspace's follower."""
    ranges, angles = scans.ranges_m, scans.angles_rad
    degrees, tiny = np.degrees(angles), 1e-6
    ahead = ranges[:, np.abs(degrees) <= AHEAD_DEG + tiny]
    sides = ranges[:, np.abs(np.abs(degrees) - 90.0) <= SIDE_DEG + tiny]
    seen = np.where(np.isfinite(ranges), ranges, 0.0)  # x = 0 is not in the rectangle
    x, y = seen * np.cos(angles), seen * np.sin(angles)
    on_axis = (np.abs(y) <= AXIS_M) & (x >= AXIS_FROM_M) & (x <= AXIS_TO_M)
    flicker = _changes(scans.time_s, sides)
    moves = _changes(perceived.time_s, perceived.left_m)
    width = perceived.left_m + perceived.right_m
    return LaneFigures(
        no_return_share=_share_none(ranges),
        ahead_no_return_share=_share_none(ahead),
        ahead_median_m=_median(ahead),
        ahead_p10_m=_quantile(ahead, 0.1),
        axis_returns=float(on_axis.sum(axis=1).mean()),
        range_median_m=_median(ranges),
        range_p90_m=_quantile(ranges, 0.9),
        side_median_m=_median(sides),
        flicker_median_m=_median(flicker),
        flicker_share=_mean(flicker > FLICKER_M),
        left_spread_m=_mean(spread_m[:, 0]),
        right_spread_m=_mean(spread_m[:, 1]),
        width_m=float(width.mean()),
        width_sd_m=float(width.std()),
        left_change_median_m=_median(moves),
        left_change_p95_m=_quantile(moves, 0.95),
        heading_sd_rad=float(perceived.heading_rad.std()),
        speed_m_s=scan_speed_m_s(scans),
    )


def with_ride(figures: LaneFigures, ride_rad: np.ndarray) -> LaneFigures:
    """Adds the ride's figures; `ride_rad` (n, 3) is roll, pitch and heading in the lane at each scan."""
    roll, pitch, yaw = (float(value) for value in ride_rad.std(axis=0))
    return replace(figures, roll_sd_rad=roll, pitch_sd_rad=pitch, yaw_sd_rad=yaw)


def by_bearing(scans: Scans) -> np.ndarray:
    """Returns the QUANTILES of range (3, bins) by bearing; a beam without return counts as at NOWHERE_M."""
    bins = np.floor(np.degrees(scans.angles_rad - scans.angle_min_rad) / BEARING_DEG + 1e-6)
    ranges = np.where(np.isfinite(scans.ranges_m), scans.ranges_m, NOWHERE_M)
    span_deg = math.degrees(scans.increment_rad) * (ranges.shape[1] - 1)
    count = max(int(round(span_deg / BEARING_DEG)), 1)  # a last beam at +135 degrees has no bin
    found = [ranges[:, bins == i] for i in range(count)]
    nothing = [np.nan] * len(QUANTILES)
    return np.array([np.quantile(one, QUANTILES) if one.size else nothing for one in found]).T


def measure_real(run: RealRun, source: str) -> RealLane:
    """Measures a real run; the spread of points about their line is what this follower finds in its scans."""
    figures = measure(run.scans, run.perceived, _own(run).spread_m)
    quantiles = (tuple(map(float, row)) for row in by_bearing(run.scans))
    return RealLane(source, len(run.scans.time_s), figures, *quantiles)


def measure_follower(run: RealRun) -> LaneFigures:
    """Measures a real run's scans with what this workspace's follower perceives in them."""
    own = _own(run)
    return measure(run.scans, own, own.spread_m)


def _own(run: RealRun) -> Perceived:
    return follow(run.scans, replace(Parameters(), lane_width_m=run.lane_width_m))


def read_real_lane(path: Path) -> RealLane:
    """Reads the figures of a real run."""
    return build(RealLane, read_yaml_lines(path))


def write_real_lane(lane: RealLane, path: Path) -> None:
    """Writes the figures of a real run as `read_real_lane` reads them."""
    plain = asdict(lane)
    known = {name: v for name, v in plain["figures"].items() if math.isfinite(v)}
    plain["figures"] = {name: float(f"{v:.4g}") for name, v in known.items()}
    for name in ("ranges_p10_m", "ranges_p50_m", "ranges_p90_m"):
        plain[name] = [round(value, 3) for value in plain[name]]
    path.write_text(yaml.safe_dump(plain, sort_keys=False, default_flow_style=None, width=120))


def _mean_cells(values: Sequence[float], digits: int) -> List[str]:
    """Mean of the runs that have a value, and its 95 % interval."""
    known = [value for value in values if np.isfinite(value)]
    if len(known) < 2:
        return [f"{known[0]:.{digits}f}" if known else "-", "-"]
    found = mean_interval(known)
    form = f"{{:.{digits}f}}".format
    return [form(found.estimate), f"{form(found.low)} to {form(found.high)}"]


def table(columns: Dict[str, LaneFigures], runs: Sequence[LaneFigures], name: str) -> str:
    """Returns Markdown: a line a figure; given columns, then the mean of the simulated runs and its interval."""
    heads = ["", *columns, *([name, "95 % interval"] if runs else [])]
    lines = [heads, ["---"] * len(heads)]
    for one in MEASURES:
        digits = one.digits
        given = [one.scale * getattr(figures, one.name) for figures in columns.values()]
        cells = [f"{value:.{digits}f}" if np.isfinite(value) else "-" for value in given]
        if runs:
            cells += _mean_cells([one.scale * getattr(run, one.name) for run in runs], digits)
        lines.append([one.text, *cells])
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)
