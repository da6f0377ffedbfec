# SPDX-License-Identifier: MIT
"""Runs a generator where there is no ROS, and so no `rosrun`: `python3 -m ardee_world.cli COMMAND ...`."""

import importlib
import signal
import sys

from ardee_common.cli import Parser
from ardee_common.errors import known_names

COMMANDS = {
    "assemble_world": "ardee_world.assemble_world",
    "crop_contact_sheet": "ardee_models.report.contact_sheet",
    "crop_report": "ardee_models.report.crop_report",
    "generate_crop": "ardee_models.plant.generate_crop",
    "generate_field": "ardee_world.generate_field",
    "generate_terrain": "ardee_models.terrain.generate_terrain",
    "prepare_crop": "ardee_models.prepare.prepare_crop",
}


def main() -> int:
    """Runs the command that the first argument names, with the others; returns its exit code."""
    parser = Parser(
        prog="ardee_world.cli",
        description="Runs a generator without ROS. COMMAND -h tells the arguments of each.",
    )
    parser.add_argument("command", metavar="COMMAND", help=", ".join(COMMANDS))
    name = parser.parse_args(sys.argv[1:2]).command
    if name not in COMMANDS:
        parser.error(f"unknown command {name!r}, {known_names(name, COMMANDS)}")
    sys.argv = [name, *sys.argv[2:]]
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C during the imports ends it silently
    return importlib.import_module(COMMANDS[name]).main()


if __name__ == "__main__":
    sys.exit(main())
