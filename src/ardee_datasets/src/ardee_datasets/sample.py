# SPDX-License-Identifier: MIT
"""One sample: the layers of a picture and the description of what is in it."""

import json
import math
import tempfile
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any, Dict, List, Sequence, Tuple

import numpy as np
from PIL import Image
from scipy import ndimage

from ardee_common.output import write_file
from ardee_datasets import rle
from ardee_datasets.camera import CameraKeys
from ardee_datasets.categories import OWN_LABELS
from ardee_datasets.lidar import Lidar
from ardee_datasets.motion import Motion
from ardee_datasets.plan import Scene, Shot
from ardee_datasets.recipe import view_name
from ardee_datasets.rows import Row, Size, foot_keypoint, nearest_direction, vanishing_point
from ardee_datasets.scenery import CameraPose, Item, Scenery

# Layer to the ending of its files
LAYERS = {"rgb": "png", "labels": "png", "instances": "png", "organs": "png", "depth": "tiff"}
# Organs by their numbers, and the visual elements of crop models that they are
ORGANS = {1: "stalk", 2: "leaf", 3: "ear", 4: "tassel", 5: "panicle", 6: "flower", 7: "root"}
_ORGAN_OF = {
    "stem": 1,
    "tillers": 1,
    "leavesb": 2,
    "leavesm": 2,
    "leavest": 2,
    "ears": 3,
    "tassel": 4,
    "panicle": 5,
    "flowers": 6,
    "roots": 7,
}


def json_bytes(data: Any) -> bytes:
    """Returns JSON text that depends on nothing but the data."""
    return (json.dumps(data, indent=1, sort_keys=True) + "\n").encode()


def intrinsics(keys: CameraKeys) -> np.ndarray:
    """Returns K, 3x3, of a pinhole camera with square pixels; pixel centres are whole numbers."""
    assert keys.width_px and keys.height_px and keys.horizontal_fov_deg
    focal = keys.width_px / 2 / math.tan(math.radians(keys.horizontal_fov_deg) / 2)
    u, v = (keys.width_px - 1) / 2, (keys.height_px - 1) / 2
    return np.array([[focal, 0.0, u], [0.0, focal, v], [0.0, 0.0, 1.0]])


def numbered(instances: np.ndarray, items: Dict[int, Item]) -> Tuple[np.ndarray, List[int]]:
    """Returns the picture with its own numbers 1..n, 0 for what has no label, and the n instances in order."""
    seen = [int(i) for i in np.unique(instances) if int(i) in items]
    table = np.zeros(int(instances.max()) + 1, dtype=np.uint16)
    table[seen] = np.arange(1, len(seen) + 1)
    return table[instances], seen


def organs(own: np.ndarray, visuals: np.ndarray, items: Sequence[Item]) -> np.ndarray:
    """Returns the picture of crop plants' organs; 0: none, or a part of a model whose name is not known."""
    numbers, column = np.unique(visuals, return_inverse=True)
    table = np.zeros((len(items) + 1, len(numbers)), dtype=np.uint8)
    for n, item in enumerate(items, 1):
        if item.foot_m is not None:
            table[n] = [
                _ORGAN_OF.get(item.visuals.get(number, ""), 0) for number in numbers.tolist()
            ]
    return table[own, column.reshape(own.shape)]


def annotation(
    mask: np.ndarray, box: Tuple[slice, slice], item: Item, lone_px: int
) -> Dict[str, Any]:
    """Returns the COCO annotation of a mask with these rows and columns, without its ids.

    `lone_px` counts its pixels if nothing hid it.
    """
    rows, columns = box
    area = int(np.count_nonzero(mask[box]))
    whole = max(lone_px, area)  # floats may decide on a pixel of the edge in another way
    counts = rle.encode(mask[:, columns], columns.start, mask.shape[1])
    return {
        "category_id": item.label,
        "segmentation": {"size": list(mask.shape), "counts": counts},
        "area": area,
        "visible_px": area,
        "occluded": round(1.0 - area / whole, 4),
        "bbox": [columns.start, rows.start, columns.stop - columns.start, rows.stop - rows.start],
        "iscrowd": 0,
        "truth_id": item.truth_id,
        "kind": item.truth_id.rpartition("_")[0],
        **item.place,
    }


@dataclass(frozen=True)
class View:
    """Geometry of a picture: intrinsics, optical frame in the world, width and height, motion."""

    K: np.ndarray
    X_WC: np.ndarray
    size: Size
    motion: Motion

    def apparent(self, points_m: np.ndarray) -> np.ndarray:
        """Returns points [n, 3] where the shutter lets them appear to a camera at rest."""
        return self.motion.apparent(points_m, self.K, self.X_WC, self.size)

    def description(self, rows: Sequence[Row]) -> Dict[str, Any]:
        """Returns the entries of a sample about its camera and the rows in its picture."""
        meeting = vanishing_point(nearest_direction(rows, self.X_WC[:2, 3]), self.K, self.X_WC)
        seen = (replace(row, line_m=self.apparent(row.line_m)) for row in rows)
        return {
            "width_px": self.size[0],
            "height_px": self.size[1],
            "K": self.K.tolist(),
            "X_WC": self.X_WC.tolist(),
            "motion": self.motion.description(),
            "rows": [one for row in seen for one in row.in_picture(self.K, self.X_WC, self.size)],
            "vanishing_point_px": None if meeting is None else np.round(meeting, 2).tolist(),
        }


