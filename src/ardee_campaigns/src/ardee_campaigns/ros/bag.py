# SPDX-License-Identifier: MIT
"""Drives a recorded run again in the node `simulator`, by its commands, and writes what that publishes to a rosbag."""
import tempfile
import threading
import time
from pathlib import Path
from typing import Any, Dict, Mapping

import rosbag
import rosgraph
import rospy
from roslib.message import get_message_class

from ardee_campaigns import tables
from ardee_campaigns.plan import Job
from ardee_campaigns.rerun import follow
from ardee_campaigns.ros.driven import RosDriven
from ardee_campaigns.run import sow
from ardee_common.errors import GeneratorError
from ardee_common.ros_graph import wait_until
from ardee_common.ros_node import is_connected

_LARGE = ("sensor_msgs/CompressedImage", "sensor_msgs/Image", "sensor_msgs/PointCloud2")
_LAST_S = 1.0  # for the last messages to arrive
_CLOCK = "/clock"


class Recorder:
    """Writes messages at their stamps, or at the time of /clock. Unlike `rosbag record` it never falls behind."""

    def __init__(self, path: Path, kinds: Mapping[str, str]) -> None:
        self._bag, self._lock, self._now = (
            rosbag.Bag(str(path), "w"),
            threading.Lock(),
            rospy.Time(),
        )
        self.counts = dict.fromkeys(kinds, 0)
        self._subscribers = [self._subscriber(_CLOCK, kinds)]
        wait_until(lambda: self._now, f"a message of {_CLOCK}")
        self._subscribers += [self._subscriber(topic, kinds) for topic in set(kinds) - {_CLOCK}]
        wait_until(lambda: all(map(is_connected, self._subscribers)), "topics")

    def _subscriber(self, topic: str, kinds: Mapping[str, str]) -> rospy.Subscriber:
        kind = get_message_class(kinds[topic])
        if kind is None:
            expected = "a message of a sourced workspace"
            raise GeneratorError(f"{topic}: found type {kinds[topic]}, expected {expected}")
        return rospy.Subscriber(topic, kind, self._take, topic, buff_size=1 << 20)

    def _take(self, message: Any, topic: str) -> None:
        with self._lock:
            if topic == _CLOCK:
                self._now = message.clock
            first = message.transforms[0] if getattr(message, "transforms", None) else message
            stamp = first.header.stamp if hasattr(first, "header") else None
            self._bag.write(topic, message, stamp or self._now)
            self.counts[topic] += 1

    def close(self) -> None:
        """Ends the bag."""
        for subscriber in self._subscribers:
            subscriber.unregister()
        with self._lock:
            self._bag.close()


def write_bag(job: Job, run: tables.RunFile, path: Path) -> None:
    """Writes all topics but those of cameras and clouds that are not among the robot's `topics`."""
    part = path.with_name(f".{path.name}")
    try:
        with tempfile.TemporaryDirectory(prefix="ardee_bag_") as work:
            trial = sow(job, Path(work) / "models")
            with RosDriven(job, trial, Path(work), is_relay=False) as driven:
                driven.spawn(trial.start, trial)
                recorder = Recorder(part, _topics(driven.topics))
                try:
                    for _ in follow(job, run.samples, driven, trial):
                        pass
                    time.sleep(_LAST_S)
                finally:
                    recorder.close()
        _check(recorder.counts, driven.pace, len(run.samples))
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)


def _check(counts: Mapping[str, int], topic: str, least: int) -> None:
    if topic and counts[topic] < least:
        raise GeneratorError(f"{topic}: recorded {counts[topic]} messages, expected {least}")


def _topics(wanted: Mapping[str, str]) -> Dict[str, str]:
    """Returns the topics to record and their types."""
    master = rosgraph.Master(rospy.get_name())
    published = {topic for topic, _ in master.getSystemState()[0] if topic != "/rosout"}
    return {
        topic: kind
        for topic, kind in master.getTopicTypes()
        if topic in published and (kind not in _LARGE or topic in wanted.values())
    }
