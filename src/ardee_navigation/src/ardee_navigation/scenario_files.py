# SPDX-License-Identifier: MIT
"""Files of scenarios, start poses and parameters, read without ROS: a target computer reads them too."""
import dataclasses
from dataclasses import dataclass
from pathlib import Path
from typing import Dict, Optional

from ardee_common.config import build, build_group, read_yaml_lines
from ardee_navigation.lbirnt import Parameters

STAND_M = 0.175  # base_footprint above the ground (terrasentia_description)


def _text(default: Optional[str]) -> object:
    return dataclasses.field(default=default, metadata={})


@dataclass(frozen=True)
class Scenario:
    """An entry of scenarios.yaml."""

    world: str = _text("")
    plan: Optional[str] = _text(None)
    parameters: Parameters = dataclasses.field(
        default_factory=Parameters, metadata={"group": Parameters}
    )


@dataclass(frozen=True)
class Start:
    """Where a world's .start.yaml sets a robot down."""

    x_m: float = dataclasses.field(default=0.0, metadata={"limits": (-1e6, 1e6)})
    y_m: float = dataclasses.field(default=0.0, metadata={"limits": (-1e6, 1e6)})
    z_m: float = dataclasses.field(default=STAND_M, metadata={"limits": (-1e3, 1e4)})
    yaw_rad: float = dataclasses.field(default=0.0, metadata={"limits": (-7.0, 7.0)})


def read_scenarios(path: Path) -> Dict[str, Scenario]:
    """Name to scenario of a file."""
    mapping = read_yaml_lines(path)
    return {name: build_group(Scenario, mapping, name) for name in mapping}


def read_parameters(path: Path) -> Parameters:
    """Parameters of the row follower from a YAML file with any of their names as keys."""
    return build(Parameters, read_yaml_lines(path))