def keypoints(mask: np.ndarray, item: Item, depth_m: np.ndarray, view: View) -> Dict[str, Any]:
    """Returns the COCO keypoints of a plant, which are its foot; of clutter none, of own labels 0 0 0."""
    if item.foot_m is None:
        return {"keypoints": [0, 0, 0], "num_keypoints": 0} if item.label >= OWN_LABELS[0] else {}
    (apparent,) = view.apparent(item.foot_m[None])
    foot = foot_keypoint(apparent, view.K, view.X_WC, mask, depth_m)
    return {"keypoints": foot, "num_keypoints": int(foot[2] > 0)}


def annotations(
    own: np.ndarray, items: Sequence[Item], lone_px: np.ndarray, depth_m: np.ndarray, view: View
) -> List[Dict[str, Any]]:
    """Returns the annotations of the items, whose masks have the numbers 1..n in `own`."""
    made = []
    boxes = ndimage.find_objects(own)
    for n, (item, box, alone) in enumerate(zip(items, boxes, lone_px.tolist()), 1):
        mask = own == n
        made.append({**annotation(mask, box, item, alone), **keypoints(mask, item, depth_m, view)})
    return made


def _picture_bytes(array: np.ndarray, ending: str) -> bytes:
    # LZW would pad its last byte with what happens to lie in memory, and so would a file in memory its strips.
    options = {"compression": "tiff_adobe_deflate"} if ending == "tiff" else {"compress_level": 1}
    with tempfile.TemporaryFile() as stream:
        Image.fromarray(array).save(stream, ending, **options)
        stream.seek(0)
        return stream.read()


def _write_clouds(
    split: Path, shot: Shot, pose: CameraPose, scenery: Scenery, lidars: Dict[str, Lidar]
) -> Dict[str, Any]:
    """Writes the clouds of lidars above a camera; returns their poses and instances."""
    made = {}
    for name, lidar in lidars.items():
        X_WL = lidar.pose_above(pose)
        cloud = lidar.measure(X_WL, scenery.items)
        folder = split / "clouds" / name
        write_file(folder / "velodyne" / f"{shot.id}.bin", cloud.points.astype("<f4").tobytes())
        write_file(folder / "labels" / f"{shot.id}.label", cloud.labels.astype("<u4").tobytes())
        numbers = {str(n): truth_id for n, truth_id in enumerate(cloud.instances, 1)}
        made[name] = {"X_WL": X_WL.body_matrix().tolist(), "instances": numbers}
    return made


def _camera(keys: CameraKeys, pose: CameraPose, motion: Motion) -> Dict[str, Any]:
    """Returns the arguments of Simulation.lone_pixels() for a camera."""
    assert keys.width_px and keys.height_px and keys.horizontal_fov_deg
    xyz_m, rotation = motion.begin(pose.xyz_m, pose.rotation)
    return {
        "xyz_m": xyz_m,
        "quat_xyzw": rotation.as_quat(),
        "width_px": keys.width_px,
        "height_px": keys.height_px,
        "near_m": keys.near_m,
        "horizontal_fov_rad": math.radians(keys.horizontal_fov_deg),
        "v_m_s": motion.v_m_s,
        "w_rad_s": motion.w_rad_s,
        "exposure_time_s": motion.exposure_time_s,
        "readout_time_s": motion.readout_time_s,
    }


def take(
    scene: Scene,
    shot: Shot,
    keys: CameraKeys,
    pose: CameraPose,
    scenery: Scenery,
    lidars: Dict[str, Lidar],
    folder: Path,
) -> None:
    """Takes a picture and writes its layers into folder/<split>; samples/<id>.json is last: with it, all is there."""
    motion = Motion(pose.v_m_s, pose.w_rad_s, keys.exposure_time_s, keys.readout_time_s)
    camera = _camera(keys, pose, motion)
    stamp_ns = scenery.simulation.time_ns  # before the lidars step on
    taken = scenery.simulation.picture(
        **camera, exposure=keys.exposure, white_balance=keys.white_balance
    )
    name = view_name(shot.robot, shot.camera)
    lens = scenery.lens(name, keys)
    own, seen = numbered(taken["instances"], scenery.items)
    items = [scenery.items[instance] for instance in seen]
    lone_px = scenery.simulation.lone_pixels(seen, **camera)
    depth = taken["depth_m"]
    layers = {
        "rgb": lens.applied(taken["rgb"]),
        "labels": taken["labels"],
        "instances": own,
        "organs": organs(own, taken["visuals"], items),
        "depth": np.where(np.isfinite(depth), depth, np.float32(0.0)),
    }
    split = folder / scene.keys.split
    for layer, ending in LAYERS.items():
        write_file(split / layer / f"{shot.id}.{ending}", _picture_bytes(layers[layer], ending))
    view = View(intrinsics(keys), pose.matrix(), (own.shape[1], own.shape[0]), motion)
    sample = {
        "id": shot.id,
        "scene": scene.name,
        "split": scene.keys.split,
        "camera": name,
        "stamp_ns": stamp_ns,
        "field_seed": scene.seed,
        "light": asdict(scenery.light) if scenery.light else None,
        "shot_seed": shot.seed,
        "lens": lens.description(),
        "clouds": _write_clouds(split, shot, pose, scenery, lidars),
        "instances": {str(n): item.truth_id for n, item in enumerate(items, 1)},
        "annotations": annotations(own, items, lone_px, depth, view),
        **view.description(scenery.rows),
    }
    write_file(split / "samples" / f"{shot.id}.json", json_bytes(sample))
