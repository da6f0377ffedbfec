# SPDX-License-Identifier: MIT
"""Tests compressed images from the simulator's cameras to UDP: image_transport's, and those that the bridge takes."""
import io
import socket
import time
from typing import Any, Callable, Dict, Iterator, List, Tuple

import numpy as np
import probes
import pytest
from bridge_bench import free_port, start_in
from PIL import Image as Picture
from test_cameras import HEIGHT, WIDTH, sensor

from ardee_bridge.wire import codec
from ardee_bridge.wire.chunks import Assembler, Whole
from ardee_bridge.wire.pairing import Pairer
from ardee_bridge.wire.udp import open_socket
from ardee_common.ros_graph import Process, RosGraph, wait_until

COMPRESSED = "/fed/camera/compressed"
BOX = (
    '<model name="{name}"><static>true</static><pose>{pose} 0 0 0</pose><link name="link"><visual name="v">'
    "<geometry><box><size>1 {size} 1.2</size></box></geometry>"
    "<material><diffuse>{colour} 1</diffuse><ambient>{colour} 1</ambient></material></visual></link></model>"
)


def start_rig(graph: RosGraph) -> Process:
    """Starts a simulator with cameras that look at two boxes."""
    sensors = (
        sensor("color", "camera", "camera")
        + sensor("grey", "camera", "camera", pixel="L8")
        + sensor("depth", "depth_camera", "depth")
        + sensor(
            "kinect",
            "openni_kinect",
            "depth",
            "<useDepth16UC1Format>true</useDepth16UC1Format>",
        )
    )
    boxes = BOX.format(name="far", pose="3.5 1 0", size=3, colour="0.9 0.2 0.1")
    boxes += BOX.format(name="near", pose="2.5 -1.5 0.3", size=1, colour="0.1 0.3 0.8")
    file = graph.folder / "rig.world"
    file.write_text(
        f'<sdf version="1.6"><world name="default">{boxes}<model name="rig"><static>true</static>'
        f'<link name="mast">{sensors}</link></model></world></sdf>'
    )
    return graph.spawn("rosrun", "ardee_sim_cpp", "simulator", str(file))


def both_forms(topic: str) -> Tuple[Any, Any]:
    """Returns, as a probe, a raw and a compressed image of the same stamp."""
    import rospy
    from sensor_msgs.msg import CompressedImage, Image

    probes._start()
    kept = {}  # type: Dict[int, Dict[str, Any]]

    def keep(message: Any, form: str) -> None:
        kept.setdefault(message.header.stamp.to_nsec(), {})[form] = message

    rospy.Subscriber(topic, Image, keep, "raw")
    rospy.Subscriber(f"{topic}/compressed", CompressedImage, keep, "compressed")
    wait_until(lambda: any(len(forms) == 2 for forms in kept.values()), f"{topic} twice", 60.0)
    found = next(forms for forms in list(kept.values()) if len(forms) == 2)
    return found["raw"], found["compressed"]


@pytest.fixture(scope="module")
def rig(shared_graph: RosGraph) -> Process:
    """Yields the simulator of this file's tests of cameras."""
    shared_graph.run("rosparam", "set", "/rig/grey/image_raw/compressed/format", "gif")
    return start_rig(shared_graph)


def test_the_compressed_image_shows_what_the_raw_one_does(
    rig: Process, shared_graph: RosGraph
) -> None:
    raw, compressed = shared_graph.call(both_forms, "/rig/color/image_raw")
    assert compressed.format == "rgb8; jpeg compressed bgr8"
    assert compressed.header.frame_id == raw.header.frame_id == "rig/color_optical"
    truth = np.frombuffer(raw.data, np.uint8).reshape(HEIGHT, WIDTH, 3).astype(float)
    picture = Picture.open(io.BytesIO(compressed.data))
    assert picture.format == "JPEG" and picture.size == (WIDTH, HEIGHT)
    found = np.asarray(picture.convert("RGB"), float)
    assert np.ptp(truth) > 50.0
    assert np.abs(found - truth).mean() < 4.0


def test_depth_of_16_bits_is_a_png_without_loss(rig: Process, shared_graph: RosGraph) -> None:
    raw, compressed = shared_graph.call(both_forms, "/rig/kinect/depth/image_raw")
    assert (raw.encoding, compressed.format) == ("16UC1", "16UC1; png compressed ")
    found = np.asarray(Picture.open(io.BytesIO(compressed.data)))
    np.testing.assert_array_equal(found.ravel(), np.frombuffer(raw.data, np.uint16))
    assert np.ptp(found) > 500


