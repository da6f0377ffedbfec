# SPDX-License-Identifier: MIT
"""Tests the sensor server on real sockets: the form of each ROS message on the wire, and its receivers."""
import io
import socket

import pytest
from PIL import Image as Picture
from sensor_msgs.msg import Image, Imu

from ardee_bridge.nodes import convert
from ardee_bridge.nodes.counters import Counters
from ardee_bridge.nodes.sensor_server import RateLimit, SensorServer
from ardee_bridge.nodes.settings import ServerSettings
from ardee_bridge.wire import chunks, codec
from ardee_bridge.wire.pairing import Pairer
from ardee_bridge.wire.udp import open_socket
from ardee_common.config import from_values
from ardee_msgs.msg import Battery

D = codec.DataType
VALUES = dict(
    bind_address="127.0.0.1",
    port=0,
    allowed_clients=["127.0.0.1"],
    max_clients=2,
    client_lease_s=30.0,
    multicast_ttl=1,
)
SOURCES = [
    dict(name="imu", kind="imu", topic="imu"),
    dict(name="gps", kind="gps", topic="gps"),
    dict(name="fast", kind="battery", topic="battery"),
    dict(name="slow", kind="battery", topic="battery", component_id=1, max_rate_hz=10),
    dict(name="camera", kind="image", topic="image", format="raw", chunk_bytes=256),
]


class Bench:
    """Server with a clock that the test sets, and sockets that listen."""

    def __init__(self, peers=(), **values):
        self.now_s, self.sockets, self.changes = 0.0, [], 0
        self.settings = from_values(
            ServerSettings, dict(VALUES, sources=SOURCES, peers=list(peers), **values)
        )
        self.server_socket = open_socket("127.0.0.1", 0)
        self.counters = Counters(lambda text: None)
        self.server = SensorServer(
            self.settings, self.server_socket, self.counters, self._changed, lambda: self.now_s
        )

    def _changed(self):
        self.changes += 1

    def listen(self, address="127.0.0.1"):
        made = open_socket(address, 0)
        made.settimeout(5.0)
        self.sockets.append(made)
        return made

    def ask(self, client, types, **more):
        for datagram in codec.encode_set_port(types, **more):
            client.sendto(datagram, self.server_socket.getsockname())
        self.server.receive(0.05)

    def publish(self, name, message):
        source = next(source for source in self.settings.sources if source.name == name)
        self.server.publish(source, message)

    def close(self):
        for opened in self.sockets + [self.server_socket]:
            opened.close()


def receive(client, count=1):
    """Returns the next messages: (header, data)."""
    pairer, found = Pairer(), []
    while len(found) < count:
        message = pairer.feed("s", client.recv(65535), 0.0)
        if message:
            found.append(message)
    return found


def nothing_came(client):
    client.setblocking(False)
    try:
        client.recv(65535)
    except BlockingIOError:
        return True
    finally:
        client.settimeout(5.0)
    return False


def acked(client):
    return receive(client)[0].header.msg_type == codec.MessageType.ACK


def test_clients_get_what_they_ask_for(bench):
    a, b = bench.listen(), bench.listen()
    bench.ask(a, [D.IMU])
    bench.ask(b, [D.BATTERY, D.TIME], component_id=1)
    assert acked(a) and acked(b) and bench.changes == 2
    assert bench.server.wanted() == {"imu", "slow"}
    stamped = Battery(voltage=12.5)
    stamped.header.stamp.secs, stamped.header.stamp.nsecs = 7, 25
    bench.publish("imu", Imu())
    bench.publish("fast", stamped)
    bench.publish("slow", stamped)
    assert receive(a)[0].header.data_type == D.IMU and nothing_came(a)
    time, battery = receive(b, 2)
    stamp = codec.TimeStamp.unpack(time.data)
    assert stamp.as_dict() == dict(sec=7, nsec=25, data_type=D.BATTERY, component_id=1)
    assert battery.header.component_id == 1
    assert codec.BatteryData.unpack(battery.data).to_si().voltage == 12.5
    assert nothing_came(b)


def test_a_port_other_than_the_sender_s(bench):
    asker, listener = bench.listen(), bench.listen()
    bench.ask(asker, [D.ALL], port=listener.getsockname()[1], request_id=5)
    assert codec.Ack.unpack(receive(asker)[0].data).sequence == 5
    bench.publish("imu", Imu())
    assert receive(listener)[0].header.data_type == D.IMU


def test_a_client_that_falls_silent_is_forgotten(bench):
    client = bench.listen()
    bench.publish("imu", Imu())
    bench.ask(client, [D.ALL])
    bench.now_s = 29.0
    bench.ask(client, [D.ALL])
    bench.now_s = 58.0
    bench.server.receive(0.0)
    assert len(bench.server.clients()) == 1
    bench.publish("imu", Imu())
    assert acked(client) and acked(client) and receive(client)[0].header.data_type == D.IMU
    bench.now_s = 59.1
    bench.server.receive(0.0)
    assert bench.server.clients() == () and bench.server.wanted() == set()
    bench.publish("imu", Imu())
    assert nothing_came(client)


