# SPDX-License-Identifier: MIT
"""Controllers: what `make(params, robot, seed)` returns, and what it answers to observations.

A controller has `reset()` and `step(observation, time_s)`, which returns an ardee_sim.Twist, or speed [m/s] and turn
rate [rad/s]. It may have `close()`, called at its run's end, `seen`, the distances (left_m, right_m) from its sensor to
the rows that it perceives, `is_finished`, whether it has come to its end, and `about`, a mapping that is kept with the
run.
"""
import hashlib
import importlib
import importlib.util
import json
import math
from pathlib import Path
from typing import Any, Callable, Collection, Dict, Iterable, Mapping, Tuple

import ardee_sim

from ardee_campaigns.campaign_file import ControllerKeys
from ardee_campaigns.program import files_of
from ardee_campaigns.robot import Robot
from ardee_campaigns.udp import UdpController
from ardee_common.digests import python_files
from ardee_common.errors import GeneratorError

Command = Tuple[float, float]


def load_function(name: str, what: str) -> Callable[..., Any]:
    """Returns the function of a module:function. Raises GeneratorError if there is none."""
    module, _, function = name.partition(":")
    try:
        found = getattr(importlib.import_module(module), function)
    except Exception as error:  # of any kind that its import raises
        why = f"{type(error).__name__}: {error}"
        raise GeneratorError(
            f"{what}: found {name!r}, expected module:function on the Python path: {why}"
        ) from None
    if not callable(found):
        raise GeneratorError(f"{what}: found {name!r}, which is no function")
    return found


def source_digest(keys: ControllerKeys) -> str:
    """Returns a hash of a controller's source, so that one whose algorithm has changed is run anew.

    It is that of the names and contents of the files that python_files or, of kind ros and udp, files_of returns.
    """
    return _digest(files_of(keys.command)) if keys.command else function_digest(keys.factory)


def function_digest(name: str) -> str:
    """Returns a hash of the source of a module:function."""
    spec = importlib.util.find_spec(name.partition(":")[0])
    if spec is None or not spec.origin or not Path(spec.origin).is_file():
        return ""
    return _digest(python_files(Path(spec.origin)))


def _digest(files: Iterable[Path]) -> str:
    texts = [f"{file.name}\0".encode() + file.read_bytes() for file in files]
    return hashlib.sha256(b"\0".join(texts)).hexdigest()


def make(keys: ControllerKeys, params: Mapping[str, Any], robot: Robot, seed: int) -> Any:
    """Returns the controller, which gets 32 bits of the seed: many generators of random numbers take no more."""
    seed &= 0xFFFFFFFF
    if keys.kind == "udp":
        return UdpController(keys.command, params, robot)
    if keys.kind == "ros":
        return _ros_controller(keys, params, robot)
    made = load_function(keys.factory, "factory")(dict(params), robot, seed)
    for method in ("reset", "step"):
        if not callable(getattr(made, method, None)):
            found = f"a {type(made).__name__} without {method}()"
            raise GeneratorError(f"factory {keys.factory}: found {found}, expected reset and step")
    return made


def _ros_controller(keys: ControllerKeys, params: Mapping[str, Any], robot: Robot) -> Any:
    try:
        from ardee_campaigns.ros.controller import RosController
    except ImportError as error:
        expected = "ROS and its set-up file sourced"
        raise GeneratorError(f"kind ros: found {error}, expected {expected}") from None
    return RosController(keys.command, params, robot, keys.realtime)


def checked(answer: Any) -> Command:
    """Returns speed [m/s] and turn rate [rad/s] of a controller's answer."""
    if isinstance(answer, ardee_sim.Twist):
        answer = (answer.linear_x_m_s, answer.angular_z_rad_s)
    try:
        speed, turn = (float(value) for value in answer)
    except (TypeError, ValueError):
        found = type(answer).__name__
        raise GeneratorError(
            f"controller's command: found {found}, expected a Twist, or speed and turn rate"
        ) from None
    if not (math.isfinite(speed) and math.isfinite(turn)):
        raise GeneratorError(f"controller's command: found {speed} and {turn}, expected finite")
    return speed, turn


def seen(controller: Any) -> Tuple[float, float]:
    """Returns the distances [m] to the left and right row that a controller perceives; NaN if it does not say."""
    found = getattr(controller, "seen", None)
    if found is None or len(found) == 0:
        return math.nan, math.nan
    left, right = found
    return float(left), float(right)


def about(controller: Any, taken: Collection[str]) -> Dict[str, Any]:
    """Returns what a controller tells about its run, which its file is to hold; `taken` are the run's own names."""
    told = dict(getattr(controller, "about", {}))
    for name in told:
        if name in taken:
            raise GeneratorError(f"controller's about: found {name!r}, which a run has of its own")
    try:
        json.dumps(told)
    except (TypeError, ValueError) as error:
        raise GeneratorError(f"controller's about: {error}, expected what JSON holds") from None
    return told


def is_finished(controller: Any) -> bool:
    """Returns whether a controller says that it has come to its end."""
    found = getattr(controller, "is_finished", False)
    if callable(found):
        raise GeneratorError("controller's is_finished: found a method, expected true or false")
    return bool(found)
