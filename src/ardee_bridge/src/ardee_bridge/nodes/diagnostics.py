# SPDX-License-Identifier: MIT
"""Publishes a node's counters on /diagnostics."""
import threading

import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

from ardee_bridge.nodes.counters import Counters

PERIOD_S = 1.0


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
            rospy.rostime.wallsleep(PERIOD_S)

    threading.Thread(target=repeat, daemon=True).start()