def test_whoever_is_acked_has_what_he_asked_for_from_then_on(bench, monkeypatch):
    client, send = bench.listen(), bench.server._send
    bench.publish("imu", Imu())

    def send_and_publish(address, datagrams):
        send(address, datagrams)
        monkeypatch.setattr(bench.server, "_send", send)
        bench.publish("imu", Imu())  # another thread's message, right after the Ack

    for wanted, expected in (([D.ALL], [D.NONE, D.IMU]), ([], [D.NONE])):
        monkeypatch.setattr(bench.server, "_send", send_and_publish)
        bench.ask(client, wanted)
        found = receive(client, len(expected))
        assert [message.header.data_type for message in found] == expected
        assert nothing_came(client)


def test_a_client_may_leave_and_places_are_bounded(bench):
    a, b, c = bench.listen(), bench.listen(), bench.listen()
    for client in (a, b, c):
        bench.ask(client, [D.ALL])
    assert len(bench.server.clients()) == 2
    assert bench.counters.dropped() == {"requests: too many clients": 1}
    bench.ask(a, [])
    bench.ask(c, [D.ALL])
    assert {t.address for t in bench.server.clients()} == {b.getsockname(), c.getsockname()}


def test_a_configured_peer_stays_and_may_choose_anew():
    probe = open_socket("127.0.0.1", 0)
    probe.settimeout(5.0)
    address = probe.getsockname()
    bench = Bench(peers=[dict(address=address[0], port=address[1], data_types=["imu"])])
    bench.publish("imu", Imu())
    assert receive(probe)[0].header.data_type == D.IMU
    bench.ask(probe, [])
    assert acked(probe)
    bench.publish("imu", Imu())
    bench.now_s = 1e6
    bench.server.receive(0.0)
    assert nothing_came(probe) and len(bench.server.clients()) == 1
    bench.close()
    probe.close()


@pytest.mark.parametrize(
    "datagrams, reason",
    [
        (codec.encode_motion(1, 0), "requests: not SET_PORT"),
        (codec.encode_set_port([D.ALL], port=70000), "requests: malformed SET_PORT"),
        (codec.encode_set_port([D.ALL], component_id=-2), "requests: malformed SET_PORT"),
        ((b"x" * 12,), "requests: data without header"),
        ((codec.Header(msg_type=-9).pack(),), "requests: unknown or invalid header"),
    ],
)
def test_bad_requests_are_counted(bench, datagrams, reason):
    client = bench.listen()
    for datagram in datagrams:
        client.sendto(datagram, bench.server_socket.getsockname())
    bench.server.receive(0.05)
    assert bench.server.clients() == () and bench.counters.dropped()[reason] == 1


def test_strangers_get_nothing(bench):
    stranger = bench.listen("127.0.0.9")
    bench.ask(stranger, [D.ALL])
    assert bench.server.clients() == ()
    assert bench.counters.dropped() == {"requests: sender not allowed": 2}


def test_multicast_and_broadcast():
    listener = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    listener.bind(("0.0.0.0", 0))
    listener.settimeout(5.0)
    member = socket.inet_aton("239.7.7.7") + socket.inet_aton("127.0.0.1")
    listener.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, member)
    port = listener.getsockname()[1]
    for address in ("239.7.7.7", "127.255.255.255"):
        bench = Bench(peers=[dict(address=address, port=port, data_types=["imu"])])
        bench.publish("imu", Imu())
        assert receive(listener)[0].header.data_type == D.IMU, bench.counters.dropped()
        bench.close()
    listener.close()


def test_an_unreachable_peer_is_counted_and_the_others_get_theirs(bench):
    client = bench.listen()
    bench.ask(client, [D.BATTERY])
    assert acked(client)
    far = ("203.0.113.1", 9)  # the socket is bound to loopback: the system refuses
    bench.server._targets = {
        far: bench.server.clients()[0]._replace(address=far),
        **bench.server._targets,
    }
    bench.publish("fast", Battery())
    assert receive(client)[0].header.data_type == D.BATTERY
    assert bench.counters.dropped() == {"messages that could not be sent": 1}


def test_rate_limit_is_exact_in_the_mean_and_survives_a_reset():
    limit = RateLimit(30.0)
    admitted = sum(limit.admits(0.01 * step) for step in range(10_000))
    assert admitted == 3000
    assert limit.admits(0.0)
    assert all(RateLimit(0.0).admits(0.0) for _ in range(3))


def test_rate_limit_lets_messages_without_a_time_through():
    limit = RateLimit(10.0)
    assert all(limit.admits(0.0) for _ in range(5))
    assert [limit.admits(stamp_s) for stamp_s in (1.0, 1.05, 1.1)] == [True, False, True]


