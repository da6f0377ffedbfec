# SPDX-License-Identifier: MIT
"""Dispatches `python3 -m ardee_campaigns COMMAND ...`, which is `rosrun ardee_campaigns COMMAND ...` without ROS."""
import importlib
import sys
from typing import List, Optional

from ardee_common.errors import known_names
from ardee_common.process import end_in_a_line

# Command to the module whose main(arguments) runs it and returns the exit code
MODULES = {
    "run_campaign": "ardee_campaigns.run_campaign",
    "report": "ardee_campaigns.report.command",
    "compare": "ardee_campaigns.report.compare",
    "overlay": "ardee_campaigns.overlay.command",
    "run_experiment": "ardee_campaigns.experiment.run_experiment",
    "compare_experiments": "ardee_campaigns.experiment.compare_experiments",
    "judge_lane": "ardee_campaigns.lane.judge_lane",
}


def main(arguments: Optional[List[str]] = None) -> int:
    """Runs a command; returns its exit code."""
    words = sys.argv[1:] if arguments is None else arguments
    known = list(MODULES)
    if words and words[0] in MODULES:
        end_in_a_line(words[0])
        return importlib.import_module(MODULES[words[0]]).main(words[1:])
    if words and words[0] in ("-h", "--help"):
        print(f"usage: python3 -m ardee_campaigns COMMAND ...\n\ncommands: {', '.join(known)}")
        return 0
    found = repr(words[0]) if words else "no command"
    print(
        f"ardee_campaigns: found {found}, {known_names(words[0] if words else '', known)}",
        file=sys.stderr,
    )
    return 2


if __name__ == "__main__":
    sys.exit(main())
