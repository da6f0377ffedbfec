# SPDX-License-Identifier: MIT
"""Shows a robot's readings: scans and clouds in the scene, pictures beside it."""

import contextlib
from typing import Any, Callable, Dict, List, Optional

import numpy as np
from ardee_sim.readings import ImageReading, LidarReading, PointCloudReading
from ardee_sim.simulation import Entity, Simulation
from ardee_sim.view.scene import node, remove

_MOST_POINTS = 50_000
_MOST_PX = 480  # width of a picture in the page
_MOST_DEPTH_M = 10.0  # white in the page
_COLORS = ((230, 30, 30), (30, 90, 230), (230, 140, 0), (150, 40, 200))
_CLOUDS = {"LidarReading", "PointCloudReading", "LegacyCloudReading"}


def points_of(reading: Any) -> np.ndarray:
    """Returns the points of a scan or cloud in the sensor's frame, float32[n, 3], at most 50,000."""
    if isinstance(reading, LidarReading):
        met = np.flatnonzero(np.isfinite(reading.ranges_m))
        ranges_m = reading.ranges_m[met]
        angles = reading.angle_min_rad + reading.angle_increment_rad * met
        points = np.stack(
            [ranges_m * np.cos(angles), ranges_m * np.sin(angles), np.zeros_like(ranges_m)], axis=1
        )
    elif isinstance(reading, PointCloudReading):
        points = np.stack([reading.points[axis] for axis in "xyz"], axis=1)
    else:
        points = reading.points_m
    points = points[np.isfinite(points).all(axis=1)]
    return points[:: max(1, -(-len(points) // _MOST_POINTS))].astype(np.float32)


def picture_of(reading: ImageReading) -> np.ndarray:
    """Returns a picture for people, uint8[h, w, 3]: depths in gray up to 10 m, labels and instances in colours."""
    pixels = reading.pixels
    pixels = pixels[:: max(1, -(-pixels.shape[1] // _MOST_PX))]
    pixels = pixels[:, :: max(1, -(-pixels.shape[1] // _MOST_PX))]
    if reading.encoding == "bgr8":
        return np.ascontiguousarray(pixels[..., ::-1])
    if pixels.dtype == np.float32:
        shares = np.nan_to_num(pixels / _MOST_DEPTH_M, nan=1.0, posinf=1.0)
        pixels = (255 * np.clip(shares, 0, 1)).astype(np.uint8)
    elif reading.encoding == "mono16":
        pixels = (pixels >> 8).astype(np.uint8)
    elif pixels.dtype in (np.uint16, np.int32):
        ids = pixels.astype(np.int64)[..., None]
        return (ids * np.array([97, 57, 151]) % 256).astype(np.uint8)
    return np.repeat(pixels[..., None], 3, axis=2) if pixels.ndim == 2 else pixels


class Wish:
    """A topic that the page shows, demanded if nobody else does; at the end undemanded unless others did since."""

    def __init__(self, sim: Simulation, topic: str) -> None:
        self._sim, self.topic = sim, topic
        self._is_ours = not sim.demands(topic)
        self._last: Any = None
        if self._is_ours:
            sim.demand(topic)
        self._demand_count = sim.demand_count(topic)

    def take(self) -> Any:
        """Returns the last reading if it is a new one, else None."""
        reading = self._sim.latest(self.topic)
        if reading is None or (self._last is not None and reading.stamp_ns == self._last.stamp_ns):
            return None
        self._last = reading
        return reading

    def close(self) -> None:
        """Ends the demand."""
        if self._is_ours and self._sim.demand_count(self.topic) == self._demand_count:
            # a simulation that was closed, or lost the robot, measures no more
            with contextlib.suppress(RuntimeError, KeyError):
                self._sim.undemand(self.topic)


class CloudView:
    """Points of a scan or cloud as a child of the sensor's link, with which they move."""

    def __init__(self, server: Any, sim: Simulation, robot: str, topic: str, number: int) -> None:
        self._wish = Wish(sim, topic)
        self._server, self._color = server, _COLORS[number % len(_COLORS)]
        link = link_of(sim, robot, topic)
        assert link is not None
        self._name = node("models", robot, link, topic.strip("/"))
        self._handle: Any = None

    def update(self) -> None:
        """Shows the last reading."""
        reading = self._wish.take()
        if reading is None:
            return
        points = points_of(reading)
        if self._handle is None:
            self._handle = self._server.scene.add_point_cloud(
                self._name, points, self._color, point_size=0.02, point_shape="circle"
            )
        else:
            self._handle.points = points

    def close(self) -> None:
        """Takes the points away."""
        self._wish.close()
        if self._handle is not None:
            remove(self._handle)


class PictureView:
    """The last picture of a camera, in the panel."""

    def __init__(self, sim: Simulation, topic: str, show: Callable[[np.ndarray], None]) -> None:
        self._wish, self._show = Wish(sim, topic), show

    def update(self) -> None:
        """Shows the last picture."""
        reading = self._wish.take()
        if reading is not None:
            self._show(picture_of(reading))

    def close(self) -> None:
        """Ends the demand."""
        self._wish.close()


def _entity(sim: Simulation, robot: str) -> Entity:
    return next(entity for entity in sim.entities() if entity.name == robot)


def link_of(sim: Simulation, robot: str, topic: str) -> Optional[str]:
    """Returns the link in whose frame a topic's readings are; None if it has no such link."""
    frame = sim.topics()[topic].frame_id.rpartition("/")[2]
    return frame if frame in _entity(sim, robot).links else None


def topics_of(sim: Simulation, robot: str) -> Dict[str, List[str]]:
    """Returns the robot's topics by what the page does with them: clouds, pictures, drives."""
    infos = sim.topics()
    found: Dict[str, List[str]] = {"clouds": [], "pictures": [], "drives": []}
    for topic in dict.fromkeys(_entity(sim, robot).topics):
        info = infos[topic]
        if info.role == "reading" and info.kind in _CLOUDS:
            found["clouds"].append(topic)
        elif info.role == "reading" and info.kind == "ImageReading":
            found["pictures"].append(topic)
        elif info.role == "command" and info.kind == "Twist":
            found["drives"].append(topic)
    return found
