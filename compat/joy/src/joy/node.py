# SPDX-License-Identifier: MIT
"""joy_node: publishes a Linux joystick as sensor_msgs/Joy."""
import sys
import time
from typing import Optional

import rosgraph
import rospy
from sensor_msgs.msg import Joy

from joy.device import BUTTON, Device, DeviceGone, JoyState

RETRY_S = 0.5  # between looks for a device that is not there
FLUSH_S = 0.1  # for the last message to leave before the node ends
MASTER_S = 0.2  # between looks for a ROS master
WATCH_S = 0.1  # between looks whether the device and the node are still wanted
PARAMETERS = {  # name: default, least, greatest
    "deadzone": (0.05, 0.0, 0.9),
    "autorepeat_rate": (0.0, 0.0, 1000.0),
    "coalesce_interval": (0.001, 0.0, 10.0),
}
ABOUT = """Publishes a Linux joystick as sensor_msgs/Joy on joy.
Parameters: ~dev (default /dev/input/js0), ~deadzone (default 0.05), ~autorepeat_rate (Hz, default 0: off),
~coalesce_interval (s, default 0.001), ~sticky_buttons, ~default_trig_val"""


def number(name: str) -> float:
    """A private parameter of PARAMETERS; ValueError for one that is out of range."""
    default, least, greatest = PARAMETERS[name]
    value = rospy.get_param(f"~{name}", default)
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise ValueError(f"~{name}: {value!r}; expected a number")
    if not least <= value <= greatest:
        raise ValueError(f"~{name}: {value}; expected {least} to {greatest}")
    return float(value)


def flag(name: str) -> bool:
    """A private parameter that is true or false, false by default; ValueError for another."""
    value = rospy.get_param(f"~{name}", False)
    if not isinstance(value, bool):
        raise ValueError(f"~{name}: {value!r}; expected true or false")
    return value


class JoyNode:
    """Reads one joystick, waits for it where it is not there, says so when it goes."""

    def __init__(self) -> None:
        self._path = str(rospy.get_param("~dev", "/dev/input/js0"))
        sticky, initial_axes = flag("sticky_buttons"), flag("default_trig_val")
        self._state = JoyState(number("deadzone"), sticky, initial_axes)
        rate = number("autorepeat_rate")
        self._repeat_s = 1.0 / rate if rate > 0 else float("inf")
        self._coalesce_s = number("coalesce_interval")
        self._publisher = rospy.Publisher("joy", Joy, queue_size=1)
        self._due_s = float("inf")  # when the state is to be published, monotonic

    def run(self) -> None:
        """Publishes until the node is shut down."""
        useless = False  # whether the last look found no usable device, which is logged once
        while not rospy.is_shutdown():
            device = self._open(quietly=useless)
            if device is None:
                useless = True
                time.sleep(RETRY_S)
                continue
            try:
                self._follow(device)
            except DeviceGone as reason:
                if device.has_told or not useless:
                    rospy.logerr("joystick %s is gone: %s; stopping", self._path, reason)
                self.let_go()
                useless = not device.has_told
                time.sleep(RETRY_S if useless else WATCH_S)
            finally:
                device.close()

    def let_go(self) -> None:
        """Publishes the released state, if another state has been published."""
        self._due_s = float("inf")
        if self._state.axes or self._state.buttons:
            self._state.release()
            self._publish()

    def _open(self, quietly: bool) -> Optional[Device]:
        try:
            device = Device(self._path)
        except OSError as error:
            if not quietly:
                rospy.logwarn("no joystick %s (%s): waiting for it", self._path, error.strerror)
            return None
        if not quietly:
            rospy.loginfo("joystick %s", self._path)
        return device

    def _follow(self, device: Device) -> None:
        """Publishes the events of an open device."""
        while not rospy.is_shutdown():
            wait_s = min(max(self._due_s - time.monotonic(), 0.0), WATCH_S)
            for event in device.read(wait_s):
                self._state.apply(event)
                # a button is told at once; other events, and the many at opening, are collected
                at_once = event.kind == BUTTON and not event.initial
                self._due_s = min(
                    self._due_s, time.monotonic() + (0.0 if at_once else self._coalesce_s)
                )
                if at_once:
                    self._publish()
            if time.monotonic() >= self._due_s:
                self._publish()

    def _publish(self) -> None:
        message = Joy(axes=self._state.axes, buttons=self._state.buttons)
        message.header.stamp = rospy.Time.now()
        self._due_s = time.monotonic() + self._repeat_s
        self._publisher.publish(message)


def main() -> int:
    """Run the node, once there is a ROS master; 2 when a parameter is wrong. -h needs no master."""
    if {"-h", "--help"} & set(sys.argv[1:]):
        print(f"usage: joy_node [-h] [_PARAMETER:=VALUE ...]\n{ABOUT}")
        return 0
    while not rosgraph.is_master_online():
        time.sleep(MASTER_S)
    try:
        rospy.init_node("joy_node")
    except rospy.ROSInitException:  # ended before it had begun
        return 130
    try:
        node = JoyNode()
    except ValueError as error:
        rospy.logfatal("%s", error)
        return 2

    def end() -> None:
        node.let_go()
        time.sleep(FLUSH_S)

    rospy.on_shutdown(end)
    node.run()
    return 0
