# SPDX-License-Identifier: MIT
"""`controller_group`: groups of controllers that run together, {GROUP: [NAME, ...]} in controller_groups."""
import argparse
from typing import Dict, List, Set

import rospy

from controller_manager_msgs.srv import (
    ListControllers,
    LoadController,
    SwitchController,
    SwitchControllerRequest,
)


def states() -> Dict[str, str]:
    rospy.wait_for_service("controller_manager/list_controllers")
    listed = rospy.ServiceProxy("controller_manager/list_controllers", ListControllers)()
    return {each.name: each.state for each in listed.controller}


def list_groups(groups: Dict[str, List[str]]) -> None:
    state = states()
    for group in sorted(groups):
        running = [name for name in groups[group] if state.get(name) == "running"]
        print(f"{group}: {len(running)} of {len(groups[group])} running")
        for name in groups[group]:
            print(f"  {name} ( {state.get(name, 'not loaded')} )")


def load(names: List[str]) -> bool:
    """Loads those controllers that are not loaded yet."""
    load_controller = rospy.ServiceProxy("controller_manager/load_controller", LoadController)
    failed = [name for name in names if name not in states() and not load_controller(name).ok]
    if failed:
        print(f"Error when loading {failed}")
    return not failed


def start_only(names: List[str], others: Set[str]) -> bool:
    """Stops the running ones of `others`, and starts those of `names` that do not run, at once."""
    state = states()
    starting = [name for name in names if state.get(name) != "running"]
    stopping = sorted(name for name in others.difference(names) if state.get(name) == "running")
    switch = rospy.ServiceProxy("controller_manager/switch_controller", SwitchController)
    is_done = switch(starting, stopping, SwitchControllerRequest.STRICT, False, 0.0).ok
    print(
        f"Started {starting}, stopped {stopping}"
        if is_done
        else f"Error when starting {starting} and stopping {stopping}"
    )
    return bool(is_done)


def main() -> int:
    parser = argparse.ArgumentParser(prog="controller_group", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    commands.add_parser("list", help="list the groups and the states of their controllers")
    for name, text in (
        ("spawn", "load and start the controllers of a group"),
        ("switch", "start those of a group and stop those of all other groups"),
    ):
        commands.add_parser(name, help=text).add_argument("group", metavar="GROUP")
    arguments = parser.parse_args(rospy.myargv()[1:])
    groups = rospy.get_param("controller_groups", None)
    if not groups:
        parser.exit(
            1, f"controller_group: no parameter {rospy.resolve_name('controller_groups')}\n"
        )
    if arguments.command == "list":
        list_groups(groups)
        return 0
    if arguments.group not in groups:
        parser.exit(1, f"controller_group: no group '{arguments.group}', known: {sorted(groups)}\n")
    names = groups[arguments.group]
    if arguments.command == "spawn":
        return 0 if load(names) and start_only(names, set()) else 1
    return 0 if start_only(names, {name for group in groups.values() for name in group}) else 1