def test_compressed_images_alone_have_the_camera_drawn(
    rig: Process, shared_graph: RosGraph
) -> None:
    kind = "sensor_msgs/CompressedImage"
    found = shared_graph.call(probes.collect, "/rig/color/image_raw/compressed", kind, 3)
    assert len({message.header.stamp.to_nsec() for message in found}) == 3


def test_raw_images_alone_are_not_compressed(rig: Process, shared_graph: RosGraph) -> None:
    """Uses an invalid format, which the first image to be compressed would report."""
    complaint = "/rig/grey/image_raw/compressed: found format 'gif', expected jpeg or png"
    shared_graph.call(probes.collect, "/rig/grey/image_raw", "sensor_msgs/Image", 10)
    assert complaint not in rig.output()
    listener = shared_graph.spawn("rostopic", "echo", "/rig/grey/image_raw/compressed")
    wait_until(lambda: complaint in rig.output(), "the complaint")
    shared_graph.run(
        "rosrun",
        "dynamic_reconfigure",
        "dynparam",
        "set",
        "/rig/grey/image_raw/compressed",
        "format",
        "jpeg",
    )
    wait_until(lambda: "mono8; jpeg compressed" in listener.output(), "a grey JPEG")
    assert rig.output().count(complaint) == 1
    listener.stop()


def test_depth_in_metres_is_refused_once(rig: Process, shared_graph: RosGraph) -> None:
    topic = "/rig/depth/depth/image_raw"
    listener = shared_graph.spawn("rostopic", "echo", f"{topic}/compressed")
    wait_until(lambda: "encoding '32FC1', expected mono8" in rig.output(), "the complaint")
    shared_graph.call(probes.collect, topic, "sensor_msgs/Image", 10)
    assert rig.output().count(f"{topic}/compressed: found") == 1
    assert "format:" not in listener.output()
    listener.stop()


def test_subscribers_of_image_transport_read_it(rig: Process, shared_graph: RosGraph) -> None:
    """Uses `republish`, which makes raw images of the compressed ones of the same stamps."""
    arguments = ("compressed", "in:=/rig/color/image_raw", "raw", "out:=/again")
    republish = shared_graph.spawn("rosrun", "image_transport", "republish", *arguments)
    image = shared_graph.call(probes.collect, "/again", "sensor_msgs/Image", 1)[0]
    raw = shared_graph.call(probes.collect, "/rig/color/image_raw", "sensor_msgs/Image", 1)[0]
    assert (image.encoding, image.width, image.height) == ("rgb8", WIDTH, HEIGHT)
    found, truth = (np.frombuffer(each.data, np.uint8).astype(float) for each in (image, raw))
    assert np.abs(found - truth).mean() < 8.0  # noise of two pictures of a scene at rest
    republish.stop()


# -- the bridge


def jpeg_of(stamp_ns: int) -> bytes:
    """Returns a JPEG file that no other stamp has: readers ignore bytes after its end."""
    opened = io.BytesIO()
    Picture.new("RGB", (64, 48), (200, 40, 90)).save(opened, "JPEG")
    return opened.getvalue() + stamp_ns.to_bytes(8, "little")


def _publish(pipe: Any, has_compressed: bool, name: str) -> None:
    import rospy
    from sensor_msgs.msg import CompressedImage, Image

    rospy.init_node(name, disable_signals=True, disable_rostime=True)
    raw = rospy.Publisher("/fed/camera", Image, queue_size=5)
    compressed = None
    if has_compressed:
        compressed = rospy.Publisher("/fed/camera/compressed", CompressedImage, queue_size=5)
    image = Image(encoding="rgb8", width=32, height=24, step=96, data=bytes(range(96)) * 24)
    while not pipe.poll():
        image.header.stamp = rospy.Time.from_sec(time.time())
        raw.publish(image)
        if compressed:
            message = CompressedImage(format="jpeg", data=jpeg_of(image.header.stamp.to_nsec()))
            message.header.stamp = image.header.stamp
            compressed.publish(message)
        time.sleep(0.03)


def publish_raw(pipe: Any) -> None:
    """Runs as a camera without compression."""
    _publish(pipe, False, "camera")


def publish_both(pipe: Any) -> None:
    """Runs as a camera that compresses."""
    _publish(pipe, True, "camera")


