# SPDX-License-Identifier: MIT
"""Runs a generator where there is no ROS, and so no `rosrun`: `python3 -m ardee_world.cli COMMAND ...`."""
import sys

from ardee_common.cli import dispatch

MODULES = {
    "assemble_world": "ardee_world.assemble_world",
    "crop_contact_sheet": "ardee_models.report.contact_sheet",
    "crop_report": "ardee_models.report.crop_report",
    "generate_crop": "ardee_models.plant.generate_crop",
    "generate_field": "ardee_world.generate_field",
    "generate_terrain": "ardee_models.terrain.generate_terrain",
    "prepare_crop": "ardee_models.prepare.prepare_crop",
}
DESCRIPTION = "Runs a generator without ROS. COMMAND -h tells the arguments of each."

if __name__ == "__main__":
    sys.exit(dispatch("ardee_world.cli", MODULES, DESCRIPTION))
