# SPDX-License-Identifier: MIT
"""Reports on the demo's drive, from its recording."""
import math
import pathlib
from dataclasses import dataclass
from typing import Any, Dict


@dataclass(frozen=True)
class Drive:
    """Data of a drive in a bag: simulated time, path of the odometry, number of scans."""

    duration_s: float
    distance_m: float
    scans: int


def read_drive(path: pathlib.Path, scan_topic: str) -> Drive:
    """Reads a recorded drive."""
    import rosbag

    last, distance_m, scans, stamps = None, 0.0, 0, []
    with rosbag.Bag(str(path)) as bag:
        for topic, message, _ in bag.read_messages(["/odom", scan_topic]):
            if topic == scan_topic:
                scans += 1
                continue
            here = message.pose.pose.position
            if last is not None:
                distance_m += math.hypot(here.x - last.x, here.y - last.y)
            last = here
            stamps.append(message.header.stamp.to_sec())
    if len(stamps) < 2 or scans == 0:
        raise RuntimeError(f"{path.name}: {len(stamps)} odometry messages and {scans} scans")
    return Drive(stamps[-1] - stamps[0], distance_m, scans)


def summary(
    drive: Drive, real_time_factor: float, truth: Dict[str, Any], output: pathlib.Path
) -> str:
    """Returns the summary, one screen of text."""
    rows = [
        ("distance driven", f"{drive.distance_m:.2f} m in {drive.duration_s:.1f} s simulated"),
        ("real-time factor", f"{real_time_factor:.2f} (farm.world asks for 1)"),
        ("scans published", f"{drive.scans}"),
        ("plants in the field", f"{truth['emerged']} of {truth['planned']} planned"),
        ("picture of rviz", f"{output / 'rviz.png'}"),
        ("bag of the drive", f"{output / 'drive.bag'}"),
    ]
    return "\n".join(f"   {name:<21}{value}" for name, value in rows)
