# SPDX-License-Identifier: MIT
"""`spawner`: loads controllers and starts them; stops and unloads them when it ends."""
import argparse
import pathlib
import time
from typing import List, Optional

import rosparam
import rospy
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Bool

from controller_manager_msgs.srv import (
    LoadController,
    SwitchController,
    SwitchControllerRequest,
    UnloadController,
)

PAUSE_S = 1.0  # wait after a controller that could not be loaded
SERVICES = ("load_controller", "switch_controller", "unload_controller")
KINDS = (LoadController, SwitchController, UnloadController)


class Spawner:
    """Caller of the controller manager's services; remembers the controllers that it has loaded."""

    def __init__(self, namespace: str) -> None:
        prefix = namespace.rstrip("/") + "/" if namespace else ""
        self.services = [f"{prefix}controller_manager/{name}" for name in SERVICES]
        self._load, self._switch, self._unload = (
            rospy.ServiceProxy(name, kind) for name, kind in zip(self.services, KINDS)
        )
        self.loaded: List[str] = []

    def wait(self, timeout_s: Optional[float]) -> None:
        """Waits for the services; raises ROSException when one is not there in time."""
        for name in self.services:
            rospy.loginfo("waiting for service %s", rospy.resolve_name(name))
            rospy.wait_for_service(name, timeout_s)

    def load(self, names: List[str]) -> None:
        for name in names:
            rospy.loginfo("loading controller %s", name)
            if self._load(name).ok:
                self.loaded.append(name)
            else:
                rospy.logerr("could not load controller %s", name)
                time.sleep(PAUSE_S)

    def start(self) -> None:
        strict = SwitchControllerRequest.STRICT
        if self._switch(self.loaded, [], strict, False, 0.0).ok:
            rospy.loginfo("started controllers: %s", ", ".join(self.loaded))
        else:
            rospy.logerr("could not start controllers: %s", ", ".join(self.loaded))

    def take_down(self) -> None:
        if not self.loaded:
            return
        try:
            best_effort = SwitchControllerRequest.BEST_EFFORT
            self._switch([], self.loaded, best_effort, False, 0.0)
            for name in reversed(self.loaded):
                self._unload(name)
        except (rospy.ServiceException, rospy.ROSException) as error:
            rospy.logwarn("could not stop and unload all controllers: %s", error)


def names_of(argument: str, namespace: str) -> List[str]:
    """Returns a file's top keys, whose parameters are set; or the name itself."""
    if not pathlib.Path(argument).is_file():
        return [argument]
    names: List[str] = []
    for parameters, space in rosparam.load_file(argument, default_namespace=namespace or None):
        rosparam.upload_params(space, parameters)
        names.extend(parameters)
    return names


def wait_for_true(topic: str) -> None:
    rospy.loginfo("waiting for true on %s", rospy.resolve_name(topic))
    while not rospy.is_shutdown() and not rospy.wait_for_message(topic, Bool).data:
        pass


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="spawner", description=__doc__)
    parser.add_argument(
        "--stopped", action="store_true", help="load the controllers, but do not start them"
    )
    parser.add_argument(
        "--wait-for", metavar="TOPIC", help="topic of std_msgs/Bool; begin when it is true"
    )
    parser.add_argument(
        "--namespace", default="", metavar="NS", help="namespace of the controller manager"
    )
    parser.add_argument(
        "--timeout",
        type=float,
        default=30.0,
        metavar="S",
        help="time to wait for the controller manager's services [s]; <= 0: for ever",
    )
    parser.add_argument(
        "--no-timeout",
        action="store_true",
        help="wait for the controller manager's services for ever",
    )
    parser.add_argument("--shutdown-timeout", metavar="S", help="has no effect")
    parser.add_argument(
        "controllers",
        nargs="+",
        metavar="NAME|FILE.yaml",
        help="names of controllers, or YAML files of their parameters",
    )
    return parser.parse_args(rospy.myargv()[1:])


def main() -> int:
    arguments = parse_arguments()
    try:
        rospy.init_node("spawner", anonymous=True)
    except rospy.ROSInitException:  # ended while there was no ROS master
        return 130
    timeout_s = None if arguments.no_timeout or arguments.timeout <= 0.0 else arguments.timeout
    spawner = Spawner(arguments.namespace)
    try:
        spawner.wait(timeout_s)
        if rospy.get_param("/use_sim_time", False):
            rospy.wait_for_message("/clock", Clock)
        if arguments.wait_for:
            wait_for_true(arguments.wait_for)
    except rospy.ROSInterruptException:
        return 0
    except rospy.ROSException as error:
        rospy.logerr("no controller manager: %s", error)
        return 1
    rospy.on_shutdown(spawner.take_down)
    try:
        for argument in arguments.controllers:
            spawner.load(names_of(argument, arguments.namespace))
        if spawner.loaded and not arguments.stopped:
            spawner.start()
    except rospy.ServiceException as error:
        rospy.logerr("the controller manager does not answer: %s", error)
        return 1
    rospy.spin()
    return 0
