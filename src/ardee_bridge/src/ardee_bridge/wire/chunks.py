# SPDX-License-Identifier: MIT
"""Images and point clouds are larger than a datagram: they travel as chunks."""
from typing import Dict, Iterable, List, NamedTuple, Optional, Tuple, Union

from ardee_bridge.wire import codec

ChunkHead = Union[codec.ImageChunk, codec.PointCloudChunk]
# The largest payload that, with the head before it, still fits a UDP datagram; whole points.
MAX_PAYLOAD = 65_000 // codec.Point.size * codec.Point.size
MAX_TOTAL = 64 << 20
_PIXEL_BYTES = {
    codec.ImageEncoding.MONO8: 1,
    codec.ImageEncoding.RGB8: 3,
    codec.ImageEncoding.BGR8: 3,
    codec.ImageEncoding.DEPTH_16U_MM: 2,
    codec.ImageEncoding.DEPTH_32F_M: 4,
}


def split(
    data_type: codec.DataType,
    component_id: int,
    head: ChunkHead,
    payload: codec.Buffer,
    chunk_bytes: int,
) -> List[codec.Datagrams]:
    """Returns the messages that carry `payload`.

    head.chunk names their time and sequence; the rest of it is filled in here.
    """
    view, chunk, messages = memoryview(payload), head.chunk, []
    chunk.total = len(view)
    chunk.count = max(1, -(-len(view) // chunk_bytes))
    for chunk.index in range(chunk.count):
        chunk.offset = chunk.index * chunk_bytes
        part = view[chunk.offset : chunk.offset + chunk_bytes]
        data = head.pack() + part
        messages.append(codec.encode(data_type, component_id, data, count=len(part)))
    return messages


class Whole(NamedTuple):
    """A complete image or cloud: head of its last chunk, and its bytes."""

    component_id: int
    head: ChunkHead
    payload: bytes


class _Frame:
    """Chunks of one image or cloud that have arrived so far; `key` is what they have in common."""

    def __init__(self, key: Tuple[int, ...]) -> None:
        self.key, self.size, self.done = key, 0, False
        self.parts: Dict[int, Tuple[int, bytes]] = {}  # index -> offset, payload


class Assembler:
    """Puts chunks together; keeps one unfinished frame for each component, so a lost chunk loses its frame alone."""

    def __init__(self, max_components: int = 16) -> None:
        self.lost_frames = self.bad_chunks = 0
        self._frames: Dict[Tuple[int, int], _Frame] = {}
        self._replaced: Dict[Tuple[int, int], tuple] = {}  # keys of the frames before
        self._max_components = max_components

    def feed(self, header: codec.Header, data: bytes) -> Optional[Whole]:
        """Returns the frame that this message completes, or None."""
        kind = codec.data_struct(header)
        head = kind.unpack(data[: kind.size])
        payload = data[kind.size :]
        if not _is_sound(head, len(payload)):
            self.bad_chunks += 1
            return None
        frame = self._frame_for((header.data_type, header.component_id), head)
        if frame is None or frame.done or head.chunk.index in frame.parts:
            return None
        frame.size += len(payload)
        if frame.size > head.chunk.total:
            self.bad_chunks += 1
            frame.size -= len(payload)
            return None
        frame.parts[head.chunk.index] = head.chunk.offset, payload
        if len(frame.parts) < head.chunk.count:
            return None
        parts, frame.parts, frame.done = frame.parts, {}, True
        whole = _joined(parts.values())
        if whole is None or len(whole) != head.chunk.total:
            self.bad_chunks += 1
            self.lost_frames += 1
            return None
        return Whole(header.component_id, head, whole)

    def _frame_for(self, place: Tuple[int, int], head: ChunkHead) -> Optional[_Frame]:
        not_common = ("chunk.index", "chunk.offset")
        key = tuple(value for path, value in head.as_dict().items() if path not in not_common)
        frame = self._frames.get(place)
        if frame is not None and frame.key == key:
            return frame
        if key == self._replaced.get(place):
            return None  # a late chunk of the frame before
        if frame is not None:
            self.lost_frames += not frame.done
            self._replaced[place] = frame.key
        elif len(self._frames) >= self._max_components:
            self.bad_chunks += 1
            return None
        self._frames[place] = _Frame(key)
        return self._frames[place]


def _joined(parts: Iterable[Tuple[int, bytes]]) -> Optional[bytes]:
    """Returns payloads joined in the order of their offsets, None where they overlap or leave a hole."""
    whole = bytearray()
    for offset, payload in sorted(parts):
        if offset != len(whole):
            return None
        whole += payload
    return bytes(whole)


def _is_sound(head: ChunkHead, payload_bytes: int) -> bool:
    chunk = head.chunk
    return (
        0 <= chunk.total <= MAX_TOTAL
        and 0 <= chunk.index < chunk.count <= max(1, chunk.total)
        and 0 <= chunk.offset
        and chunk.offset + payload_bytes <= chunk.total
        and (payload_bytes > 0 or chunk.total == 0)
        and (_is_image(head) if isinstance(head, codec.ImageChunk) else _is_cloud(head))
    )


def _is_image(head: codec.ImageChunk) -> bool:
    if head.width < 1 or head.height < 1:
        return False
    if head.encoding == codec.ImageEncoding.JPEG:
        return head.step == 0
    if head.encoding not in _PIXEL_BYTES:
        return False
    is_row = head.step >= head.width * _PIXEL_BYTES[head.encoding]
    return is_row and head.step * head.height == head.chunk.total


def _is_cloud(head: codec.PointCloudChunk) -> bool:
    return head.chunk.total % codec.Point.size == 0


def points_si(payload: bytes) -> List[Tuple[float, float, float, float]]:
    """Points of a cloud's payload: x, y, z [m] and intensity."""
    size = codec.Point.size
    points = (codec.Point.unpack(payload[at : at + size]) for at in range(0, len(payload), size))
    return [(p.x, p.y, p.z, p.intensity) for p in (point.to_si() for point in points)]
