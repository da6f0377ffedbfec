# SPDX-License-Identifier: MIT
"""Parameters of controllers, as they are on ROS's parameter server."""

from pathlib import Path
from typing import Any, Dict, Mapping, Union

import numpy as np
from ardee_sim import checks
from ardee_sim.errors import ArdeeError

from ardee_common.config import read_yaml_lines
from ardee_common.errors import GeneratorError

Parameters = Union[Mapping[str, Any], str, Path]


_MOST_LEVELS = 20  # a group that holds itself has no end


def _grouped(tree: Mapping[str, Any], level: int = 0) -> Dict[str, Any]:
    """Returns parameters in which a name such as a/b stands for b in the group a, as for `rosparam load`."""
    made: Dict[str, Any] = {}
    for name, value in tree.items():
        if isinstance(value, (np.generic, np.ndarray)):
            value = value.tolist()
        if isinstance(value, Mapping) and level < _MOST_LEVELS:
            value = _grouped(value, level + 1)
        first, *others = [part for part in str(name).split("/") if part] or [name]
        for other in reversed(others):
            value = {other: value}
        made[first] = _merged(made.get(first), value)
    return made


def _merged(base: Any, over: Any) -> Any:
    if not (isinstance(base, dict) and isinstance(over, dict)):
        return over
    return {**base, **{name: _merged(base.get(name), value) for name, value in over.items()}}


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
    tree = _grouped(tree)
    for name in reversed(checks.text(namespace, "namespace").split("/")):
        tree = {name: tree} if name else tree
    return tree
