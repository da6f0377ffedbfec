# SPDX-License-Identifier: MIT
"""Dispatches `python3 -m ardee_datasets COMMAND ...`, which is `rosrun ardee_datasets COMMAND ...` without ROS."""

import importlib
import sys

from ardee_common.cli import Parser
from ardee_common.errors import known_names
from ardee_common.process import end_in_a_line

# Command to the module whose main(arguments) runs it and returns the exit code
MODULES = {name: f"ardee_datasets.{name}" for name in ("generate_dataset", "show_dataset")}


def main() -> int:
    """Runs the command that the first argument names, with the others; returns its exit code."""
    parser = Parser(
        prog="ardee_datasets", description="COMMAND -h tells the arguments of each command."
    )
    parser.add_argument("command", metavar="COMMAND", help=", ".join(MODULES))
    name = parser.parse_args(sys.argv[1:2]).command
    if name not in MODULES:
        parser.error(f"unknown command {name!r}, {known_names(name, MODULES)}")
    end_in_a_line(name)
    return importlib.import_module(MODULES[name]).main(sys.argv[2:])


if __name__ == "__main__":
    sys.exit(main())
