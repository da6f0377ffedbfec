# SPDX-License-Identifier: MIT
"""Robots of a recipe: their cameras, as their descriptions say."""

import dataclasses
import hashlib
import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Collection, Dict, Iterator, List, Optional, Sequence, Tuple
from xml.etree import ElementTree

import ardee_sim
import numpy as np
from scipy.spatial.transform import Rotation

from ardee_common.config import read_yaml_lines
from ardee_common.errors import GeneratorError, known_names
from ardee_common.options import option
from ardee_datasets.camera import CameraKeys, white_balance
from ardee_datasets.ranges import Range

_FOV_RAD, _NEAR_M = 1.047, 0.1  # SDF's defaults
_SIZE_PX = (320, 240)


@dataclass(frozen=True)
class RobotKeys:
    """A robot that follows a lane; at places along its way each of its cameras takes a picture."""

    robot: str = option(
        dataclasses.MISSING, "shipped robot, such as tsv3_default, or a file (.urdf, .xacro)"
    )
    cameras: Optional[Tuple[str, ...]] = option(
        None, "names of the robot's camera sensors; none: all of them"
    )
    speed_m_s: Range = option((0.4, 0.4), "along the lane", (0.05, 5.0))
    offset_m: Range = option((0.0, 0.0), "to the left of the lane's middle", (-1.0, 1.0))
    command: str = option("cmd_vel", "topic of its drive, a geometry_msgs/Twist")
    parameters: Optional[str] = option(
        None, "`.yaml` file of its ros_control controllers, and joints' gains"
    )
    controllers: Tuple[str, ...] = option((), "of ros_control, started in this order")

    def __post_init__(self) -> None:
        for key in ("speed_m_s", "offset_m"):
            low, high = getattr(self, key)
            if low > high:
                raise GeneratorError(f"{key}: found [{low}, {high}], expected [least, most]")


@dataclass(frozen=True)
class MountedCamera:
    """A camera of a robot: its link, its pose there (x ahead, y left, z up), and its lens."""

    link: str
    xyz_m: np.ndarray
    rotation: Rotation
    keys: CameraKeys


@dataclass(frozen=True)
class Robot:
    """A robot of a recipe with its description and the cameras that take pictures, by name.

    parameters : of its ros_control controllers
    """

    keys: RobotKeys
    urdf: str
    parameters: Dict[str, Any]
    cameras: Dict[str, MountedCamera]

    def digest(self) -> str:
        """Returns the sha256 of description and parameters, without comments: xacro's tell where its file lies."""
        urdf = ElementTree.canonicalize(self.urdf)
        parameters = json.dumps(self.parameters, sort_keys=True)
        return hashlib.sha256(f"{urdf}\0{parameters}".encode()).hexdigest()


def check_cameras(names: Sequence[str], known: Collection[str]) -> None:
    """Raises GeneratorError for a camera's name that is not known, or given twice."""
    for number, name in enumerate(names):
        if name not in known:
            raise GeneratorError(f"cameras: found {name!r}, {known_names(name, known)}")
        if name in names[:number]:
            raise GeneratorError(f"cameras: found {name!r} twice, expected it once")


def read_robot(keys: RobotKeys, folder: Path) -> Robot:
    """Returns the robot of a recipe in `folder`. Raises GeneratorError."""
    file = folder / Path(keys.robot).expanduser()
    try:
        urdf = ardee_sim.robot(file if file.is_file() else keys.robot)
    except ardee_sim.ArdeeError as error:
        raise GeneratorError(f"robot: {' '.join(str(error).split())}") from None
    try:
        found = cameras_of(urdf)
    except (ElementTree.ParseError, ValueError) as error:
        raise GeneratorError(
            f"robot: found {keys.robot}: {error}, expected a readable one"
        ) from None
    if not found:
        raise GeneratorError(f"robot: found no camera on {keys.robot}, expected some")
    check_cameras(keys.cameras or (), found)
    wanted = keys.cameras or tuple(sorted(found))
    parameters = {}
    if keys.parameters is not None:
        parameters = read_yaml_lines(folder / Path(keys.parameters).expanduser())
        json.dumps(parameters, default=_refuse)
    return Robot(keys, urdf, parameters, {name: found[name] for name in wanted})


def _refuse(value: Any) -> Any:
    expected = "numbers, truths, texts, and lists and groups of them"
    raise GeneratorError(f"parameters: found {value}, expected {expected}")


def cameras_of(urdf: str) -> Dict[str, MountedCamera]:
    """Returns the cameras of a URDF text by the names of their sensors; several of one sensor have a suffix."""
    made = {}
    for link, sensor in _sensors(ElementTree.fromstring(urdf)):
        eyes = sensor.findall("camera")
        for eye in eyes:
            name = sensor.get("name", "") + (f"_{eye.get('name')}" if len(eyes) > 1 else "")
            made[name] = _mounted(name, link, sensor, eye)
    return made


def _sensors(robot: ElementTree.Element) -> Iterator[Tuple[str, ElementTree.Element]]:
    for gazebo in robot.findall("gazebo"):
        for sensor in gazebo.findall("sensor"):
            yield gazebo.get("reference", ""), sensor


def _numbers(element: ElementTree.Element, path: str, default: List[float]) -> List[float]:
    text = element.findtext(path)
    return [float(word) for word in text.split()] if text and text.strip() else default


def _mounted(
    name: str, link: str, sensor: ElementTree.Element, eye: ElementTree.Element
) -> MountedCamera:
    if any(
        value
        for key in ("k1", "k2", "k3", "p1", "p2")
        for value in _numbers(eye, f"distortion/{key}", [0.0])
    ):
        raise GeneratorError(f"camera {name}: found <distortion>, expected a straight lens")
    if eye.find("lens/intrinsics") is not None:
        raise GeneratorError(f"camera {name}: found <intrinsics>, expected a pinhole in the middle")
    place, turn = np.zeros(3), Rotation.identity()
    for element in (sensor, eye):
        pose = _numbers(element, "pose", [0.0] * 6)
        place = place + turn.apply(pose[:3])
        turn = turn * Rotation.from_euler("xyz", pose[3:])
    width, height = (
        int(_numbers(eye, f"image/{side}", [size])[0])
        for side, size in zip(("width", "height"), _SIZE_PX)
    )
    keys = CameraKeys(
        width_px=width,
        height_px=height,
        horizontal_fov_deg=math.degrees(_numbers(eye, "horizontal_fov", [_FOV_RAD])[0]),
        near_m=_numbers(eye, "clip/near", [_NEAR_M])[0],
        **_development(sensor),
    )
    return MountedCamera(link, place, turn, keys)


def _development(sensor: ElementTree.Element) -> Dict[str, Any]:
    """Returns what the plugin's keys say of exposure, shutter and white balance."""
    exposure = (sensor.findtext("plugin/exposure") or "auto").strip()
    words = (sensor.findtext("plugin/whiteBalance") or "").split() or ["off"]
    numbers = words if words[0] in ("off", "auto") else [float(word) for word in words]
    return {
        "exposure": None if exposure == "auto" else float(exposure),
        "exposure_time_s": _numbers(sensor, "plugin/exposureTime", [0.0])[0],
        "readout_time_s": _numbers(sensor, "plugin/readoutTime", [0.0])[0],
        "white_balance": white_balance(numbers[0] if len(numbers) == 1 else numbers),
    }
