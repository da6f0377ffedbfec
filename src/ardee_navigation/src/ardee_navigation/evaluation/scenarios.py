# SPDX-License-Identifier: MIT
"""Scenarios by name, and the parts of a run in one."""
from pathlib import Path
from typing import Dict

from ardee_sim.packages import find_package

from ardee_common.errors import GeneratorError, known_names
from ardee_navigation.evaluation.scenario_files import Scenario, read_scenarios
from ardee_world import trial
from ardee_world.trial import Trial


def known_scenarios() -> Dict[str, Scenario]:
    """Returns the scenarios of ardee_world by name."""
    return read_scenarios(find_package("ardee_world") / "config" / "scenarios.yaml")


def find_scenario(world: str) -> Scenario:
    """Returns the scenario of that name or world; for another world of ardee_world, or a file, one made from it.

    The field of a world of ardee_world is sown anew for each run if its plan is there, that of a file never.
    """
    scenarios, share = known_scenarios(), find_package("ardee_world")
    if world in scenarios:
        return scenarios[world]
    file = f"{Path(world).stem}.world"
    if world not in (file, file[: -len(".world")]) or not (share / "worlds" / file).is_file():
        if Path(world).is_file():
            return Scenario(world=str(Path(world).resolve()))
        known = [*scenarios, *(path.stem for path in (share / "worlds").glob("*.world"))]
        raise GeneratorError(
            f"WORLD: found {world!r}, no such file, and {known_names(world, known)}"
        )
    for scenario in scenarios.values():
        if scenario.world == file:
            return scenario
    plans = (
        share / "fields" / f"{name}.yaml" for name in trial.included_names(share / "worlds" / file)
    )
    return Scenario(world=file, plan=next((plan.name for plan in plans if plan.is_file()), None))


def prepare(scenario: Scenario, seed: int, folder: Path) -> Trial:
    """Generates the field of a run in a folder of models and finds its truth, start and ground."""
    share = find_package("ardee_world")
    plan = share / "fields" / scenario.plan if scenario.plan else None
    return trial.prepare(share / "worlds" / scenario.world, plan, seed, folder)
