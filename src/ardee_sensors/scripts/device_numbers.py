# SPDX-License-Identifier: MIT
"""The numbers of the devices: config/<device>.yaml, with the mark of each number's source."""
import pathlib
import re
from typing import Any, Dict, List, NamedTuple

from ardee_common.config import read_yaml_lines
from ardee_common.errors import GeneratorError, known_names


def _package_folder() -> pathlib.Path:
    """The folder config/: beside this one in the source tree, found by rospack once installed."""
    beside = pathlib.Path(__file__).resolve().parents[1]
    if (beside / "config").is_dir():
        return beside
    import rospkg

    return pathlib.Path(rospkg.RosPack().get_path("ardee_sensors"))


PACKAGE = _package_folder()
CONFIG = PACKAGE / "config"
TEXTS = ("device", "kind", "macro", "also", "topics")
SHARED = ("colors", "sources")
LINE = re.compile(r"^(?P<key>\w+):(?P<value>[^#]*?)\s*(?:#\s*(?P<comment>.*))?$")
MARKS = re.compile(r"\[([^\]]+)\]")


class Number(NamedTuple):
    """One number of a device: its text in the file, its comment, and the marks of its sources."""

    key: str
    value: str
    comment: str
    marks: List[str]


def devices() -> List[str]:
    """Names of all devices: the stems of their files, and of their macros without `sensor_`."""
    return sorted(path.stem for path in CONFIG.glob("*.yaml") if path.stem not in SHARED)


def device_file(device: str, folder: pathlib.Path = CONFIG) -> pathlib.Path:
    """Path of the device's file; for an unknown device, a GeneratorError names the known ones."""
    if device not in devices():
        raise GeneratorError(f"unknown sensor {device!r}, {known_names(device, devices())}")
    return folder / f"{device}.yaml"


def load(device: str) -> Dict[str, Any]:
    """Reads the device's file as a dictionary."""
    return read_yaml_lines(device_file(device))


def read_numbers(path: pathlib.Path) -> List[Number]:
    """Reads the file's numbers in their order; every line is a number except the texts."""
    found = []
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if not line or line.startswith(("#", " ")):
            continue
        match = LINE.match(line)
        if not match:
            raise GeneratorError(
                f"{path}:{number}: found {line!r}, expected `key: value  # comment [mark]`"
            )
        if match["key"] in TEXTS:
            continue
        comment = match["comment"] or ""
        marks = [mark.strip() for group in MARKS.findall(comment) for mark in group.split(",")]
        found.append(Number(match["key"], match["value"].strip(), comment, marks))
    return found


def sources() -> Dict[str, str]:
    """Meanings of the marks; of a mark of several words (`thesis A.12`) the first is looked up."""
    return read_yaml_lines(CONFIG / "sources.yaml")


def expected_topics(device: str, name: str) -> Dict[str, List[str]]:
    """Topics of the device called `name`, relative to the robot's namespace: [message type, frame]."""
    return {
        topic.format(name=name): [kind, frame.format(name=name)]
        for topic, (kind, frame) in load(device)["topics"].items()
    }
