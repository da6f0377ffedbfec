# SPDX-License-Identifier: MIT
"""Scans down a lane: of a rosbag, a CSV file or a real run's folder, and of a campaign's runs, done again."""
from pathlib import Path
from typing import Any, List, Optional, Sequence, Tuple

import numpy as np

from ardee_campaigns import tables
from ardee_campaigns.lane.real_run import LIDAR_LOG, read_scans
from ardee_campaigns.lane.scans import Scans, returns_m
from ardee_campaigns.replay import Replayer, ScanLog, in_lane
from ardee_campaigns.rerun import do_again
from ardee_common.cli import steps
from ardee_common.errors import GeneratorError, known_names

Named = Tuple[str, Scans]


def read_recorded(source: Path, topic: str) -> Scans:
    """Returns the scans of a .bag file's topic, of a CSV file, or of a folder with a lidar_log.csv."""
    if source.suffix == ".bag":
        return _read_bag(source, topic)
    return read_scans(source / LIDAR_LOG if source.is_dir() else source)


def _read_bag(path: Path, topic: str) -> Scans:
    try:
        import rosbag
    except ImportError:
        what = f"{path}: needs the Python module rosbag, which Debian's python3-rosbag has"
        raise GeneratorError(f"{what}; a CSV file needs none") from None
    try:
        with rosbag.Bag(str(path)) as bag:
            known = bag.get_type_and_topic_info().topics
            if topic not in known:
                raise GeneratorError(
                    f"{path}: --topic: found {topic!r}, {known_names(topic, known)}"
                )
            kind = known[topic].msg_type
            if kind != "sensor_msgs/LaserScan":
                raise GeneratorError(f"{path}: {topic}: found {kind}, expected a LaserScan")
            return _scans_of([message for _, message, _ in bag.read_messages([topic])], path)
    except (OSError, rosbag.ROSBagException) as error:
        raise GeneratorError(f"{path}: not a bag that can be read: {error}") from None


def _scans_of(messages: Sequence[Any], path: Path) -> Scans:
    if len(messages) < 2:
        raise GeneratorError(f"{path}: found {len(messages)} scans, expected 2 or more")
    first = messages[0]
    forms = {(len(m.ranges), m.angle_min, m.angle_increment) for m in messages}
    if len(forms) > 1:
        raise GeneratorError(f"{path}: found scans of {len(forms)} forms, expected one lidar's")
    time_s = np.array([message.header.stamp.to_sec() for message in messages])
    if np.any(np.diff(time_s) <= 0.0):
        number = int(np.flatnonzero(np.diff(time_s) <= 0.0)[0]) + 2
        raise GeneratorError(
            f"{path}: scan {number}: found a stamp not later than the one before, expected a later"
        )
    ranges = np.array([message.ranges for message in messages], dtype=float)
    ranges = returns_m(ranges, first.range_min, first.range_max)
    return Scans(time_s, ranges, first.angle_min, first.angle_increment)


def is_campaign(folder: Path) -> bool:
    """Returns whether a folder is a campaign's."""
    return (folder / tables.RUNS).is_file()


def rerun(folder: Path, run_ids: Sequence[str], file: Optional[Path], prog: str) -> List[Named]:
    """Does runs of a campaign again; returns the scans of each while the lidar was in the lane."""
    replayer, found = Replayer(folder, file), []
    for run_id in steps(prog, run_ids):
        log = ScanLog()
        done = do_again(replayer.job(run_id), folder, log.watch)
        if done.row.status != tables.OK:
            raise GeneratorError(f"run {run_id}: {done.row.error}")
        scans = in_lane(log.scans(), done)
        if len(scans.time_s) < 2:
            number = len(scans.time_s)
            raise GeneratorError(f"run {run_id}: found {number} scans in the lane, expected 2")
        found.append((run_id, scans))
    return found
