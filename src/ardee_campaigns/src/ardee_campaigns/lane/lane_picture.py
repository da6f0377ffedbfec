# SPDX-License-Identifier: MIT
"""Picture of a lane as a real and a simulated lidar see it: a scan of each over the other, and range by bearing."""
from pathlib import Path
from typing import Optional

import numpy as np

from ardee_campaigns.lane.lane_figures import BEARING_DEG, RealLane, by_bearing
from ardee_campaigns.lane.scans import Scans
from ardee_campaigns.plots import pyplot, save

REAL, SIMULATED = "#d1495b", "#1f3b73"
SHOWN_M = 2.5  # beside and before the lidar in the plan


def _plan(axes: pyplot.Axes, scans: Scans, color: str, label: str) -> None:
    """Draws the returns of the scan in the middle, x up and y to the left."""
    ranges = scans.ranges_m[len(scans.ranges_m) // 2]
    ranges = np.where(np.isfinite(ranges), ranges, np.nan)
    x, y = ranges * np.cos(scans.angles_rad), ranges * np.sin(scans.angles_rad)
    axes.plot(-y, x, ".", color=color, markersize=3.0, alpha=0.7, label=label)


def _band(
    axes: pyplot.Axes, quantiles: np.ndarray, first_deg: float, color: str, label: str
) -> None:
    """Draws quantiles of range by bearing."""
    bearings = first_deg + BEARING_DEG * (np.arange(quantiles.shape[1]) + 0.5)
    low, middle, high = quantiles
    axes.fill_between(bearings, low, high, color=color, alpha=0.15, linewidth=0.0)
    axes.plot(bearings, middle, color=color, label=label)


def _first_deg(scans: Scans) -> float:
    return float(np.degrees(scans.angle_min_rad))


def draw(
    path: Path,
    real: Optional[RealLane],
    real_scans: Optional[Scans],
    scans: Optional[Scans],
    name: str,
) -> None:
    """Draws a real lane by its figures or its scans, and the scans of a simulated run called `name`."""
    figure, (plan, bearing) = pyplot.subplots(1, 2, figsize=(13.0, 6.0))
    if real is not None:
        quantiles = np.array([real.ranges_p10_m, real.ranges_p50_m, real.ranges_p90_m])
        _band(bearing, quantiles, -135.0, REAL, "real")
    elif real_scans is not None:
        _band(bearing, by_bearing(real_scans), _first_deg(real_scans), REAL, "real")
    if real_scans is not None:
        _plan(plan, real_scans, REAL, "real")
    if scans is not None:
        _plan(plan, scans, SIMULATED, name)
        _band(bearing, by_bearing(scans), _first_deg(scans), SIMULATED, name)
    plan.plot(0.0, 0.0, "^", color="black", label="lidar")
    plan.set_aspect("equal")
    plan.set_xlim(-SHOWN_M, SHOWN_M)
    plan.set_ylim(-1.5, SHOWN_M)
    plan.set_xlabel("to the right of the lidar [m]")
    plan.set_ylabel("before the lidar [m]")
    plan.set_title("a scan from the middle of the run", loc="left")
    plan.legend(loc="lower right", fontsize="small", markerscale=2.0)
    bearing.set_yscale("log")
    bearing.set_xlabel("bearing, positive to the left [deg]")
    bearing.set_ylabel("range [m]; 30: no return")
    bearing.set_title("all scans: median, 10th to 90th percentile", loc="left")
    bearing.legend(loc="upper right", fontsize="small")
    bearing.grid(alpha=0.3, which="both")
    save(figure, path)
