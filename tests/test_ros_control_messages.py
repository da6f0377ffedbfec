# SPDX-License-Identifier: MIT
"""Tests that the md5 sums of ros_control's messages are those of nodes built against the originals.

Source of the sums: controller_manager_msgs (ros_control, noetic), control_msgs (kinetic), control_toolbox (melodic) and
four_wheel_steering_msgs.
"""
import pytest
import roslib.message

MESSAGES = {
    "control_msgs/FollowJointTrajectoryAction": "bc4f9b743838566551c0390c65f1a248",
    "control_msgs/FollowJointTrajectoryActionFeedback": "d8920dc4eae9fc107e00999cce4be641",
    "control_msgs/FollowJointTrajectoryActionGoal": "cff5c1d533bf2f82dd0138d57f4304bb",
    "control_msgs/FollowJointTrajectoryActionResult": "c4fb3b000dc9da4fd99699380efcc5d9",
    "control_msgs/FollowJointTrajectoryGoal": "69636787b6ecbde4d61d711979bc7ecb",
    "control_msgs/FollowJointTrajectoryResult": "493383b18409bfb604b4e26c676401d2",
    "control_msgs/GripperCommand": "680acaff79486f017132a7f198d40f08",
    "control_msgs/GripperCommandAction": "950b2a6ebe831f5d4f4ceaba3d8be01e",
    "control_msgs/JointControllerState": "987ad85e4756f3aef7f1e5e7fe0595d1",
    "control_msgs/JointJog": "1685da700c8c2e1254afc92a5fb89c96",
    "control_msgs/JointTolerance": "f544fe9c16cf04547e135dd6063ff5be",
    "control_msgs/JointTrajectoryAction": "a04ba3ee8f6a2d0985a6aeaf23d9d7ad",
    "control_msgs/JointTrajectoryControllerState": "10817c60c2486ef6b33e97dcd87f4474",
    "control_msgs/PidState": "b138ec00e886c10e73f27e8712252ea6",
    "control_msgs/PointHeadAction": "7252920f1243de1b741f14f214125371",
    "control_msgs/SingleJointPositionAction": "c4a786b7d53e5d0983decf967a5a779e",
    "controller_manager_msgs/ControllerState": "aeb6b261d97793ab74099a3740245272",
    "controller_manager_msgs/ControllerStatistics": "697780c372c8d8597a1436d0e2ad3ba8",
    "controller_manager_msgs/ControllersStatistics": "a154c347736773e3700d1719105df29d",
    "controller_manager_msgs/HardwareInterfaceResources": "f25b55cbf1d1f76e82e5ec9e83f76258",
    "four_wheel_steering_msgs/FourWheelSteering": "04dd0f55e1f168668af1e2587a7cdd2a",
    "four_wheel_steering_msgs/FourWheelSteeringStamped": "9226582df815bc6df9e3206bc05923af",
    "trajectory_msgs/JointTrajectory": "65b4f94a94d1ed67169da35a02f33d3f",
    "trajectory_msgs/JointTrajectoryPoint": "f3cd1e1c4d320c79d6985c904ae5dcd3",
}
SERVICES = {
    "control_msgs/QueryTrajectoryState": "ec93cdecbd8062d761aa52b7c90cd44b",
    "control_toolbox/SetPidGains": "4a43159879643e60937bf2893b633607",
    "controller_manager_msgs/ListControllerTypes": "c1d4cd11aefa9f97ba4aeb5b33987f4e",
    "controller_manager_msgs/ListControllers": "1341feb2e63fa791f855565d0da950d8",
    "controller_manager_msgs/LoadController": "647e5c54b8d6468952d8d31f1efe96c0",
    "controller_manager_msgs/ReloadControllerLibraries": "40e8c411fd1797d2e2c486018f846040",
    "controller_manager_msgs/SwitchController": "b29a7abc673b2c54c14b54e50f8d06a5",
    "controller_manager_msgs/UnloadController": "647e5c54b8d6468952d8d31f1efe96c0",
}


@pytest.mark.parametrize("name", MESSAGES)
def test_message(name: str) -> None:
    assert roslib.message.get_message_class(name)._md5sum == MESSAGES[name]


@pytest.mark.parametrize("name", SERVICES)
def test_service(name: str) -> None:
    assert roslib.message.get_service_class(name)._md5sum == SERVICES[name]
