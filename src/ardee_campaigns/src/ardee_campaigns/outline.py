# SPDX-License-Identifier: MIT
"""A robot's outline on the ground plan, of the collision bodies of its URDF, and the stalks that it touches.

Plants are static scenery to the simulator: they stop a robot but never fall. So contacts are counted by geometry.
"""
import math
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Dict, Iterator, List, Set

import numpy as np
from ardee_sim.packages import find_package

from ardee_common.errors import GeneratorError
from ardee_models.mesh_file import read_pieces
from ardee_world.row_truth import Pose, Stalks

TOUCH_M = 0.01  # a rigid stalk is not entered: what is nearer than this is touched
KNOCKED_M = 0.02  # a stalk as deep as this below the outline would have been pushed over
_LARGEST_STALK_M = 0.2
_CIRCLE = np.linspace(0.0, 2.0 * math.pi, 32, endpoint=False)
_MOST_LINKS = 10_000


def _numbers(text: str) -> np.ndarray:
    return np.array([float(word) for word in text.split()])


def _pose(parent: ElementTree.Element) -> np.ndarray:
    """Returns the 4x4 matrix of an element's <origin>."""
    origin = parent.find("origin")
    matrix = np.eye(4)
    if origin is not None:
        roll, pitch, yaw = _numbers(origin.get("rpy", "0 0 0"))
        cr, sr, cp, sp = math.cos(roll), math.sin(roll), math.cos(pitch), math.sin(pitch)
        cy, sy = math.cos(yaw), math.sin(yaw)
        matrix[:3, :3] = [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
        matrix[:3, 3] = _numbers(origin.get("xyz", "0 0 0"))
    return matrix


def _mesh(shape: ElementTree.Element) -> np.ndarray:
    name = shape.get("filename", "")
    if name.startswith("package://"):
        package, _, rest = name[len("package://") :].partition("/")
        file = find_package(package) / rest
    else:
        file = Path(name[len("file://") :] if name.startswith("file://") else name)
    pieces = read_pieces(file, "auto", None, lambda text: None)
    points = np.concatenate([piece.vertices_m() for piece in pieces])
    return points * _numbers(shape.get("scale", "1 1 1"))


def _points(collision: ElementTree.Element) -> np.ndarray:
    """Returns points (n, 3) in the link's frame whose convex hull is a collision body."""
    geometry = collision.find("geometry")
    shape = next(iter(geometry)) if geometry is not None and len(geometry) else None
    if shape is None:
        raise GeneratorError("found a collision without geometry, expected a shape")
    circle = np.column_stack((np.cos(_CIRCLE), np.sin(_CIRCLE), np.zeros(len(_CIRCLE))))
    if shape.tag == "box":
        signs = np.array(np.meshgrid([-0.5, 0.5], [-0.5, 0.5], [-0.5, 0.5])).reshape(3, -1).T
        local = signs * _numbers(shape.get("size", ""))
    elif shape.tag == "cylinder":
        half = float(shape.get("length", "")) / 2.0
        ring = circle * float(shape.get("radius", ""))
        local = np.concatenate((ring + [0, 0, half], ring - [0, 0, half]))
    elif shape.tag == "sphere":
        rings = [circle, circle[:, [0, 2, 1]], circle[:, [2, 0, 1]]]
        local = np.concatenate(rings) * float(shape.get("radius", ""))
    elif shape.tag == "mesh":
        local = _mesh(shape)
    else:
        raise GeneratorError(f"found a collision of shape <{shape.tag}>, expected a known one")
    pose = _pose(collision)
    return local @ pose[:3, :3].T + pose[:3, 3]


def _links(root: ElementTree.Element) -> Iterator[tuple]:
    """Yields each link and its 4x4 matrix in the root link's frame, all joints at 0."""
    links = {link.get("name"): link for link in root.findall("link")}
    joints: Dict[str, List[ElementTree.Element]] = {}
    children = set()
    for joint in root.findall("joint"):
        joints.setdefault(joint.find("parent").get("link"), []).append(joint)
        children.add(joint.find("child").get("link"))
    waiting = [(name, np.eye(4)) for name in links if name not in children]
    for _ in range(_MOST_LINKS):
        if not waiting:
            return
        name, pose = waiting.pop()
        yield links[name], pose
        for joint in joints.get(name, []):
            waiting.append((joint.find("child").get("link"), pose @ _pose(joint)))


def outline_of(urdf: str) -> np.ndarray:
    """Returns the convex outline (n, 2) of all collision bodies on the ground plan, counter-clockwise."""
    try:
        root = ElementTree.fromstring(urdf)
        found = []
        for link, pose in _links(root):
            for collision in link.findall("collision"):
                points = _points(collision)
                found.append((points @ pose[:3, :3].T + pose[:3, 3])[:, :2])
    except (ElementTree.ParseError, AttributeError, KeyError, ValueError) as error:
        raise GeneratorError(f"outline: no readable URDF: {error}") from error
    if not found:
        raise GeneratorError("outline: found no collision body, expected length_m and width_m")
    return convex_hull(np.concatenate(found))


def rectangle(length_m: float, width_m: float) -> np.ndarray:
    """Returns a rectangle (4, 2) about the origin, counter-clockwise."""
    x, y = length_m / 2.0, width_m / 2.0
    return np.array([[-x, -y], [x, -y], [x, y], [-x, y]])


def convex_hull(points_m: np.ndarray) -> np.ndarray:
    """Returns the convex hull (k, 2) of points (n, 2), counter-clockwise (Andrew's monotone chain)."""
    ordered = np.unique(np.round(points_m, 9), axis=0)

    def chain(points: np.ndarray) -> List[np.ndarray]:
        kept: List[np.ndarray] = []
        for point in points:
            while len(kept) > 1:
                (ax, ay), (bx, by) = kept[-1] - kept[-2], point - kept[-1]
                if ax * by - ay * bx > 1e-12:
                    break
                kept.pop()
            kept.append(point)
        return kept[:-1]

    return np.array(chain(ordered) + chain(ordered[::-1]))


def depths_m(outline_m: np.ndarray, xy_m: np.ndarray, radius_m: np.ndarray) -> np.ndarray:
    """Returns how far circles (n) reach into a convex outline in its own frame, negative where they stay outside."""
    edge = np.roll(outline_m, -1, axis=0) - outline_m
    length = np.hypot(*edge.T)
    unit = edge / length[:, None]
    offset = xy_m[:, None, :] - outline_m[None, :, :]
    outwards = unit[:, 1] * offset[..., 0] - unit[:, 0] * offset[..., 1]
    along = np.clip((offset * unit).sum(axis=2), 0.0, length)
    apart = np.hypot(*np.moveaxis(offset - along[..., None] * unit, 2, 0)).min(axis=1)
    deepest = outwards.max(axis=1)
    return radius_m - np.where(deepest > 0.0, apart, deepest)


class Contacts:
    """Counts contacts of an outline with stalks over the poses of a run."""

    def __init__(self, outline_m: np.ndarray, stalks: Stalks) -> None:
        self._outline_m, self._stalks = outline_m, stalks
        self._reach_m = float(np.hypot(*outline_m.T).max()) + _LARGEST_STALK_M
        order = np.argsort(stalks.xy_m[:, 0], kind="stable")
        self._order, self._x_m = order, stalks.xy_m[order, 0]
        self.collisions = 0  # times that contact began
        self.touched: Set[int] = set()
        self.knocked: Set[int] = set()
        self._in_contact: Set[int] = set()

    def update(self, pose: Pose) -> int:
        """Returns how many stalks are touched at this pose; contact that was not there before is a collision."""
        low, high = np.searchsorted(self._x_m, [pose.x_m - self._reach_m, pose.x_m + self._reach_m])
        near = self._order[low:high]
        offset = self._stalks.xy_m[near] - np.array([pose.x_m, pose.y_m])
        c, s = math.cos(pose.yaw_rad), math.sin(pose.yaw_rad)
        local = np.column_stack(
            (c * offset[:, 0] + s * offset[:, 1], -s * offset[:, 0] + c * offset[:, 1])
        )
        depth = depths_m(self._outline_m, local, self._stalks.radius_m[near])
        now = set(near[depth > -TOUCH_M].tolist())
        self.collisions += len(now - self._in_contact)
        self.touched |= now
        self.knocked |= set(near[depth > KNOCKED_M].tolist())
        self._in_contact = now
        return len(now)
