#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""A ROS node around keep_middle: scans in, commands out, until the row ends."""
import rospy
from geometry_msgs.msg import Twist
from keep_middle import command
from sensor_msgs.msg import LaserScan


def on_scan(scan: LaserScan) -> None:
    """Answers a scan with a command; ends the node where the row ends."""
    speed_m_s, turn_rad_s = command(scan.ranges, scan.angle_min, scan.angle_increment)
    answer = Twist()
    answer.linear.x, answer.angular.z = speed_m_s, turn_rad_s
    commands.publish(answer)
    if speed_m_s == 0.0:
        print(f"no row in sight at {scan.header.stamp.to_sec():.1f} s: stopped", flush=True)
        rospy.sleep(0.2)  # the last command is to leave before the node ends
        rospy.signal_shutdown("end of the row")


rospy.init_node("ros_driver")
commands = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rospy.Subscriber("ardee/hokuyo", LaserScan, on_scan, queue_size=1)
print("driving", flush=True)
rospy.spin()
