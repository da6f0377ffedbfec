# SPDX-License-Identifier: MIT
"""Matches GPS fixes with velocities: ROS has them on two topics, the wire in one message."""
import threading
from typing import Any, Callable, Optional, Tuple


def _stamp(message: Any) -> Tuple[int, int]:
    return message.header.stamp.secs, message.header.stamp.nsecs


class FixWithVelocity:
    """Sends each fix with the velocity of its own time if the receiver has one, else with the latest.

    Receivers publish the velocity right after the fix. If the last one came with the stamp of its fix, the next one is
    awaited, at the longest until the next fix; then no more, until stamps agree again.
    """

    def __init__(self, send: Callable[[Any, Any], None]) -> None:
        """`send` gets a sensor_msgs/NavSatFix and a geometry_msgs/Vector3 [m/s], or None before the first."""
        self._send = send
        self._velocity: Any = None
        self._waiting: Any = None
        self._latest_fix: Optional[Tuple[int, int]] = None
        self._comes_after = False
        self._lock = threading.Lock()  # rospy reads each topic in a thread of its own

    def on_fix(self, fix: Any) -> None:
        """Handles a sensor_msgs/NavSatFix."""
        with self._lock:
            if self._waiting is not None:
                self._comes_after = False
                self._send_waiting()
            self._waiting, self._latest_fix = fix, _stamp(fix)
            has_fix = fix.status.status >= 0  # without a fix there is no velocity either
            if not (has_fix and self._comes_after) or self._has_velocity_of(fix):
                self._send_waiting()

    def on_velocity(self, velocity: Any) -> None:
        """Handles a geometry_msgs/Vector3Stamped."""
        with self._lock:
            self._velocity = velocity
            if _stamp(velocity) == self._latest_fix:
                self._comes_after = True
            if self._waiting is not None and self._has_velocity_of(self._waiting):
                self._send_waiting()

    def _has_velocity_of(self, fix: Any) -> bool:
        return self._velocity is not None and _stamp(self._velocity) == _stamp(fix)

    def _send_waiting(self) -> None:
        fix, self._waiting = self._waiting, None
        self._send(fix, self._velocity and self._velocity.vector)
