# SPDX-License-Identifier: MIT
"""Measures the bridge on loopback: how long messages take, and whether any is lost.

Sensor messages carry a running number in a field that survives the wire; a datagram's time is the kernel's, of its
arrival at the receiver's socket. Nodes, publishers and receivers are processes of their own, around a ROS master of
their own.
"""
import contextlib
import json
import math
import os
import select
import signal
import socket
import subprocess
import time
from multiprocessing import get_context
from typing import Any, Callable, Dict, Iterator, List, NamedTuple, Sequence, Tuple, Union

from ardee_bridge import codec, witness
from ardee_bridge.pairing import Message, Pairer
from ardee_bridge.settings import KINDS, Source
from ardee_bridge.udp import open_socket

MASTER = (
    "import sys, rosmaster.master as m; x = m.Master(0); x.start();"
    "print(x.uri, flush=True); sys.stdin.read(); x.stop()"
)
START_LIMIT_S = 30.0
# Time for the last messages to arrive.
SETTLE_S = 0.5
# Nothing for so long: no message is on its way any more, however busy the machine.
SILENCE_S = 3.0
# Larger datagrams are parts of frames, of which only the head is looked at.
CHUNKED = (codec.ImageChunk, codec.PointCloudChunk)
KEPT_WHOLE_BYTES, KEPT_BYTES = 16384, 64

Key = Tuple[int, int]  # data type, component id
Times = Dict[Key, List[int]]  # ns of the messages in their order


class Stream(NamedTuple):
    """A sensor: kind, topic, component id, rate, format of images."""

    kind: str
    topic: str
    component_id: int
    rate_hz: float
    image_format: str = ""

    @property
    def key(self) -> Key:
        return (int(KINDS[self.kind]), self.component_id)


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
    """Its three cameras, and what it may carry besides."""
    return (
        Stream("image", "/bench/camera/front", 0, 30.0, image_format),
        Stream("image", "/bench/camera/left", 1, 30.0, image_format),
        Stream("image", "/bench/camera/right", 2, 30.0, image_format),
        Stream("image", "/bench/depth", 3, 10.0, "raw"),
        Stream("point_cloud", "/bench/points", 0, 10.0),
    )


def row_of(kind: str, image_format: str) -> str:
    """In the table: kind of sensor, of images the format too."""
    return f"{image_format} {kind}" if image_format else kind


class Datagram(NamedTuple):
    """What came, of a large one only the beginning; its size, and when [ns]."""

    beginning: bytes
    size: int
    at_ns: int

    def data(self) -> bytes:
        """All of it; what was not kept is zero."""
        return self.beginning.ljust(self.size, b"\0")


class Spread(NamedTuple):
    """Latencies [ms], and how many messages were sent and lost."""

    p50_ms: float
    p99_ms: float
    max_ms: float
    sent: int
    lost: int


def spread(latencies_ns: Sequence[int], sent: int) -> Spread:
    """Percentiles by the nearest rank."""
    ordered = sorted(latencies_ns)
    if not ordered:
        return Spread(math.nan, math.nan, math.nan, sent, sent)

    def at(share: float) -> float:
        return ordered[max(0, math.ceil(share * len(ordered)) - 1)] / 1e6

    return Spread(at(0.5), at(0.99), ordered[-1] / 1e6, sent, sent - len(ordered))


@contextlib.contextmanager
def own_master() -> Iterator[Dict[str, str]]:
    """Environment of a ROS master of one's own."""
    env = dict(os.environ, ROS_IP="127.0.0.1")
    env.pop("ROS_HOSTNAME", None)
    with subprocess.Popen(
        ["/usr/bin/python3", "-c", MASTER],
        env=env,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
        start_new_session=True,
    ) as master:
        try:
            yield dict(env, ROS_MASTER_URI=master.stdout.readline().strip())
        finally:
            master.stdin.close()


