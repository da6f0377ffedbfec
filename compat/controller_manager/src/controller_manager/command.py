# SPDX-License-Identifier: MIT
"""`controller_manager`: one request to the controller manager."""
import argparse
from typing import List

import rospy

from controller_manager import controller_manager_interface as manager

SHORT = {"lc": "list", "lt": "list-types", "sp": "spawn", "kl": "kill"}


def act(command: str, names: List[str], restore: bool) -> bool:
    """Makes the request; returns whether it was done."""
    if command == "list":
        manager.list_controllers()
        return True
    if command == "list-types":
        manager.list_controller_types()
        return True
    if command == "reload-libraries":
        return manager.reload_libraries(True, restore)
    if command == "start":
        return manager.start_controllers(names)
    if command == "stop":
        return manager.stop_controllers(names)
    if command == "load":
        return all([manager.load_controller(name) for name in names])
    if command == "unload":
        return all([manager.unload_controller(name) for name in names])
    if command == "spawn":
        loaded = [name for name in names if manager.load_controller(name)]
        return bool(loaded) and manager.start_controllers(loaded) and loaded == names
    stopped = [name for name in names if manager.stop_controller(name)]
    return all([manager.unload_controller(name) for name in stopped]) and stopped == names


def main() -> int:
    parser = argparse.ArgumentParser(prog="controller_manager", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for name, text in (
        ("load", "load controllers"),
        ("unload", "unload controllers that do not run"),
        ("start", "start controllers"),
        ("stop", "stop controllers"),
        ("spawn", "load controllers and start them (sp)"),
        ("kill", "stop controllers and unload them (kl)"),
    ):
        aliases = [short for short, long in SHORT.items() if long == name]
        command = commands.add_parser(name, aliases=aliases, help=text)
        command.add_argument("names", nargs="+", metavar="NAME")
    commands.add_parser("list", aliases=["lc"], help="list the controllers and their states (lc)")
    commands.add_parser("list-types", aliases=["lt"], help="list the types of controllers (lt)")
    reload = commands.add_parser("reload-libraries", help="unload all controllers")
    reload.add_argument(
        "--restore",
        action="store_true",
        help="after reload-libraries, load and start the controllers again",
    )
    arguments = parser.parse_args(rospy.myargv()[1:])
    command = SHORT.get(arguments.command, arguments.command)
    try:
        is_done = act(
            command, getattr(arguments, "names", []), getattr(arguments, "restore", False)
        )
    except (rospy.ServiceException, rospy.ROSException) as error:
        parser.exit(1, f"controller_manager: {error}\n")
    return 0 if is_done else 1
