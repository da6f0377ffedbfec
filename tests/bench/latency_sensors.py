# SPDX-License-Identifier: MIT
"""Measures the sensor server on loopback with the benchmark's own messages, at the sensors' full rates."""
import time
import warnings
from typing import Any, Dict, List, Sequence, Tuple

from bench import latency_floor, priority
from bench.latency import (
    CHUNKED,
    SETTLE_S,
    START_LIMIT_S,
    Datagram,
    Key,
    Spread,
    Stream,
    answer,
    hear,
    in_process,
    node,
    own_master,
    receive_datagrams,
    row_of,
    server_arguments,
    spread,
)

from ardee_bridge.wire import codec
from ardee_bridge.wire.pairing import Pairer

Times = Dict[Key, List[int]]  # arrival [ns] of the messages in their order

# The full rates of the TerraSentia v3's sensors.
SENSORS = (
    Stream("imu", "/bench/imu", 0, 100.0),
    Stream("gps", "/bench/gps", 0, 20.0),
    Stream("lidar", "/bench/lidar", 0, 40.0),
    Stream("battery", "/bench/battery", 0, 100.0),
    Stream("encoder", "/bench/encoder/fr", 0, 100.0),
    Stream("encoder", "/bench/encoder/fl", 1, 100.0),
    Stream("encoder", "/bench/encoder/rr", 2, 100.0),
    Stream("encoder", "/bench/encoder/rl", 3, 100.0),
)


def cameras(image_format: str) -> Tuple[Stream, ...]:
    """Returns the robot's three cameras, and other sensors that it may carry."""
    return (
        Stream("image", "/bench/camera/front", 0, 30.0, image_format),
        Stream("image", "/bench/camera/left", 1, 30.0, image_format),
        Stream("image", "/bench/camera/right", 2, 30.0, image_format),
        Stream("image", "/bench/depth", 3, 10.0, "raw"),
        Stream("point_cloud", "/bench/points", 0, 10.0),
    )


def serial_of(header: codec.Header, data: bytes) -> int:
    """Returns the running number of a message; -1 for a chunk that is not its frame's last."""
    kind = codec.data_struct(header)
    raw = kind.unpack(data[: kind.size])
    if kind in CHUNKED:
        return raw.chunk.sequence if raw.chunk.index == raw.chunk.count - 1 else -1
    paths = {
        codec.IMUData: "accel.x",
        codec.GPSData: "altitude",
        codec.LidarData: "scan_time",
        codec.BatteryData: "vmin",
        codec.EncoderData: "id",
    }
    return raw.as_dict()[paths[kind]]


def receive_sensors(pipe: Any) -> None:
    """Runs as the receiver; reports when each message came."""
    pipe.send(_arrivals(receive_datagrams(pipe)))


def _arrivals(kept: List[Datagram]) -> Dict[Key, Dict[int, int]]:
    """Returns (data type, component) -> running number -> ns."""
    pairer, arrivals = Pairer(), {}  # type: Pairer, Dict[Key, Dict[int, int]]
    for datagram in kept:
        message = pairer.feed("server", datagram.data(), datagram.at_ns * 1e-9)
        if message is None:
            continue
        serial = serial_of(message.header, message.data)
        key = (message.header.data_type, message.header.component_id)
        if serial >= 0:
            arrivals.setdefault(key, {})[serial] = datagram.at_ns
    return arrivals


