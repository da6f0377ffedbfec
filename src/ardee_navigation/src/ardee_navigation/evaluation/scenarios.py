# SPDX-License-Identifier: MIT
"""Scenarios by name, of the package ardee_world."""
from typing import Dict

from ardee_sim.packages import find_package

from ardee_navigation.evaluation.scenario_files import Scenario, read_scenarios


def known_scenarios() -> Dict[str, Scenario]:
    """Returns the scenarios of ardee_world by name."""
    return read_scenarios(find_package("ardee_world") / "config" / "scenarios.yaml")
