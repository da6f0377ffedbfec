# SPDX-License-Identifier: MIT
"""Functions for requests to the controller manager of this namespace: each prints its result on standard output, and
returns whether it was done.
"""
from typing import Any, List

import rospy

from controller_manager_msgs import srv


def _call(service: str, kind: Any, *arguments: Any) -> Any:
    name = f"controller_manager/{service}"
    rospy.wait_for_service(name)
    return rospy.ServiceProxy(name, kind)(*arguments)


def _say(is_done: bool, success: str, failure: str) -> bool:
    print(success if is_done else failure)
    return is_done


def list_controller_types() -> None:
    for name in _call("list_controller_types", srv.ListControllerTypes).types:
        print(name)


def list_controllers() -> None:
    controllers = _call("list_controllers", srv.ListControllers).controller
    if not controllers:
        print("No controllers are loaded in mechanism control")
    for each in controllers:
        interfaces = sorted({claim.hardware_interface for claim in each.claimed_resources})
        print(f"'{each.name}' - '{'+'.join(interfaces)}' ( {each.state} )")


def reload_libraries(force_kill: bool, restore: bool = False) -> bool:
    """Reloads the libraries; with `restore`, loads the earlier controllers again, and starts those that ran."""
    before = _call("list_controllers", srv.ListControllers).controller if restore else []
    is_done = _say(
        _call("reload_controller_libraries", srv.ReloadControllerLibraries, force_kill).ok,
        "Successfully reloaded libraries",
        "Failed to reload libraries. Do you still have controllers loaded?",
    )
    if not is_done:
        return False
    loaded = all([load_controller(each.name) for each in before])
    running = [each.name for each in before if each.state == "running"]
    return loaded and (not running or start_controllers(running))


def load_controller(name: str) -> bool:
    return _say(
        _call("load_controller", srv.LoadController, name).ok,
        f"Loaded '{name}'",
        f"Error when loading '{name}'",
    )


def unload_controller(name: str) -> bool:
    return _say(
        _call("unload_controller", srv.UnloadController, name).ok,
        f"Unloaded '{name}' successfully",
        f"Error when unloading '{name}'",
    )


def start_controller(name: str) -> bool:
    return start_stop_controllers([name], True)


def start_controllers(names: List[str]) -> bool:
    return start_stop_controllers(names, True)


def stop_controller(name: str) -> bool:
    return start_stop_controllers([name], False)


def stop_controllers(names: List[str]) -> bool:
    return start_stop_controllers(names, False)


def start_stop_controllers(names: List[str], start: bool) -> bool:
    """Starts or stops all of these controllers, or none."""
    starting, stopping = (names, []) if start else ([], names)
    strict = srv.SwitchControllerRequest.STRICT
    return _say(
        _call("switch_controller", srv.SwitchController, starting, stopping, strict, False, 0.0).ok,
        f"{'Started' if start else 'Stopped'} {names} successfully",
        f"Error when {'starting' if start else 'stopping'} {names}",
    )
