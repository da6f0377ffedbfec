# SPDX-License-Identifier: MIT
"""What both nodes share: settings from file and parameters, diagnostics, the loop. The clock is the wall's."""
import argparse
import http.client
import signal
import sys
import threading
import time
import xmlrpc.client
from pathlib import Path
from typing import Any, Callable, Dict

import rosgraph
import rospkg
import rospy
import yaml
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

from ardee_bridge.nodes.counters import Counters
from ardee_bridge.nodes.settings import SettingError

DIAGNOSTICS_PERIOD_S = 1.0
POLL_S = 0.2
MASTER_PERIOD_S = 2.0
SIGNALS = (signal.SIGINT, signal.SIGTERM)

_asked_to_end, _is_forgotten = threading.Event(), threading.Event()


def read_parameters(file_name: str) -> Dict[str, Any]:
    """The package's settings file, with the node's private parameters over it."""
    file = Path(rospkg.RosPack().get_path("ardee_bridge"), "config", file_name)
    values = yaml.safe_load(file.read_text(encoding="utf-8"))
    values.update(rospy.get_param("~", {}))
    return values


def start_diagnostics(counters: Counters) -> None:
    """Publishes all counters once a second of wall time; WARN while something was dropped in the last second."""
    publisher = rospy.Publisher("/diagnostics", DiagnosticArray, queue_size=1)

    def repeat() -> None:
        before = 0
        while not rospy.core.is_shutdown():
            dropped = counters.dropped()
            fresh, before = sum(dropped.values()) - before, sum(dropped.values())
            status = DiagnosticStatus(name=rospy.get_name(), hardware_id="UDP bridge")
            status.level = DiagnosticStatus.WARN if fresh else DiagnosticStatus.OK
            status.message = f"dropped {fresh} in the last second" if fresh else "nothing dropped"
            pairs = sorted(counters.done().items())
            pairs += [(f"dropped: {kind}", count) for kind, count in sorted(dropped.items())]
            status.values = [KeyValue(kind, str(count)) for kind, count in pairs]
            array = DiagnosticArray(status=[status])
            array.header.stamp = rospy.Time.now()
            publisher.publish(array)
            rospy.rostime.wallsleep(DIAGNOSTICS_PERIOD_S)

    threading.Thread(target=repeat, daemon=True).start()


def heed_arguments(name: str, about: str) -> None:
    """Of the words that ROS leaves: -h and --help print what the node is `about` and end it, any other is refused."""
    parser = argparse.ArgumentParser(
        prog=name,
        usage="%(prog)s [-h] [_PARAMETER:=VALUE ...] [NAME:=OTHER_NAME ...]",
        description=about,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    _, unknown = parser.parse_known_args(rospy.myargv()[1:])
    if unknown:
        parser.exit(2, f"{name}: unrecognized arguments: {' '.join(unknown)}\n")


def watch_master() -> None:
    """Goes on while the ROS master is away, for topics need none; ends the node once another one is there instead.

    rospy never registers anew: the new master and its nodes would not know of this node's topics. Its name alone they
    may know, for a line of the log asks for a parameter in that name; so the master's process is compared, too.
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
    """rospy.init_node with these options, once there is a master; False: the node was ended first.

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


def loop(step: Callable[[float], None]) -> None:
    """Call `step` again and again, with a time to wait [s], until the node is to end; then end it."""
    while not rospy.is_shutdown() and not _asked_to_end.is_set():
        step(POLL_S)
    rospy.signal_shutdown("asked to end")


def run(name: str, about: str, body: Callable[[], Callable[[float], None]]) -> int:
    """Starts a node; `body` makes what is then called again and again with a time to wait [s]. Returns the exit code.

    `about` is the text of -h. Simulated time may stand still or be gone: /clock is not subscribed to.
    """
    heed_arguments(name, about)
    if not enter(name, disable_rostime=True):
        return 0
    try:
        watch_master()
        step = body()
    except (SettingError, OSError) as error:
        print(f"{rospy.get_name()}: {error}", file=sys.stderr)
        return 2
    loop(step)
    return 3 if _is_forgotten.is_set() else 0
