# SPDX-License-Identifier: MIT
"""`unspawner`: stops controllers as long as it runs, and starts them again when it ends."""
import argparse
import time

import rospy

from controller_manager_msgs.srv import ListControllers, SwitchController, SwitchControllerRequest

PERIOD_S = 3.0  # of wall time: others may have started them


def main() -> int:
    parser = argparse.ArgumentParser(prog="unspawner", description=__doc__)
    parser.add_argument("controllers", nargs="+", metavar="NAME")
    names = parser.parse_args(rospy.myargv()[1:]).controllers
    try:
        rospy.init_node("unspawner", anonymous=True)
    except rospy.ROSInitException:  # ended while there was no ROS master
        return 130
    rospy.wait_for_service("controller_manager/list_controllers")
    rospy.wait_for_service("controller_manager/switch_controller")
    list_controllers = rospy.ServiceProxy("controller_manager/list_controllers", ListControllers)
    switch = rospy.ServiceProxy("controller_manager/switch_controller", SwitchController)
    best_effort = SwitchControllerRequest.BEST_EFFORT
    stopped = set()

    def restart() -> None:
        try:
            switch(sorted(stopped), [], best_effort, False, 0.0)
        except rospy.ServiceException as error:
            rospy.logwarn("could not start the controllers again: %s", error)

    rospy.on_shutdown(restart)
    while not rospy.is_shutdown():
        try:
            running = {
                each.name for each in list_controllers().controller if each.state == "running"
            }
            stopping = sorted(running.intersection(names))
            if stopping and switch([], stopping, best_effort, False, 0.0).ok:
                rospy.loginfo("stopped controllers: %s", ", ".join(stopping))
                stopped.update(stopping)
        except rospy.ServiceException as error:
            rospy.logwarn("the controller manager does not answer: %s", error)
        time.sleep(PERIOD_S)
    return 0
