# SPDX-License-Identifier: MIT
"""Command lines of controllers that are programs: parameters put into their words, and their end with a worker."""
import ctypes
import shutil
import signal
from pathlib import Path
from typing import Any, List, Mapping, Optional, Sequence

from ardee_common.errors import GeneratorError

_PR_SET_PDEATHSIG = 1
_SYSTEM = ("/bin/", "/usr/bin/", "/opt/ros/")  # programs of the machine, no part of a controller


def end_with_parent(number: int) -> None:
    """Makes the kernel send this child a signal when the worker that started it ends, however that ends.

    The child gets Ctrl-C, which its worker does not.
    """
    signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT])
    ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, number)


def filled(command: Sequence[str], values: Mapping[str, Any]) -> List[str]:
    """Returns the words of a command with `{NAME}` replaced by a value."""
    try:
        return [word.format(**values) for word in command]
    except (KeyError, IndexError, ValueError) as error:
        expected = ", ".join(f"{{{name}}}" for name in values) or "no parameter"
        raise GeneratorError(
            f"command: found {error!r} in {' '.join(command)!r}, expected {expected}"
        ) from None


def check(command: Sequence[str], params: Mapping[str, Any], places: Sequence[str] = ()) -> None:
    """Raises GeneratorError unless the program is there and its words have all parameters; `places` may be there."""
    taken = [name for name in params if name in places]
    if taken:
        expected = f"another name: {{{taken[0]}}} in command is an address"
        raise GeneratorError(f"params: found {taken[0]!r}, expected {expected}")
    unused = [name for name in params if not any(f"{{{name}}}" in word for word in command)]
    if unused:
        raise GeneratorError(f"params: found {unused[0]!r}, expected {{{unused[0]}}} in command")
    program = filled(command, {**dict.fromkeys(places, ""), **params})[0]
    if not shutil.which(program):
        raise GeneratorError(f"command: found no program {program!r}, expected one")


def files_of(command: Sequence[str]) -> List[Path]:
    """Returns the files that a command names: by path, as program on PATH, as what rosrun or roslaunch starts."""
    found = [shutil.which(command[0])] + [word for word in command[1:] if Path(word).is_file()]
    if Path(command[0]).name in ("rosrun", "roslaunch"):
        words = [word for word in command[1:] if not word.startswith("-")]
        found.append(_resource(*words[:2]) if len(words) > 1 else None)
    return [Path(name) for name in found if name and not name.startswith(_SYSTEM)]


def _resource(package: str, name: str) -> Optional[str]:
    """Returns a package's file: of a script its source, not what catkin puts into the devel space."""
    try:
        from roslib.packages import InvalidROSPkgException, find_resource
        from rospkg import ResourceNotFound
    except ImportError:
        return None
    try:
        return next(reversed(find_resource(package, name)), None)
    except (InvalidROSPkgException, ResourceNotFound):
        return None
