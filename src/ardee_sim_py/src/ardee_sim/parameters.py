# SPDX-License-Identifier: MIT
"""Parameters of controllers, as they are on ROS's parameter server."""

from pathlib import Path
from typing import Any, Dict, Mapping, Union

from ardee_sim import checks
from ardee_sim.errors import ArdeeError

from ardee_common.config import read_yaml_lines
from ardee_common.errors import GeneratorError

Parameters = Union[Mapping[str, Any], str, Path]


def below(namespace: str, given: Parameters) -> Dict[str, Any]:
    """Returns parameters, or those of a YAML file, in groups of the namespace's names."""
    try:
        tree = dict(
            given
            if isinstance(given, Mapping)
            else read_yaml_lines(Path(checks.path(given, "parameters")))
        )
    except GeneratorError as error:
        raise ArdeeError(str(error)) from None
    for name in reversed(checks.text(namespace, "namespace").split("/")):
        tree = {name: tree} if name else tree
    return tree
