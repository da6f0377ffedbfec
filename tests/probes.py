# SPDX-License-Identifier: MIT
"""Queries of a running graph for tests; each function runs in a process of its own (RosGraph.call)."""
import importlib
import time
from typing import Any, Dict, List, Optional, Set, Tuple

import rosgraph
import rospy

from ardee_common.ros_graph import wait_until


def _type(name: str) -> Any:
    """Returns the class of a message `package/Type`, or of a service `package/Type` if there is no such message."""
    package, kind = name.split("/")
    for part in ("msg", "srv"):
        try:
            return getattr(importlib.import_module(f"{package}.{part}"), kind)
        except (ImportError, AttributeError):
            continue
    raise ValueError(f"no message or service {name}")


def _start() -> None:
    rospy.init_node("probe", anonymous=True, disable_signals=True)


def collect(topic: str, kind: str, count: int, timeout_s: float = 60.0) -> List[Any]:
    """Returns the next `count` messages of a topic."""
    _start()
    messages = []  # type: List[Any]
    rospy.Subscriber(topic, _type(kind), messages.append, queue_size=1000)
    wait_until(lambda: len(messages) >= count, f"{count} messages on {topic}", timeout_s)
    return messages[:count]


def performance_of(topic: str, kind: str, count: int = 2) -> Any:
    """Returns the `count`-th performance metrics with data of a sensor, while `topic` has a subscriber."""
    from gazebo_msgs.msg import PerformanceMetrics

    _start()
    found = []  # type: List[Any]
    rospy.Subscriber(topic, _type(kind), lambda message: None)
    rospy.Subscriber("/gazebo/performance_metrics", PerformanceMetrics, found.append)
    told = lambda: [message for message in found if message.sensors]  # noqa: E731
    wait_until(lambda: len(told()) >= count, "performance metrics", 30.0)
    return told()[count - 1]


def joint_positions(topic: str, count: int = 20) -> Dict[str, float]:
    """Returns the latest angles [rad] by joint, from several publishers' messages on one topic."""
    found = {}  # type: Dict[str, float]
    for message in collect(topic, "sensor_msgs/JointState", count):
        found.update(zip(message.name, message.position))
    return found


def call_service(name: str, kind: str, fields: Dict[str, Any], timeout_s: float = 30.0) -> Any:
    """Returns the answer of a service."""
    return call_services([(name, kind, fields)], timeout_s)[0]


def call_services(
    calls: List[Tuple[str, str, Dict[str, Any]]], timeout_s: float = 30.0
) -> List[Any]:
    """Returns the answers of several services, called one after the other."""
    _start()
    answers = []
    for name, kind, fields in calls:
        rospy.wait_for_service(name, timeout_s)
        answers.append(rospy.ServiceProxy(name, _type(kind))(**fields))
    return answers


def topics(namespace: str = "/") -> Dict[str, str]:
    """Returns names and types of the published topics below a namespace."""
    _start()
    return dict(rospy.get_published_topics(namespace))


def services_of(node: str) -> Dict[str, str]:
    """Returns names and types of the services of a node."""
    import rosservice

    _start()
    names = rosservice.get_service_list(node=node)
    return {name: rosservice.get_service_type(name) for name in names}


def topics_of(node: str) -> Tuple[List[str], List[str]]:
    """Returns the topics that a node publishes, and those that it is subscribed to."""
    publishers, subscribers, _ = rosgraph.Master("probe").getSystemState()
    return (
        [name for name, nodes in publishers if node in nodes],
        [name for name, nodes in subscribers if node in nodes],
    )


def wait_for_topics(present: List[str], absent: List[str], timeout_s: float = 60.0) -> List[str]:
    """Returns all published topics, once those of the first list are there and those of the second are not."""
    _start()

    def names() -> Optional[List[str]]:
        found = {name for name, _ in rospy.get_published_topics()}
        return sorted(found) if found.issuperset(present) and found.isdisjoint(absent) else None

    return wait_until(names, f"topics {present} and none of {absent}", timeout_s)