@contextlib.contextmanager
def node(env: Dict[str, str], name: str, *parameters: str) -> Iterator[subprocess.Popen]:
    """A node of this package while the block runs."""
    command = ["rosrun", "ardee_bridge", name, *parameters]
    process = subprocess.Popen(
        command,
        env=env,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    try:
        yield process
    finally:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGINT)
        _, complaints = process.communicate(timeout=START_LIMIT_S)
        if process.returncode != 0:
            print(complaints)


def in_process(env: Dict[str, str], body: Callable[..., Any], *args: Any) -> Tuple[Any, Any]:
    """Start body(pipe, *args) in a process of its own: the process and our end of the pipe."""
    context = get_context("spawn")
    ours, theirs = context.Pipe()
    process = context.Process(target=_enter, args=(env, body, theirs, args), daemon=True)
    process.start()
    theirs.close()
    return process, ours


def _enter(env: Dict[str, str], body: Callable[..., Any], pipe: Any, args: Tuple[Any, ...]) -> None:
    os.environ.update(env)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    body(pipe, *args)


def hear(pipe: Any, limit_s: float) -> Any:
    """What a process says."""
    if not pipe.poll(limit_s):
        raise TimeoutError(f"a process of the benchmark said nothing for {limit_s} s")
    return pipe.recv()


def answer(process: Any, pipe: Any, limit_s: float) -> Any:
    """What a process says at its end."""
    said = hear(pipe, limit_s)
    process.join(START_LIMIT_S)
    return said


def is_followed(message: Message) -> bool:
    """Is it a chunk that is not its frame's last?"""
    kind = codec.data_struct(message.header)
    if kind not in CHUNKED:
        return False
    chunk = kind.unpack(message.data[: kind.size]).chunk
    return chunk.index < chunk.count - 1


def serial_of(header: codec.Header, data: bytes) -> int:
    """The running number that a message carries; -1 for a chunk that is not its frame's last."""
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


def receive_datagrams(pipe: Any) -> List[Datagram]:
    """Say one's port, receive until told to end, "at once" or when nothing comes any more: what came, and when [ns].

    The receiver is to be another computer, which has nothing else to do: it goes first here, where that is granted.
    """
    witness.go_first()
    opened = open_socket("127.0.0.1", 0)
    opened.setsockopt(socket.SOL_SOCKET, witness.SO_TIMESTAMPNS, 1)
    pipe.send(opened.getsockname()[1])
    room, kept, word = memoryview(bytearray(65535)), [], ""
    while word != "at once":
        if pipe.poll():
            word = pipe.recv()
        if not select.select([opened], [], [], SILENCE_S if word else 0.05)[0]:
            if word:
                break
            continue
        while True:
            try:
                size, extras, _, _ = opened.recvmsg_into([room], 256, socket.MSG_DONTWAIT)
            except BlockingIOError:
                break
            beginning = bytes(room[: size if size <= KEPT_WHOLE_BYTES else KEPT_BYTES])
            kept.append(Datagram(beginning, size, witness.timestamp_ns(extras) or 0))
    return kept


def receive_sensors(pipe: Any) -> None:
    """Body of the receiver, which then says when each message came."""
    pipe.send(_arrivals(receive_datagrams(pipe)))