@pytest.mark.parametrize(
    "types, component_id, named",
    [
        ([D.GYRO, D.IMU], codec.ALL_COMPONENTS, "gyro"),
        ([D.BATTERY], 7, "battery"),
        ([D.ALL], 7, "all"),
        ([D.FRONT_CAM, D.LIDAR, D.TIME], codec.ALL_COMPONENTS, "lidar, front_cam"),
        ([D.BATTERY, D.TIME], 1, None),
        ([D.ALL, D.TIME], codec.ALL_COMPONENTS, None),
        ([], codec.ALL_COMPONENTS, None),
    ],
)
def test_a_request_for_what_no_source_sends_is_named(bench, types, component_id, named):
    said = []
    bench.counters = Counters(said.append)
    bench.server = SensorServer(bench.settings, bench.server_socket, bench.counters)
    client = bench.listen()
    bench.ask(client, types, component_id=component_id)
    assert receive(client)[0].header.msg_type == codec.MessageType.ACK
    where = "127.0.0.1:%d" % client.getsockname()[1]
    expected = f"dropped 1: requests: sensors that no source sends, {where}: {named}"
    assert said == ([expected] if named else [])


# -- images


def picture(encoding="rgb8", width=40, height=30, pixel_bytes=3, pad=2):
    message = Image(encoding=encoding, width=width, height=height, step=width * pixel_bytes + pad)
    message.data = bytes((x + y) % 251 for y in range(height) for x in range(message.step))
    return message


def test_raw_image_through_the_wire(bench):
    client = bench.listen()
    bench.ask(client, [D.IMAGE])
    assert acked(client)
    message = picture()
    bench.publish("camera", message)
    assembler, whole = chunks.Assembler(), None
    while whole is None:
        whole = assembler.feed(*receive(client)[0])
    assert whole.payload == message.data
    assert (whole.head.width, whole.head.height, whole.head.step) == (40, 30, 122)
    assert whole.head.encoding == codec.ImageEncoding.RGB8 and whole.head.chunk.count == 15


def test_an_image_of_many_chunks_goes_to_all_that_can_be_reached(bench):
    clients = [bench.listen(), bench.listen()]
    for client in clients:
        bench.ask(client, [D.IMAGE])
        assert acked(client)
    far = ("203.0.113.1", 9)  # the socket is bound to loopback: the system refuses
    bench.server._targets = {
        far: bench.server.clients()[0]._replace(address=far),
        **bench.server._targets,
    }
    message = picture(height=100)
    bench.publish("camera", message)
    for client in clients:
        messages = receive(client, 48)
        assert [codec.ImageChunk.unpack(data[:44]).chunk.index for _, data in messages] == list(
            range(48)
        )
        assert b"".join(data[44:] for _, data in messages) == message.data and nothing_came(client)
    assert bench.counters.dropped() == {"messages that could not be sent": 48}


@pytest.mark.parametrize("encoding, first", [("rgb8", 0), ("bgr8", 2)])
def test_jpeg_has_the_right_colours(encoding, first):
    message = Image(encoding=encoding, width=32, height=32, step=96)
    pixel = [0, 0, 0]
    pixel[first] = 255  # red
    message.data = bytes(pixel) * 1024
    frame = convert.image(message, "jpeg", 90)
    assert frame.head.encoding == codec.ImageEncoding.JPEG
    red, green, blue = Picture.open(io.BytesIO(frame.payload)).convert("RGB").getpixel((16, 16))
    assert red > 240 and green < 15 and blue < 15


def test_depth_is_never_compressed():
    frame = convert.image(picture("32FC1", pixel_bytes=4, pad=0), "jpeg", 80)
    assert frame.head.encoding == codec.ImageEncoding.DEPTH_32F_M


@pytest.mark.parametrize(
    "change, message",
    [
        (dict(encoding="bayer_rggb8"), "encoding 'bayer_rggb8', expected one of rgb8"),
        (dict(height=31), "expected rows of 3 bytes a pixel"),
        (dict(step=10, data=b"0" * 300), "expected rows of 3 bytes a pixel"),
        (dict(data=b"", height=0), "expected rows"),
    ],
)
def test_malformed_images_are_refused(change, message):
    bad = picture()
    for name, value in change.items():
        setattr(bad, name, value)
    with pytest.raises(convert.ConvertError, match=message):
        convert.image(bad, "raw", 80)


def test_a_message_that_does_not_fit_is_counted_and_nothing_is_sent(bench):
    client = bench.listen()
    bench.ask(client, [D.ALL])
    assert acked(client)
    bench.publish("camera", picture("bayer_rggb8"))
    assert nothing_came(client)
    assert bench.counters.dropped() == {"sensor messages that the wire cannot carry": 1}
