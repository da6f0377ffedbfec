# SPDX-License-Identifier: MIT
"""Files of scenarios and parameters, read without ROS: a target computer reads them too."""
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Dict, Optional, TypeVar

from ardee_common.config import build, build_group, read_yaml_lines
from ardee_common.options import option
from ardee_navigation.lane_following import LaneParameters
from ardee_navigation.lbirnt import Parameters

P = TypeVar("P", bound=LaneParameters)


@dataclass(frozen=True)
class Scenario:
    """An entry of scenarios.yaml."""

    world: str = option("")
    plan: Optional[str] = option(None)
    parameters: Parameters = option(Parameters())
    vision: Optional[dict] = option(
        None, "keys of VisionParameters; the lane's width is that above"
    )


def read_scenarios(path: Path) -> Dict[str, Scenario]:
    """Returns the scenarios of a file by name."""
    mapping = read_yaml_lines(path)
    return {name: build_group(Scenario, mapping, name) for name in mapping}


def read_parameters(path: Path, usual: P) -> P:
    """Reads a YAML file with any names of a row follower's parameters as keys; the others are the usual ones."""
    mapping = read_yaml_lines(path)
    for name, value in asdict(usual).items():
        mapping.setdefault(name, value)
    return build(type(usual), mapping)