def _arrivals(kept: List[Datagram]) -> Dict[Key, Dict[int, int]]:
    """(data type, component) -> running number -> ns."""
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
    """Body of a publisher: publishes at the streams' rates, says when each message was published, ends when told.

    It stands for a simulator whose `realtime_priority` is set.
    """
    import rospy

    from ardee_bridge import latency_messages
    from ardee_bridge.subscriptions import TYPES

    rospy.init_node("latency_source", anonymous=True, disable_signals=True, disable_rostime=True)
    messages = [latency_messages.make(stream.kind, stream.topic) for stream in streams]
    publishers = [
        rospy.Publisher(stream.topic, TYPES[stream.kind], queue_size=1000, tcp_nodelay=True)
        for stream in streams
    ]
    raw = {}  # type: Dict[int, Tuple[Any, Any]]
    for index, stream in enumerate(streams):
        if stream.image_format == "jpeg":  # as a camera's driver, which offers both
            raw[index] = publishers[index], messages[index]
            messages[index] = latency_messages.compressed(messages[index])
            publishers[index] = rospy.Publisher(
                f"{stream.topic}/compressed",
                type(messages[index]),
                queue_size=1000,
                tcp_nodelay=True,
            )
    deadline = time.monotonic() + START_LIMIT_S
    while not all(publisher.get_num_connections() for publisher in publishers):
        if time.monotonic() > deadline:
            raise TimeoutError("the sensor server does not subscribe")
        time.sleep(0.05)
    witness.go_first()
    times = {stream.key: [] for stream in streams}  # type: Times
    start = time.monotonic() + SETTLE_S
    due = [start + 0.37 * index / stream.rate_hz for index, stream in enumerate(streams)]
    while min(due) < start + seconds:
        index = due.index(min(due))
        stream = streams[index]
        time.sleep(max(0.0, due[index] - time.monotonic()))
        latency_messages.number(stream.kind, messages[index], len(times[stream.key]))
        times[stream.key].append(time.time_ns())
        publishers[index].publish(messages[index])
        if index in raw:
            raw[index][0].publish(raw[index][1])
        due[index] += 1.0 / stream.rate_hz
    pipe.send(times)
    pipe.recv()


def server_arguments(
    peer: str, sources: Sequence[Union[Stream, Source]], realtime_priority: int
) -> List[str]:
    """Parameters of a sensor server of these sources."""
    items = []
    for source in sources:
        values = dict(name=source.topic, kind=source.kind, topic=source.topic)
        values["component_id"] = source.component_id
        if source.image_format:
            values["format"] = source.image_format
        if isinstance(source, Source) and source.velocity_topic:
            values["velocity_topic"] = source.velocity_topic
        items.append(values)
    return [
        "_port:=0",
        f"_peers:=[{peer}]",
        f"_realtime_priority:={realtime_priority}",
        f"_sources:={json.dumps(items)}",
    ]


def measure_sensors(
    seconds: float, image_format: str = "", realtime_priority: int = 1
) -> Dict[str, Spread]:
    """Sensor message published -> data datagram arrived, of frames the last, by kind of sensor.

    With cameras where a format of their images is given.
    """
    groups = [SENSORS] + ([cameras(image_format)] if image_format else [])
    streams = [stream for group in groups for stream in group]
    with own_master() as env:
        receiver, from_receiver = in_process(env, receive_sensors)
        peer = f"{{address: 127.0.0.1, port: {from_receiver.recv()}, data_types: [all]}}"
        parameters = server_arguments(peer, streams, realtime_priority)
        with node(env, "sensor_server_node", *parameters):
            running = [in_process(env, publish_sensors, group, seconds) for group in groups]
            times = {}  # type: Times
            for _, pipe in running:
                times.update(hear(pipe, seconds + 2 * START_LIMIT_S))
            from_receiver.send("when nothing comes any more")
            arrivals = answer(receiver, from_receiver, 2 * START_LIMIT_S + seconds)
            for process, pipe in running:
                pipe.send("end")
                process.join(START_LIMIT_S)
    return _by_kind(streams, times, arrivals)


def _by_kind(
    streams: Sequence[Stream], times: Times, arrivals: Dict[Key, Dict[int, int]]
) -> Dict[str, Spread]:
    latencies, sent = {}, {}  # type: Dict[str, List[int]], Dict[str, int]
    for stream in streams:
        row = row_of(stream.kind, stream.image_format)
        published, arrived = times[stream.key], arrivals.get(stream.key, {})
        sent[row] = sent.get(row, 0) + len(published)
        latencies.setdefault(row, []).extend(
            arrived[serial] - at_ns for serial, at_ns in enumerate(published) if serial in arrived
        )
    return {row: spread(latencies[row], sent[row]) for row in sent}