def publish_sensors(pipe: Any, streams: Sequence[Stream], seconds: float) -> None:
    """Runs as a publisher: publishes at the streams' rates until told to end; reports when each message was published.

    It stands for a simulator with `realtime_priority`. Its publishers have no queue: with one, rospy would write to
    the socket in a thread of its own without that priority.
    """
    import rospy
    from bench import latency_messages

    from ardee_bridge.nodes.subscriptions import TYPES

    warnings.simplefilter("ignore", SyntaxWarning)  # rospy warns of publishers without a queue
    rospy.init_node("latency_source", anonymous=True, disable_signals=True, disable_rostime=True)
    messages = [latency_messages.make(stream.kind, stream.topic) for stream in streams]
    publishers = [
        rospy.Publisher(stream.topic, TYPES[stream.kind], queue_size=None, tcp_nodelay=True)
        for stream in streams
    ]
    raw = {}  # type: Dict[int, Tuple[Any, Any]]
    for index, stream in enumerate(streams):
        if stream.format == "jpeg":  # a camera's driver offers both forms
            raw[index] = publishers[index], messages[index]
            messages[index] = latency_messages.compressed(messages[index])
            publishers[index] = rospy.Publisher(
                f"{stream.topic}/compressed",
                type(messages[index]),
                queue_size=None,
                tcp_nodelay=True,
            )
    deadline = time.monotonic() + START_LIMIT_S
    while not all(publisher.get_num_connections() for publisher in publishers):
        if time.monotonic() > deadline:
            raise TimeoutError("the sensor server does not subscribe")
        time.sleep(0.05)
    priority.hurry()
    priority.keep_memory()
    times = {stream.key: [] for stream in streams}  # type: Times
    start = time.monotonic() + SETTLE_S
    due = [start + 0.37 * index / stream.rate_hz for index, stream in enumerate(streams)]
    while min(due) < start + seconds:
        index = due.index(min(due))
        stream = streams[index]
        time.sleep(max(0.0, due[index] - time.monotonic()))
        latency_messages.number(stream.kind, messages[index], len(times[stream.key]))
        times[stream.key].append(publish_at(publishers[index], messages[index]))
        if index in raw:
            raw[index][0].publish(raw[index][1])
        due[index] += 1.0 / stream.rate_hz
    pipe.send(times)
    pipe.recv()


def publish_at(publisher: Any, message: Any) -> int:
    """Publishes; reports the time of the call [ns], so that making and writing the bytes count."""
    at_ns = time.time_ns()
    publisher.publish(message)
    return at_ns


def measure_sensors(seconds: float, image_format: str = "") -> Dict[str, Spread]:
    """Measures from publishing to the arrival of the data datagram, for frames the last one, by kind of sensor.

    Measures the bare forwarder at the same time. Includes cameras if a format of their images is given.
    """
    groups = [SENSORS] + ([cameras(image_format)] if image_format else [])
    streams = [stream for group in groups for stream in group]
    with own_master() as env, latency_floor.running() as floor:
        receiver, from_receiver = in_process(env, receive_sensors)
        peer = (
            f"{{address: 127.0.0.1, port: {hear(from_receiver, START_LIMIT_S)}, data_types: [all]}}"
        )
        parameters = server_arguments(peer, streams)
        with node(env, "sensor_server_node", *parameters):
            running = [in_process(env, publish_sensors, group, seconds) for group in groups]
            times = {}  # type: Times
            for _, pipe in running:
                times.update(hear(pipe, seconds + 2 * START_LIMIT_S))
            all_times = [at_ns for stream_times in times.values() for at_ns in stream_times]
            bare = floor(min(all_times), max(all_times))
            patience_s = 2 * START_LIMIT_S + seconds
            word = "when nothing comes any more"
            arrivals = answer(receiver, from_receiver, word, patience_s)
            for process, pipe in running:
                pipe.send("end")
                process.join(START_LIMIT_S)
    return {**_by_kind(streams, times, arrivals), latency_floor.NAME: bare}


def _by_kind(
    streams: Sequence[Stream], times: Times, arrivals: Dict[Key, Dict[int, int]]
) -> Dict[str, Spread]:
    latencies, sent = {}, {}  # type: Dict[str, List[int]], Dict[str, int]
    for stream in streams:
        row = row_of(stream.kind, stream.format)
        published, arrived = times[stream.key], arrivals.get(stream.key, {})
        sent[row] = sent.get(row, 0) + len(published)
        latencies.setdefault(row, []).extend(
            arrived[serial] - at_ns for serial, at_ns in enumerate(published) if serial in arrived
        )
    return {row: spread(latencies[row], sent[row]) for row in sent}
