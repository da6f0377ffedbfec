# SPDX-License-Identifier: MIT
"""Dispatches `python3 -m ardee_campaigns COMMAND ...`, which is `rosrun ardee_campaigns COMMAND ...` without ROS."""
import sys
from typing import List, Optional

from ardee_common.cli import dispatch

MODULES = {
    "run_campaign": "ardee_campaigns.run_campaign",
    "report": "ardee_campaigns.report.command",
    "compare": "ardee_campaigns.report.compare",
    "overlay": "ardee_campaigns.overlay.command",
    "run_experiment": "ardee_campaigns.experiment.run_experiment",
    "compare_experiments": "ardee_campaigns.experiment.compare_experiments",
    "judge_lane": "ardee_campaigns.lane.judge_lane",
}
DESCRIPTION = "COMMAND -h tells the arguments of each command."


def main(arguments: Optional[List[str]] = None) -> int:
    """Runs a command; returns its exit code."""
    return dispatch("ardee_campaigns", MODULES, DESCRIPTION, arguments)


if __name__ == "__main__":
    sys.exit(main())
