# SPDX-License-Identifier: MIT
"""Calls of the simulator's services, ready for probes.call_services: (name, type, fields)."""
import math
from typing import Any, Dict, List, Tuple

import probes
from geometry_msgs.msg import Point, Pose, Quaternion, Vector3, Wrench

from ardee_common.ros_graph import Process, RosGraph

EMPTY = '<sdf version="1.6"><world name="w"></world></sdf>'  # steps of 1 ms, gravity of 9.8 m/s2
Call = Tuple[str, str, Dict[str, Any]]


def simulate(graph: RosGraph, world: str = EMPTY) -> Process:
    """Starts the simulator with a world of this text."""
    file = graph.folder / "test.world"
    file.write_text(world)
    return graph.spawn("rosrun", "ardee_sim_cpp", "simulator", str(file))


def pose(x: float = 0, y: float = 0, z: float = 0, yaw: float = 0) -> Pose:
    """Returns a level pose [m, rad]."""
    turn = Quaternion(0, 0, math.sin(yaw / 2), math.cos(yaw / 2))
    return Pose(Point(x, y, z), turn)


def spawn(name: str, xml: str, at: Pose, kind: str = "sdf", **more: str) -> Call:
    fields = dict(model_name=name, model_xml=xml, initial_pose=at, **more)
    return f"/gazebo/spawn_{kind}_model", "gazebo_msgs/SpawnModel", fields


def delete(name: str) -> Call:
    return "/gazebo/delete_model", "gazebo_msgs/DeleteModel", {"model_name": name}


def empty(name: str) -> Call:
    return f"/gazebo/{name}", "std_srvs/Empty", {}


def state(name: str, relative_to: str = "") -> Call:
    fields = {"model_name": name, "relative_entity_name": relative_to}
    return "/gazebo/get_model_state", "gazebo_msgs/GetModelState", fields


def step(steps: int) -> Call:
    return "/ardee/step", "ardee_msgs/Step", {"steps": steps}


def push(body: str, force_n: Vector3, duration_s: float, frame: str = "") -> Call:
    import rospy

    fields = {
        "body_name": body,
        "reference_frame": frame,
        "wrench": Wrench(force_n, Vector3()),
        "duration": rospy.Duration.from_sec(duration_s),
    }
    return "/gazebo/apply_body_wrench", "gazebo_msgs/ApplyBodyWrench", fields


def call(graph: RosGraph, *calls: Call) -> List[Any]:
    return graph.call(probes.call_services, list(calls))