class Client:
    """Asks a sensor server for images, and keeps all that arrive."""

    def __init__(self, port: int) -> None:
        self.frames: List[Whole] = []
        self._port, self._pairer, self._assembler = port, Pairer(), Assembler()
        self._socket, self._asked_s = open_socket("127.0.0.1", 0), 0.0

    def take(self) -> None:
        """Repeats its request now and then, and takes arrived messages."""
        if time.monotonic() - self._asked_s > 1.0:
            self._asked_s = time.monotonic()
            for datagram in codec.encode_set_port([codec.DataType.IMAGE]):
                self._socket.sendto(datagram, ("127.0.0.1", self._port))
        while True:
            try:
                datagram = self._socket.recv(65535, socket.MSG_DONTWAIT)
            except BlockingIOError:
                return
            message = self._pairer.feed("server", datagram, time.monotonic())
            if message and message.header.data_type == codec.DataType.IMAGE:
                whole = self._assembler.feed(message.header, message.data)
                self.frames += [whole] if whole else []

    def wait_for(self, is_wanted: Callable[[Whole], bool], count: int = 10) -> List[Whole]:
        """Waits for this many more frames of a kind."""
        before = len(self.frames)

        def found() -> List[Whole]:
            self.take()
            return [frame for frame in self.frames[before:] if is_wanted(frame)]

        wait_until(lambda: len(found()) >= count, f"{count} images", 60.0)
        return found()

    def close(self) -> None:
        self._socket.close()


def stamp_ns(frame: Whole) -> int:
    """Returns the stamp of the image [ns]."""
    return frame.head.chunk.sec * 10**9 + frame.head.chunk.nsec


def is_of_camera(frame: Whole) -> bool:
    """Returns whether the camera compressed this image."""
    return frame.head.encoding == codec.ImageEncoding.JPEG and frame.head.width == 64


def is_of_server(frame: Whole) -> bool:
    """Returns whether the server compressed this image."""
    return frame.head.encoding == codec.ImageEncoding.JPEG and frame.head.width == 32


@pytest.fixture
def client(graph: RosGraph) -> Iterator[Client]:
    """Returns a client of a server whose only source is the camera."""
    port = free_port()
    source = "{name: camera, kind: image, topic: /fed/camera, component_id: 2}"
    settings = (f"_port:={port}", "_peers:=[]", f"_sources:=[{source}]")
    graph.spawn("rosrun", "ardee_bridge", "sensor_server_node", *settings)
    made = Client(port)
    yield made
    made.close()


def test_the_camera_s_bytes_arrive(graph: RosGraph, client: Client) -> None:
    publisher, pipe = start_in(graph, publish_both)
    for frame in client.wait_for(is_of_camera, 20):
        assert frame.payload == jpeg_of(stamp_ns(frame))
        assert (frame.head.width, frame.head.height, frame.component_id) == (64, 48, 2)
    assert not any(is_of_server(frame) for frame in client.frames)
    assert not is_read(graph, "/fed/camera")
    finish(publisher, pipe)


def test_publishers_that_come_and_go(graph: RosGraph, client: Client) -> None:
    publisher, pipe = start_in(graph, publish_raw)
    client.wait_for(is_of_server)
    for end in (kill, finish):
        end(publisher, pipe)
        publisher, pipe = start_in(graph, publish_both)  # the same node, like a restarted simulator
        client.wait_for(is_of_camera)
        assert all(map(is_of_camera, client.wait_for(bool)))
    kill(publisher, pipe)
    publisher, pipe = start_in(graph, publish_raw)
    client.wait_for(is_of_server)
    finish(publisher, pipe)
    stamps = [stamp_ns(frame) for frame in client.frames]
    assert len(set(stamps)) == len(stamps) > 50 and stamps == sorted(stamps)


def kill(publisher: Any, _: Any) -> None:
    """Kills the process, as a crash would."""
    publisher.kill()
    publisher.join(20.0)


def finish(publisher: Any, pipe: Any) -> None:
    """Ends the process normally; it tells the master."""
    pipe.send("end")
    publisher.join(20.0)
    assert publisher.exitcode == 0


def test_a_compressing_node_beside_the_camera_comes_and_goes(
    graph: RosGraph, client: Client
) -> None:
    camera, camera_pipe = start_in(graph, publish_raw)
    client.wait_for(is_of_server)
    arguments = ("raw", "in:=/fed/camera", "compressed", "out:=/fed/camera")
    for _ in range(2):
        republish = graph.spawn("rosrun", "image_transport", "republish", *arguments)
        wait_until(
            lambda: client.take() or is_read(graph, COMPRESSED),
            "the server reads what it compresses",
        )
        client.wait_for(is_of_server, 20)
        republish.stop()
        wait_until(
            lambda: client.take() or not is_read(graph, COMPRESSED), "raw ones are read again"
        )
        client.wait_for(is_of_server, 20)
    finish(camera, camera_pipe)
    stamps = [stamp_ns(frame) for frame in client.frames]
    assert len(set(stamps)) == len(stamps)


def is_read(graph: RosGraph, topic: str) -> bool:
    """Returns whether the server is subscribed to the topic."""
    return f" * {topic} [" in graph.run("rosnode", "info", "/sensor_server_node")