def drive(
    cmd_topic: str, odom_topic: str, forward_m_s: float, turn_rad_s: float, sim_time_s: float
) -> Tuple[Any, Any]:
    """Returns first and last odometry of a drive at constant command for a while of simulated time."""
    from geometry_msgs.msg import Twist
    from nav_msgs.msg import Odometry

    _start()
    odometry = []  # type: List[Any]
    rospy.Subscriber(odom_topic, Odometry, odometry.append, queue_size=1000)
    publisher = rospy.Publisher(cmd_topic, Twist, queue_size=1)
    wait_until(lambda: odometry and publisher.get_num_connections(), f"odometry on {odom_topic}")
    command = Twist()
    command.linear.x, command.angular.z = forward_m_s, turn_rad_s
    first = odometry[-1]
    end = first.header.stamp + rospy.Duration.from_sec(sim_time_s)

    def arrived() -> bool:
        publisher.publish(command)
        return odometry[-1].header.stamp >= end

    wait_until(arrived, f"{sim_time_s} s of simulated driving", 60.0)
    last = odometry[-1]
    publisher.publish(Twist())
    return first, last


def transform(parent: str, child: str, timeout_s: float = 30.0) -> Any:
    """Returns the latest transform from `child` to `parent`, once tf has one."""
    import tf2_ros

    _start()
    buffer = tf2_ros.Buffer()
    tf2_ros.TransformListener(buffer)
    zero = rospy.Time(0)
    wait_until(
        lambda: buffer.can_transform(parent, child, zero), f"tf {parent} <- {child}", timeout_s
    )
    return buffer.lookup_transform(parent, child, zero)


def clock_at_least(sim_time_s: float, timeout_s: float = 60.0) -> float:
    """Returns the simulated time [s] once it has reached a value, which a node started too early never sees."""
    master = rosgraph.Master("probe")
    wait_until(lambda: master.hasParam("/use_sim_time"), "use_sim_time", timeout_s)
    _start()
    return wait_until(
        lambda: rospy.get_time() >= sim_time_s and rospy.get_time(),
        f"{sim_time_s} s of simulated time",
        timeout_s,
    )


def clock_stands_still(wall_time_s: float = 0.5) -> bool:
    """Returns whether no new /clock time appears for a while of wall time, once messages on their way have arrived."""
    _start()
    from rosgraph_msgs.msg import Clock

    times = []  # type: List[Any]
    rospy.Subscriber("/clock", Clock, lambda message: times.append(message.clock), queue_size=1000)
    time.sleep(wall_time_s)
    return len(set(times[1:])) <= 1


def parameter(name: str, timeout_s: float = 30.0) -> Any:
    """Returns the value of a parameter, once it is set."""
    master = rosgraph.Master("probe")
    wait_until(lambda: master.hasParam(name), f"parameter {name}", timeout_s)
    return master.getParam(name)


def parents_in_tf(child: str, wall_time_s: float) -> Set[str]:
    """Returns the parents of a frame in the transforms of a while on /tf and /tf_static."""
    from tf2_msgs.msg import TFMessage

    _start()
    messages = []  # type: List[Any]
    for topic in ("/tf", "/tf_static"):
        rospy.Subscriber(topic, TFMessage, messages.append, queue_size=1000)
    time.sleep(wall_time_s)
    all_of_them = [transform for message in messages for transform in message.transforms]
    return {t.header.frame_id for t in all_of_them if t.child_frame_id == child}


def command_joints(commands: Dict[str, float], sim_time_s: float) -> None:
    """Sends numbers to joint controllers by their topics, once they listen, and waits for a while of simulated time."""
    from std_msgs.msg import Float64

    _start()
    publishers = {topic: rospy.Publisher(topic, Float64, queue_size=1) for topic in commands}
    for topic, publisher in publishers.items():
        wait_until(publisher.get_num_connections, f"a listener on {topic}")
    for topic, publisher in publishers.items():
        publisher.publish(commands[topic])
    end = rospy.get_rostime() + rospy.Duration.from_sec(sim_time_s)
    wait_until(lambda: rospy.get_rostime() >= end, f"{sim_time_s} s of simulated time", 60.0)
