# SPDX-License-Identifier: MIT
"""Targets of scripts/fuzz in this package: each takes any bytes and raises only findings."""
import socket
import tempfile
from pathlib import Path
from typing import Callable, Dict, Iterator, List, Tuple

from ardee_bridge.nodes.controls import ControlsClient, Motion
from ardee_bridge.nodes.counters import Counters
from ardee_bridge.nodes.settings import ControlSettings, ServerSettings
from ardee_bridge.wire import chunks, codec
from ardee_bridge.wire.pairing import MAX_SENDERS, Pairer
from ardee_bridge.wire.udp import open_socket
from ardee_common.config import build, from_values, read_yaml_lines
from ardee_common.errors import GeneratorError

_SHIPPED = Path(__file__).resolve().parents[1] / "config/controls_client.yaml"
_KINDS = tuple(codec.DATA_STRUCTS)
_STEP_S = 0.01
_FOLDER = tempfile.TemporaryDirectory(prefix="ardee_fuzz_")
_FILE = Path(_FOLDER.name) / "input.yaml"


def codec_of_all_structs(data: bytes) -> None:
    """Unpacks the bytes as the struct that the first byte selects, and packs it again in each way."""
    if not data:
        return
    kind = codec.STRUCTS[data[0] % len(codec.STRUCTS)]
    raw = kind.unpack(data[1 : 1 + kind.size].ljust(kind.size, b"\0"))
    _check(kind.unpack(raw.pack()) == raw, f"{raw}: packed and unpacked it is another")
    physical = raw.to_si()
    _check(physical.to_raw() == kind.unpack(physical.to_raw().pack()), f"{physical}: not packed")
    if isinstance(raw, codec.Header):
        codec.data_size(raw)
    if isinstance(raw, codec.LidarData):
        header = codec.Header(measurement_length=data[0] * 5)
        codec.ranges_m(header, raw)
        codec.reader_ranges_mm(header, raw)
        codec.range_counts(physical.ranges, physical.range_min, physical.range_max)


def _check(good: bool, text: str) -> None:
    if not good:
        raise AssertionError(text)


def _events(data: bytes) -> Iterator[Tuple[int, bytes]]:
    """Yields senders and their datagrams. Two bytes are an event: the sender, and the kind of datagram.

    0...99: a datagram of so many bytes, which follow. 100...199: header and data of one of the kinds, the data's
    bytes as far as they follow. 200...255: a motion command.
    """
    at = 0
    while at + 2 <= len(data):
        sender, what = data[at], data[at + 1]
        at += 2
        if what < 100:
            yield sender, data[at : at + what]
            at += what
        elif what < 200:
            kind = _KINDS[what % len(_KINDS)]
            header = codec.Header(
                component_id=sender,
                msg_type=kind[0],
                data_type=kind[1],
                measurement_type=what % 2,
                measurement_length=1 + what % 2 * 30,
            ).pack()
            size = codec.data_size(codec.Header.unpack(header)) or codec.DATA_STRUCTS[kind].size
            yield sender, header
            yield sender, data[at : at + size].ljust(size, b"\1")
            at += size
        else:
            motion = codec.MotionCommands(multiplier=100, normalized_speed=5 * (what - 228))
            motion.normalized_yaw_rate = sender - 100
            yield sender, codec.encode_motion(0.0, 0.0)[0]
            yield sender, motion.pack()


class _Bench:
    """Controls client with three peers and one stranger, kept for all inputs for the sake of speed."""

    def __init__(self) -> None:
        self.socket = open_socket("127.0.0.1", 0)
        self.senders = [open_socket("127.0.0.1", 0) for _ in range(4)]
        peers = [f"127.0.0.1:{sender.getsockname()[1]}" for sender in self.senders[:3]]
        shipped = read_yaml_lines(_SHIPPED)
        self.settings = from_values(ControlSettings, {**shipped, "peers": peers})

    def run(self, data: bytes) -> None:
        """Makes the client receive the events in the bytes, each datagram a moment after the one before."""
        now_s, motions = 0.0, []  # type: float, List[Motion]
        client = ControlsClient(
            self.settings,
            self.socket,
            Counters(lambda text: None, lambda: now_s),
            motions.append,
            lambda pause: None,
            lambda: now_s,
        )
        for sender, datagram in _events(data):
            before, sender = len(motions), sender % len(self.senders)
            now_s += _STEP_S * (1 + sender)
            self.senders[sender].sendto(datagram, self.socket.getsockname())
            client.receive(0.0)
            is_peer = sender < 3
            told = [motion for motion in motions[before:] if is_peer or any(motion)]
            _check(is_peer or not told, f"{told}: told by a sender that is no peer")
            _check(all(map(self._within_limits, told)), f"{told}: beyond the limits")
        self._empty()

    def _within_limits(self, motion: Motion) -> bool:
        speed, yaw_rate = abs(motion.speed_m_s), abs(motion.yaw_rate_rad_s)
        return speed <= self.settings.max_speed_m_s and yaw_rate <= self.settings.max_yaw_rate_rad_s

    def _empty(self) -> None:
        """Reads the answers, so that no buffer is full when the next input comes."""
        for sender in self.senders:
            try:
                while True:
                    sender.recv(65535, socket.MSG_DONTWAIT)
            except BlockingIOError:
                pass


_bench: List[_Bench] = []


def controls(data: bytes) -> None:
    """Sends datagrams of several senders to the controls client."""
    if not _bench:
        _bench.append(_Bench())
    _bench[0].run(data)


def frames(data: bytes) -> None:
    """Pairs datagrams of many senders, and assembles images and clouds."""
    pairer, assembler, now_s = Pairer(), chunks.Assembler(), 0.0
    for sender, datagram in _events(data):
        now_s += _STEP_S
        message = pairer.feed(sender, datagram, now_s)
        _check(len(pairer._waiting) <= MAX_SENDERS, "more headers wait than there may be senders")
        kind = message and codec.data_struct(message.header)
        if kind not in (codec.ImageChunk, codec.PointCloudChunk):
            continue
        whole = assembler.feed(*message)
        if whole is not None:
            _check(len(whole.payload) == whole.head.chunk.total, "a frame of another size")
            if kind is codec.PointCloudChunk and len(whole.payload) % codec.Point.size == 0:
                chunks.points_si(whole.payload)
    list(pairer.take_drops())


def settings(data: bytes) -> None:
    """Reads settings of both nodes from a YAML file and from the parameter server."""
    _FILE.write_bytes(data)
    for kind in (ServerSettings, ControlSettings):
        for read in (build, from_values):
            try:
                read(kind, read_yaml_lines(_FILE))
            except GeneratorError:
                pass


TARGETS: Dict[str, Callable[[bytes], None]] = {
    "codec": codec_of_all_structs,
    "controls": controls,
    "frames": frames,
    "settings": settings,
}
