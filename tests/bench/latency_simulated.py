# SPDX-License-Identifier: MIT
"""Measures the bridge on the sensors of a simulated robot: from a message's arrival at a ROS socket to its datagram's.

Both times are the kernel's: the first is that of a captured packet, the second the receiver's. A message is found
again by its stamp, which the wire carries as a time stamp message.
"""
import contextlib
import dataclasses
import os
import time
from pathlib import Path
from typing import Any, Dict, Iterator, List

import rosgraph
from bench import capture, latency, latency_floor
from bench.capture import Times

from ardee_bridge.nodes.settings import FRAME_KINDS, KINDS, Source
from ardee_bridge.wire import codec
from ardee_bridge.wire.pairing import Pairer
from ardee_common.process import start_child, stop_child

START_LIMIT_S = 120.0
WARM_UP_S = 6.0  # long enough even beside programs that keep all processors busy
WORLD = ("roslaunch", "ardee_world", "custom_world.launch")
SENSORS = Path(__file__).resolve().with_name("benchmark_sensors.urdf.xacro")
ROBOT = ("roslaunch", "terrasentia_description", "launch_default_tsv1.launch", "use_rviz:=false")


@contextlib.contextmanager
def _launched(env: Dict[str, str], *command: str) -> Iterator[None]:
    child = start_child(command, env)
    try:
        yield
    finally:
        stop_child(child)


def _wait_for(env: Dict[str, str], name: str) -> None:
    """Waits until this node is registered."""
    master = rosgraph.Master("/latency", env["ROS_MASTER_URI"])
    deadline = time.monotonic() + START_LIMIT_S
    while True:
        with contextlib.suppress(rosgraph.MasterError):
            master.lookupNode(name)
            return
        if time.monotonic() > deadline:
            raise TimeoutError(f"{name} does not start")
        time.sleep(0.2)


def _arrivals(kept: List[latency.Datagram]) -> Dict[latency.Key, Times]:
    """Returns arrivals of each sensor's messages by time stamp; for frames, that of the last chunk."""
    pairer, stamps = Pairer(), {}  # type: Pairer, Dict[latency.Key, int]
    arrivals = {}  # type: Dict[latency.Key, Times]
    for datagram in kept:
        message = pairer.feed("server", datagram.data(), datagram.at_ns * 1e-9)
        if message is None:
            continue
        key = (message.header.data_type, message.header.component_id)
        if message.header.data_type == codec.DataType.TIME:
            time_of = codec.TimeStamp.unpack(message.data)
            key = (time_of.data_type, time_of.component_id)
            stamps[key] = time_of.sec * 10**9 + time_of.nsec
        elif key in stamps and not latency.is_followed(message):
            arrivals.setdefault(key, {})[stamps.pop(key)] = datagram.at_ns
    return arrivals


def receive(pipe: Any) -> None:
    """Runs as the receiver: reports its port, receives until told to end, then reports the arrivals."""
    kept = latency.receive_datagrams(pipe)
    pipe.send(_arrivals(kept))


def _within(stamps: Times, begin_ns: int, end_ns: int) -> Times:
    return {stamp: at_ns for stamp, at_ns in stamps.items() if begin_ns <= at_ns <= end_ns}


def _spread(published: List[Times], arrived: List[Times]) -> latency.Spread:
    """Returns the spread of a kind of sensor over its components, from the first to the last message of both ends."""
    found, sent = [], 0
    for before, after in zip(published, arrived):
        both = sorted(before.keys() & after.keys())
        if both:
            sent += sum(both[0] <= stamp <= both[-1] for stamp in before)
            found += [after[stamp] - before[stamp] for stamp in both]
    return latency.spread(found, sent)


def _topic(source: Source) -> str:
    """Returns the topic that the sensor server reads: the robot's cameras compress their images themselves."""
    return "/" + (source.of_camera() if source.format == "jpeg" else source).topic


