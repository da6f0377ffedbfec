# SPDX-License-Identifier: MIT
"""Command lines of controllers that are programs: parameters put into their words, their end with a worker; sources."""
import ctypes
import shutil
import signal
from pathlib import Path
from typing import Any, List, Mapping, Optional, Sequence

from ardee_common.digests import python_files, shown
from ardee_common.errors import GeneratorError

_PR_SET_PDEATHSIG = 1
_SYSTEM = (
    "/bin/",
    "/usr/bin/",
    "/usr/share/",
    "/opt/ros/",
)  # the machine's, no part of a controller
_SOURCES = ("**/*.py", "**/*.launch", "**/*.yaml")  # of a ROS package


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
    """Returns the files that a command names, and those that they may load.

    Named are files by path, a program on PATH, and what rosrun or roslaunch starts. Loaded may be the Python and launch
    files and parameters of the ROS package in which a named file lies; of one in none, what it imports from its folder.
    """
    names = [shutil.which(command[0])] + [word for word in command[1:] if Path(word).is_file()]
    if Path(command[0]).name in ("rosrun", "roslaunch"):
        words = [word for word in command[1:] if not word.startswith("-")]
        names.append(_resource(*words[:2]) if len(words) > 1 else None)
    named = [Path(name) for name in names if name and not name.startswith(_SYSTEM)]
    return named + [other for file in named for other in _loaded_by(file) if other not in named]


def _loaded_by(file: Path) -> List[Path]:
    for folder in file.resolve().parents:
        if (folder / "package.xml").is_file():
            return shown(folder, (each for pattern in _SOURCES for each in folder.glob(pattern)))
    with file.open("rb") as lines:
        is_python = file.suffix == ".py" or b"python" in lines.readline(100)
    return python_files(file) if is_python else []


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
