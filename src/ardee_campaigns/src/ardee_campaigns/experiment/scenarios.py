# SPDX-License-Identifier: MIT
"""Scenarios by name or world, and campaigns of the row follower in one of them, which a command writes and drives."""
import argparse
from dataclasses import asdict
from pathlib import Path
from typing import Any, Dict, Optional

import yaml
from ardee_sim.packages import find_package

from ardee_campaigns.campaign_file import LARGEST_SEED, Campaign, read_campaign
from ardee_common.cli import Parser, whole_in
from ardee_common.errors import GeneratorError, known_names
from ardee_common.output import write_file
from ardee_navigation.evaluation.scenario_files import Scenario, read_parameters
from ardee_navigation.evaluation.scenarios import known_scenarios
from ardee_navigation.lbirnt import Parameters
from ardee_world import trial

FILE = "campaign.yaml"
CONTROLLER = {"factory": "ardee_navigation.control:make"}
SLOWEST_M_S = 0.1  # mean speed below which a run is given up
LONGEST_S = {"limit_sim_s": 1e6, "watchdog_wall_s": 1e5}  # no other limit: rows may be long
# The outline by which contacts are counted: chassis; outer faces of the wheels: separation 0.4318 and depth 0.03838
# (tsv1_config)
OUTLINE = {"length_m": 0.508, "width_m": 0.4702}


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


def add_arguments(parser: Parser) -> None:
    """Adds the arguments that runs of the row follower in a scenario have."""
    parser.add_argument("--runs", type=whole_in(1, 10_000), default=10, help="number of runs")
    parser.add_argument(
        "--seed", type=whole_in(0, LARGEST_SEED), default=1, help="seed of the first run"
    )
    parser.add_argument(
        "--parameters",
        type=Path,
        help="YAML file of the row follower's parameters that differ from the scenario's",
    )
    parser.add_argument("--bot-model", default="tsv1_default.urdf.xacro", help="robot model file")


def parse(parser: Parser, argv: Any) -> argparse.Namespace:
    """Parses the arguments, and checks those of `add_arguments` together."""
    args = parser.parse_args(argv)
    if args.seed + args.runs - 1 > LARGEST_SEED:
        parser.error(f"--seed and --runs: found a last seed above {LARGEST_SEED}, the largest")
    return args


def parameters_of(args: argparse.Namespace, scenario: Scenario) -> Parameters:
    """Returns the parameters of the file over those of the scenario."""
    usual = scenario.parameters
    return read_parameters(args.parameters, usual) if args.parameters else usual


def _robot(model: str) -> Dict[str, Any]:
    folder = find_package("terrasentia_description") / "robots"
    if not (folder / model).is_file():
        known = known_names(model, [path.name for path in folder.glob("*.xacro")])
        raise GeneratorError(f"--bot-model: found {model!r}, no such file, and {known}")
    return {"model": str(folder / model), **OUTLINE}


def write_campaign(
    folder: Path,
    name: str,
    scenario: Scenario,
    args: argparse.Namespace,
    controller: Optional[Dict[str, Any]] = None,
    **keys: Any,
) -> Campaign:
    """Writes the file of a campaign over the seeds of the arguments; returns the campaign.

    controller : one that is not the row follower in Python; keys : further keys of the file
    """
    world = {"world": scenario.world, **({"field": scenario.plan} if scenario.plan else {})}
    lidar = {**CONTROLLER, "params": asdict(parameters_of(args, scenario))}
    content = {
        "name": name,
        "first_seed": args.seed,
        "replicates": args.runs,
        **LONGEST_S,
        "task": {"slowest_m_s": SLOWEST_M_S},
        "worlds": {name: world},
        "robots": {"robot": _robot(args.bot_model)},
        "controllers": {"lidar": controller or lidar},
        **keys,
    }
    write_file(folder / FILE, yaml.safe_dump(content, sort_keys=False).encode())
    return read_campaign(folder / FILE)
