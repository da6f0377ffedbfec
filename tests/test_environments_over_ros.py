# SPDX-License-Identifier: MIT
"""Tests that the node `simulator` gives the bytes of an environment's episode: same robot, start, seed, commands."""
import pathlib
from typing import Any, Dict, List, Tuple

import ardee_sim.envs  # noqa: F401  registers the environments
import gymnasium
import numpy as np
import pytest

from ardee_common.ros_graph import RosGraph
from ardee_world.row_truth import Pose

STEPS = 300
SMALL = {"RowFollowCamera": dict(width_px=32, height_px=24)}
# Of each control period: stamp [ns] and bytes of each topic's reading
Said = List[Dict[str, Tuple[int, bytes]]]


def to_and_fro(number: int) -> Tuple[float, float]:
    """Returns speed [m/s] and turn rate [rad/s] of a step, so that an episode of any length does not end."""
    return (0.32 if number % 40 < 20 else -0.32), 0.1 * (-1) ** (number // 10)


def bytes_of_reading(reading: Any) -> bytes:
    kind = type(reading).__name__
    if kind == "LidarReading":
        return reading.ranges_m.tobytes()
    if kind == "ImageReading":
        return reading.pixels.tobytes()
    if kind == "ImuReading":
        values = (*reading.quat_xyzw, *reading.w_rad_s)
    elif kind == "OdometryReading":
        values = (*reading.xyz_m, *reading.quat_xyzw)
    elif kind == "GpsQualityReading":
        values = (reading.position_std_m, *reading.error_m)
    else:
        values = (reading.latitude_deg, reading.longitude_deg, reading.altitude_m)
    return np.array(values, np.float64).tobytes()


def bytes_of_message(message: Any) -> bytes:
    kind = message._type
    if kind == "sensor_msgs/LaserScan":
        return np.array(message.ranges, np.float32).tobytes()
    if kind == "sensor_msgs/Image":
        return bytes(message.data)
    if kind == "sensor_msgs/Imu":
        q, w = message.orientation, message.angular_velocity
        values = (q.x, q.y, q.z, q.w, w.x, w.y, w.z)
    elif kind == "nav_msgs/Odometry":
        p, q = message.pose.pose.position, message.pose.pose.orientation
        values = (p.x, p.y, p.z, q.x, q.y, q.z, q.w)
    elif kind == "ardee_msgs/GpsQuality":
        error = message.error
        values = (message.position_std, error.x, error.y, error.z)
    else:
        values = (message.latitude, message.longitude, message.altitude)
    return np.array(values, np.float64).tobytes()


def on_the_node(episode: Dict[str, Any]) -> Said:
    """Repeats an episode on the node; returns what its topics said at the end of each control period."""
    import queue

    import roslib.message
    import rospy
    import rostopic

    from ardee_campaigns.ros.simulator import RosSimulation
    from ardee_common.ros_graph import wait_until
    from ardee_common.ros_node import is_connected

    rospy.init_node("probe", anonymous=True, disable_signals=True, disable_rostime=True)
    heard: Dict[str, Any] = {topic: queue.Queue() for topic in episode["topics"]}

    def message_at(topic: str, stamp_ns: int) -> Any:
        while True:
            message = heard[topic].get(timeout=20.0)
            if message.header.stamp.to_nsec() >= stamp_ns:
                return message

    with RosSimulation(*episode["simulator"]) as node:
        urdf, start, height_m = episode["robot"]
        origin = Pose(0.0, 0.0, 0.0)  # as of an environment's robot: to move it rounds its numbers
        node.place(urdf, origin, 0.0)
        node.set_pose(start, height_m)
        node.connect(None, "/cmd_vel")
        for topic, messages in heard.items():
            kind = roslib.message.get_message_class(rostopic.get_topic_type(f"/{topic}")[0])
            subscriber = rospy.Subscriber(f"/{topic}", kind, messages.put, tcp_nodelay=True)
            wait_until(lambda each=subscriber: is_connected(each), topic)
        node.command(0.0, 0.0)
        node.step(episode["settle_steps"])
        said: Said = []
        for number, wanted in enumerate(episode["said"]):
            node.command(*to_and_fro(number))
            node.step(episode["steps"])
            found = {topic: message_at(topic, stamp_ns) for topic, (stamp_ns, _) in wanted.items()}
            said.append(
                {t: (m.header.stamp.to_nsec(), bytes_of_message(m)) for t, m in found.items()}
            )
        return said


@pytest.mark.parametrize("name", ["RowFollow", "RowFollowCamera", "HeadlandTurn", "GoTo"])
def test_an_episode_has_the_same_bytes_on_the_node(
    graph: RosGraph, tmp_path: pathlib.Path, name: str
) -> None:
    env = gymnasium.make(f"ardee/{name}-v0", seed_field=False, **SMALL.get(name, {})).unwrapped
    try:
        _, info = env.reset(seed=5, options={"noise_seed": 0})  # with which a robot is spawned
        sown, seed = env._sown, info["replay"]["start_seed"]
        rng = np.random.default_rng(np.random.SeedSequence(seed))
        start = env._task.start(sown, rng)
        begin_ns = env.simulation.time_ns
        said: Said = []
        for number in range(STEPS):
            _, _, terminated, *_ = env.step(np.divide(to_and_fro(number), env._limits))
            assert not terminated
            readings = {topic: env.simulation.latest(topic) for topic in env._task.topics}
            said.append({t: (r.stamp_ns, bytes_of_reading(r)) for t, r in readings.items()})
        urdf = (env._source.folder / "robot.urdf").read_text()
        height_m = sown.trial.height_m(start) + env._robot.rise_m
        world, models = sown.trial.world, sown.trial.models
        episode = {
            "simulator": (world, 0, models, tmp_path / "simulator.log"),
            "robot": (urdf, start, height_m),
            "settle_steps": round(begin_ns / env.simulation.step_ns),
            "steps": env._steps,
            "topics": env._task.topics,
            "said": said,
        }
        assert graph.call(on_the_node, episode, timeout_s=120.0) == said
    finally:
        env.close()
    for topic in episode["topics"]:
        assert len({each[topic] for each in said}) == STEPS
