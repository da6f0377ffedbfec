# SPDX-License-Identifier: MIT
"""Private ROS parameters of the node row_follower, checked: an unknown one is an error, as it is in the YAML files."""
import dataclasses
from dataclasses import dataclass
from typing import Any

from rosgraph.names import is_legal_name

from ardee_common.errors import GeneratorError

_EXPECTED = {str: "a text", bool: "true or false"}
_TOPICS = ("scan", "odom", "cmd")


@dataclass(frozen=True)
class Settings:
    """Topics; the file or scenario that the technique's parameters are in; whether to drive or only to show."""

    scan: str = "ardee/hokuyo"
    odom: str = "odom"
    cmd: str = "cmd_vel"
    scenario: str = ""
    parameters: str = ""
    drive: bool = True


def read_settings(values: Any) -> Settings:
    """Of what stands in the node's private namespace."""
    if not isinstance(values, dict):
        raise GeneratorError(f"~: found {values!r}, expected parameters by name")
    fields = {field.name: field for field in dataclasses.fields(Settings)}
    for key, value in values.items():
        if key not in fields:
            raise GeneratorError(f"~{key}: unknown parameter, known: {', '.join(fields)}")
        if not isinstance(value, fields[key].type):
            raise GeneratorError(f"~{key}: found {value!r}, expected {_EXPECTED[fields[key].type]}")
        if key in _TOPICS and not (value and is_legal_name(value)):
            raise GeneratorError(f"~{key}: found {value!r}, expected the name of a topic")
    return Settings(**values)
