# SPDX-License-Identifier: MIT
"""Summarizes a sensor's messages in few numbers: images and clouds are too large to pass between processes."""
import math
from typing import Any, Callable, Dict, List

import numpy as np
import rospy
from probes import _start, _type

from ardee_common.ros_graph import wait_until
from ardee_common.ros_node import is_connected

DEPTH_TYPES = {"32FC1": (np.float32, 1.0), "16UC1": (np.uint16, 1e-3)}
FIELD_TYPES = {2: "u1", 4: "<u2", 6: "<u4", 7: "<f4", 8: "<f8"}  # sensor_msgs/PointField


def image(message: Any) -> Dict[str, Any]:
    """Returns size, encoding, and the mean (depth: the median in m) of the middle ninth."""
    kind, scale = DEPTH_TYPES.get(message.encoding, (np.uint8, 1.0))
    pixels = np.frombuffer(message.data, kind).reshape(
        message.height, message.step // np.dtype(kind).itemsize
    )
    channels = pixels.shape[1] // message.width
    rows = slice(message.height // 3, 2 * message.height // 3)
    columns = slice(channels * (message.width // 3), channels * (2 * message.width // 3))
    middle = pixels[rows, columns].astype(float) * scale
    value = np.nanmedian(middle) if message.encoding in DEPTH_TYPES else middle.mean()
    return {
        "width": message.width,
        "height": message.height,
        "step": message.step,
        "encoding": message.encoding,
        "middle": float(value),
    }


def camera_info(message: Any) -> Dict[str, Any]:
    return {k: getattr(message, k) for k in ("width", "height", "K", "P", "D", "distortion_model")}


def scan(message: Any) -> Dict[str, Any]:
    """Returns the scan's numbers and the range straight ahead."""
    fields = ("angle_min", "angle_max", "angle_increment", "range_min", "range_max")
    ahead = round((0.0 - message.angle_min) / message.angle_increment)
    return {
        **{field: getattr(message, field) for field in fields},
        "samples": len(message.ranges),
        "intensities": len(message.intensities),
        "ahead": message.ranges[ahead],
    }


def cloud(message: Any) -> Dict[str, Any]:
    """Returns fields, size, and the elevations, azimuths and ranges of its finite points about x (depth: about z)."""
    fields = {f.name: (FIELD_TYPES[f.datatype], f.offset) for f in message.fields}
    names = list(fields)
    record = np.dtype(
        {
            "names": names,
            "formats": [fields[n][0] for n in names],
            "offsets": [fields[n][1] for n in names],
            "itemsize": message.point_step,
        }
    )
    points = np.frombuffer(message.data, record)
    xyz = np.column_stack([points[axis] for axis in "xyz"]).astype(float)
    finite = np.isfinite(xyz).all(axis=1)
    near = xyz[finite]
    distance = np.linalg.norm(near, axis=1)
    ahead = near[(np.abs(near[:, 1]) < 0.1) & (np.abs(near[:, 2]) < 0.1)]
    along_z = near[(np.abs(near[:, 0]) < 0.1) & (np.abs(near[:, 1]) < 0.1)]
    return {
        "fields": names,
        "point_step": message.point_step,
        "width": message.width,
        "height": message.height,
        "points": int(finite.sum()),
        "rings": sorted({int(r) for r in points["ring"]}) if "ring" in fields else [],
        "elevations": [float(v) for v in _ends(np.arcsin(near[:, 2] / distance))],
        "azimuths": [float(v) for v in _ends(np.arctan2(near[:, 1], near[:, 0]))],
        "ranges": [float(v) for v in _ends(distance)],
        "ahead": float(np.median(ahead[:, 0])) if len(ahead) else math.nan,
        "along_z": float(np.median(along_z[:, 2])) if len(along_z) else math.nan,
    }


def _ends(values: np.ndarray) -> List[float]:
    return [values.min(), values.max()] if len(values) else [math.nan, math.nan]


def plain(message: Any) -> Dict[str, Any]:
    """Returns all fields of a small message."""
    return {slot: getattr(message, slot) for slot in message.__slots__}


SUMMARIES: Dict[str, Callable[[Any], Dict[str, Any]]] = {
    "sensor_msgs/Image": image,
    "sensor_msgs/CameraInfo": camera_info,
    "sensor_msgs/LaserScan": scan,
    "sensor_msgs/PointCloud2": cloud,
}


def step_and_collect(topics: Dict[str, str], steps: int, timeout_s: float = 60.0) -> Dict[str, Any]:
    """Subscribes to topics {name: type} of a paused simulator, steps it, and returns a summary:
    {topic: {"stamps": [...], "frame": ..., "last": summary of the last message}}.
    """
    _start()
    received: Dict[str, List[Any]] = {topic: [] for topic in topics}
    subscribers = [
        rospy.Subscriber(
            topic, _type(kind), received[topic].append, queue_size=100, buff_size=1 << 26
        )
        for topic, kind in topics.items()
    ]
    wait_until(lambda: all(map(is_connected, subscribers)), f"publishers of {list(topics)}")
    rospy.wait_for_service("/ardee/step", timeout_s)
    answer = rospy.ServiceProxy("/ardee/step", _type("ardee_msgs/Step"))(steps=steps)
    assert answer.success, answer.status_message
    wait_until(
        lambda: all(len(m) >= 3 for m in received.values()), f"3 messages on each of {list(topics)}"
    )
    found = {}
    for topic, messages in received.items():
        summary = SUMMARIES.get(topics[topic], plain)
        found[topic] = {
            "stamps": [message.header.stamp.to_sec() for message in messages],
            "frame": messages[-1].header.frame_id,
            "last": summary(messages[-1]),
        }
    return found
