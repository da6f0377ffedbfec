# SPDX-License-Identifier: MIT
"""teleop_node: sensor_msgs/Joy to geometry_msgs/Twist while the enable button is held."""
import sys
import threading
import time
from typing import Dict

import rosgraph
import rospy
from geometry_msgs.msg import Twist, Vector3
from sensor_msgs.msg import Joy

from teleop_twist_joy.mapping import ANGULAR, LINEAR, read_mapping

MASTER_S = 0.2  # between looks for a ROS master
WATCH_S = 0.1  # between looks whether there still is a joystick's node
FLUSH_S = 0.1  # for the last message to leave before the node ends
ABOUT = """Drives by a joystick: listens to joy, publishes geometry_msgs/Twist on cmd_vel.
Parameters: ~enable_button, ~enable_turbo_button, ~axis_linear, ~scale_linear, ~axis_angular, ~scale_angular
and the turbo scales of teleop_twist_joy"""


def to_twist(velocity: Dict[str, float]) -> Twist:
    """Velocities by direction as a message."""
    return Twist(
        linear=Vector3(*(velocity.get(name, 0.0) for name in LINEAR)),
        angular=Vector3(*(velocity.get(name, 0.0) for name in ANGULAR)),
    )


class TeleopNode:
    """Drives while a button is held; stops once when none is any more, or when nobody publishes the joystick."""

    def __init__(self) -> None:
        self._mapping = read_mapping(lambda name, default: rospy.get_param(f"~{name}", default))
        self._driving = self._ended = False
        self._lock = threading.Lock()  # callbacks and the watch have threads of their own
        self._publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)
        self._subscriber = rospy.Subscriber("joy", Joy, self._heard, queue_size=1)

    def _heard(self, message: Joy) -> None:
        velocity = self._mapping.velocity(message.axes, message.buttons)
        with self._lock:
            if velocity is not None and not self._ended:
                self._driving = True
                self._publisher.publish(to_twist(velocity))
        if velocity is None:
            self.stop()

    def stop(self) -> None:
        """Tells the robot to stop if it has been told to go."""
        with self._lock:
            if self._driving:
                self._driving = False
                self._publisher.publish(Twist())

    def end(self) -> None:
        """Stops for good: the joystick may still be heard while the node ends."""
        with self._lock:
            self._ended = True
        self.stop()

    def run(self) -> None:
        """Runs until the node is shut down; watches for a joystick node that dies silently."""
        while not rospy.is_shutdown():
            if self._subscriber.get_num_connections() == 0:
                self.stop()
            time.sleep(WATCH_S)


def main() -> int:
    """Run the node, once there is a ROS master; 2 when a parameter is wrong. -h needs no master."""
    if {"-h", "--help"} & set(sys.argv[1:]):
        print(f"usage: teleop_node [-h] [_PARAMETER:=VALUE ...]\n{ABOUT}")
        return 0
    while not rosgraph.is_master_online():
        time.sleep(MASTER_S)
    try:
        rospy.init_node("teleop_twist_joy_node")
    except rospy.ROSInitException:  # ended before it had begun
        return 130
    try:
        node = TeleopNode()
    except ValueError as error:
        rospy.logfatal("%s", error)
        return 2

    def end() -> None:
        node.end()
        time.sleep(FLUSH_S)

    rospy.on_shutdown(end)
    node.run()
    return 0
