# SPDX-License-Identifier: MIT
"""Expands a xacro file by PyPI's xacro, whose $(find) needs ROS 2: `python3 -m ardee_sim._expand_xacro FILE A:=B`."""

import contextlib
import io
import os
import sys
from pathlib import Path
from typing import Dict, List, Set

from ardee_sim.packages import find_package


def _import_xacro():  # type: ignore[no-untyped-def]
    """Returns PyPI's xacro: one on the Python path, else that of the workspace."""
    workspace = Path(__file__).resolve().parents[4]
    kept = [os.environ.get("ARDEE_PYDEPS", ""), workspace / "pydeps"]
    sys.path.extend(str(place) for place in kept if place and Path(place).is_dir())
    try:
        import xacro.substitution_args
    except ImportError as error:
        sys.exit(f"xacro: {error}, expected: pip install xacro")
    return xacro


class _Arguments(Dict[str, str]):
    """Values of arguments; remembers the names that the file asked for."""

    def __init__(self, words: List[str]) -> None:
        super().__init__(word.split(":=", 1) for word in words)
        self.asked: Set[str] = set()

    def __contains__(self, name: object) -> bool:
        self.asked.add(str(name))
        return super().__contains__(name)

    def __getitem__(self, name: str) -> str:
        self.asked.add(name)
        return super().__getitem__(name)


def main() -> None:
    """Prints the expanded file; exits with xacro's message if that fails."""
    xacro = _import_xacro()
    xacro.substitution_args._eval_find = lambda name: str(find_package(name))
    path, *words = sys.argv[1:]
    arguments = _Arguments(words)
    said = io.StringIO()
    try:
        with contextlib.redirect_stderr(said):
            document = xacro.process_file(path, mappings=arguments)
    except Exception as error:  # of any kind that an expression in the file raises
        sys.exit(f"{path}: {error}")
    unknown = sorted(set(arguments) - arguments.asked)
    if unknown:
        known = ", ".join(sorted(arguments.asked - set(unknown)))
        sys.exit(f"{path}: found no argument '{unknown[0]}', expected one of: {known}")
    sys.stdout.write(document.toprettyxml(indent="  "))


if __name__ == "__main__":
    main()