def _await_topics(env: Dict[str, str], topics: List[str], reader: str = "") -> None:
    """Waits until all of these are published or, if a reader is named, until it has subscribed to them."""
    master = rosgraph.Master("/latency", env["ROS_MASTER_URI"])
    deadline = time.monotonic() + START_LIMIT_S
    missing = set(topics)
    while missing:
        published, subscribed, _ = master.getSystemState()
        listed = subscribed if reader else published
        missing -= {topic for topic, nodes in listed if not reader or reader in nodes}
        if missing and time.monotonic() > deadline:
            verb = f"{reader} does not read" if reader else "the simulated robot does not publish"
            raise TimeoutError(f"{verb} {', '.join(sorted(missing))}")
        time.sleep(0.2)


def measure(seconds: float, image_format: str, sources: List[Source]) -> Dict[str, latency.Spread]:
    """Measures a TerraSentia v3 in corn: all small sensors, and its cameras if a format of their images is given.

    Measures the bare forwarder at the same time.
    """
    sources = [
        dataclasses.replace(source, format=image_format) if source.format == "jpeg" else source
        for source in sources
        if image_format or source.kind not in FRAME_KINDS
    ]
    with contextlib.ExitStack() as stack:
        env = stack.enter_context(latency.own_master())
        floor = stack.enter_context(latency_floor.running())
        receiver, from_receiver = latency.in_process(env, receive)
        wanted = "[all, time]" if image_format else "[imu, gps, lidar, encoder, battery, time]"
        peer = f"{{address: 127.0.0.1, port: {latency.hear(from_receiver, START_LIMIT_S)}, data_types: {wanted}}}"
        stack.enter_context(
            _launched(
                env,
                *WORLD,
                "world:=scenario_2_corn.world",
                "headless:=true",
                "realtime_priority:=1",
            )
        )
        _wait_for(env, "/gazebo")  # a second roslaunch needs the run id of the first
        carried = f"sensors:={SENSORS}"
        robot = (*ROBOT, "bot_model:=tsv3_default.urdf.xacro", carried)
        stack.enter_context(_launched(env, *robot))
        topics = {source.name: _topic(source) for source in sources}
        _await_topics(env, list(topics.values()))
        # The nodes of all masters share the loopback that packets are captured on.
        name = f"/latency_server_{os.getpid()}"
        watcher, from_watcher = latency.in_process(env, capture.watch, name)
        said = latency.hear(from_watcher, START_LIMIT_S)
        if said != "listening":
            raise OSError(f"packets cannot be captured: {said}")
        server = latency.server_arguments(peer, sources)
        named = f"__name:={name[1:]}"
        stack.enter_context(latency.node(env, "sensor_server_node", named, *server))
        _await_topics(env, list(topics.values()), name)
        time.sleep(WARM_UP_S)
        begin_ns = time.time_ns()
        end_ns = begin_ns + round(seconds * 1e9)
        time.sleep(seconds + latency.SETTLE_S)
        bare = floor(begin_ns, end_ns)
        watched = latency.answer(watcher, from_watcher, "end", START_LIMIT_S)
        unread = [topic for topic in topics.values() if topic not in watched]
        if unread:
            raise TimeoutError(f"{name} does not read {', '.join(unread)}")
        time.sleep(latency.SETTLE_S)
        patience_s = START_LIMIT_S + seconds
        arrived = latency.answer(receiver, from_receiver, "at once", patience_s)
    published = {name: _within(watched[topic], begin_ns, end_ns) for name, topic in topics.items()}
    found = _by_row(sources, published, arrived)
    return {**found, latency_floor.NAME: bare}


def _by_row(
    sources: List[Source], published: Dict[str, Times], arrived: Dict[latency.Key, Times]
) -> Dict[str, latency.Spread]:
    found = {}
    for row in dict.fromkeys(latency.row_of(s.kind, s.format) for s in sources):
        like = [s for s in sources if latency.row_of(s.kind, s.format) == row]
        before = [published[source.name] for source in like]
        keys = [(int(KINDS[source.kind]), source.component_id) for source in like]
        found[row] = _spread(before, [arrived.get(key, {}) for key in keys])
    return found
