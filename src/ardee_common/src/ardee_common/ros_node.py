# SPDX-License-Identifier: MIT
"""Starts, runs and ends a ROS node, by the wall's clock. This is the only module of the package that needs ROS."""
import argparse
import http.client
import signal
import sys
import threading
import time
import xmlrpc.client
from pathlib import Path
from typing import Any, Callable

import rosgraph
import rospkg
import rospy

from ardee_common.cli import Parser
from ardee_common.config import from_values, read_yaml_lines
from ardee_common.errors import GeneratorError

POLL_S = 0.2
MASTER_PERIOD_S = 2.0
SIGNALS = (signal.SIGINT, signal.SIGTERM)

_asked_to_end, _is_forgotten = threading.Event(), threading.Event()


def heed_arguments(name: str, about: str) -> None:
    """Prints `about` for -h and --help and ends the node; refuses any other word that ROS leaves."""
    parser = Parser(
        prog=name,
        usage="%(prog)s [-h] [_PARAMETER:=VALUE ...] [NAME:=OTHER_NAME ...]",
        description=about,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.parse_args(rospy.myargv()[1:])


def read_parameters(cls: type, package: str = "", file_name: str = "") -> Any:
    """Returns the private parameters, over the values of a package's settings file, as a dataclass of options."""
    given = rospy.get_param("~", {})
    if file_name and isinstance(given, dict):
        file = Path(rospkg.RosPack().get_path(package), "config", file_name)
        given = {**read_yaml_lines(file), **given}
    return from_values(cls, given)


def is_connected(subscriber: rospy.Subscriber) -> bool:
    """Has a publisher accepted this subscriber? rospy also counts connections that are still being made."""
    return any(connection.remote_endpoint[0] for connection in subscriber.impl.connections)


def watch_master() -> None:
    """Goes on while the ROS master is away, for topics need none; ends the node once another one is there instead.

    rospy never registers anew: the new master and its nodes would not know of this node's topics. They may know the
    node's name, because a line of the log asks for a parameter in that name; so the master's process is compared, too.
    """
    name = rospy.get_name()
    master = rosgraph.Master(name)
    pid = master.getPid()

    def repeat() -> None:
        is_known, is_away = True, False
        while is_known and not rospy.is_shutdown():
            rospy.rostime.wallsleep(MASTER_PERIOD_S)
            try:
                master.lookupNode(name)
                is_known, is_away = master.getPid() == pid, False
            except rosgraph.MasterError:
                is_known = False
            except (OSError, xmlrpc.client.Error, http.client.HTTPException):
                if not is_away:
                    print(f"{name}: the ROS master is away", file=sys.stderr, flush=True)
                is_away = True
        if not rospy.is_shutdown():
            _is_forgotten.set()
            print(f"{name}: the ROS master knows this node no more", file=sys.stderr, flush=True)
            rospy.signal_shutdown("forgotten by the master")

    threading.Thread(target=repeat, daemon=True).start()


def enter(name: str, **options: Any) -> bool:
    """Calls rospy.init_node with these options once there is a master; returns False if the node was ended first.

    rospy itself waits for one only where no private parameter stands on the command line.
    """
    if not rosgraph.is_master_online():
        uri = rosgraph.get_master_uri()
        print(f"{name}: waiting for the ROS master at {uri}", file=sys.stderr, flush=True)
        while not rosgraph.is_master_online():
            time.sleep(POLL_S)
    try:
        rospy.init_node(name, disable_signals=True, **options)
    except rospy.ROSInitException:
        if not rospy.is_shutdown():
            raise

    # Not rospy's handlers: where they interrupt a call to the master they wait for its lock for ever.
    def end(_: int, __: object) -> None:
        _asked_to_end.set()
        for number in SIGNALS:
            signal.signal(number, signal.SIG_DFL)  # the second one ends the process as it is

    for number in SIGNALS:
        signal.signal(number, end)
    return not rospy.is_shutdown()


def loop(step: Callable[[float], Any]) -> None:
    """Calls `step` again and again, with a time to wait [s], until the node is to end; then ends it."""
    while not rospy.is_shutdown() and not _asked_to_end.is_set():
        step(POLL_S)
    rospy.signal_shutdown("asked to end")


def run(name: str, about: str, body: Callable[[], Callable[[float], Any]], **options: Any) -> int:
    """Runs a node and returns its exit code; `about` is the text of -h, `options` are those of rospy.init_node.

    `body` returns the function that is then called again and again with a time to wait [s].
    """
    heed_arguments(name, about)
    if not enter(name, **options):
        return 0
    try:
        watch_master()
        step = body()
    except (GeneratorError, OSError) as error:
        print(f"{rospy.get_name()}: {error}", file=sys.stderr)
        return 2
    loop(step)
    return 3 if _is_forgotten.is_set() else 0
