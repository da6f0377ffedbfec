# SPDX-License-Identifier: MIT
"""Dispatches `python3 -m ardee_datasets COMMAND ...`, which is `rosrun ardee_datasets COMMAND ...` without ROS."""
import sys

from ardee_common.cli import dispatch

MODULES = {name: f"ardee_datasets.{name}" for name in ("generate_dataset", "show_dataset")}
DESCRIPTION = "COMMAND -h tells the arguments of each command."

if __name__ == "__main__":
    sys.exit(dispatch("ardee_datasets", MODULES, DESCRIPTION))
