#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Answers scans by a constant command: ros_program.py SPEED_M_S SCANS. Then it ends; with -1 SCANS it is mute."""
import sys

import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import LaserScan

speed, left = float(sys.argv[1]), int(sys.argv[2])
rospy.init_node("constant")
commands = rospy.Publisher("cmd_vel", Twist, queue_size=1)


def answer(scan: LaserScan) -> None:
    """Publishes a command."""
    global left
    assert len(scan.ranges) == 1081 and rospy.get_param("/use_sim_time")
    if not left:
        rospy.signal_shutdown("that was the last scan")
        return
    if left < 0:
        return
    left -= 1
    command = Twist()
    command.linear.x = speed
    commands.publish(command)


rospy.Subscriber("ardee/hokuyo", LaserScan, answer, queue_size=1)
rospy.spin()
