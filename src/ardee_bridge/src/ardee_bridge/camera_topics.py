# SPDX-License-Identifier: MIT
"""Which topic a camera's JPEG images are taken from: the camera's own compressed images, or raw ones to compress."""
import time
from typing import Callable, Dict, FrozenSet, Iterable, NamedTuple, Optional, Set

from sensor_msgs.msg import CompressedImage, Image

from ardee_bridge.reader import Reader, Watch
from ardee_bridge.settings import Source

# A publisher makes its topics known one after the other: so long must compressed images be missing beside raw ones.
PATIENCE_S = 1.0
REFRESH_S = 2.0


class _Camera:
    """A source whose publishers are watched, and the form that was chosen."""

    def __init__(self, source: Source, reader: Reader) -> None:
        self.compressed = reader.watch_publishers(source.of_camera().topic, CompressedImage._type)
        self.raw = reader.watch_publishers(source.topic, Image._type)
        self.is_compressed: Optional[bool] = None
        self._raw_alone_since_s: Optional[float] = None

    def choose(self, now_s: float) -> None:
        """Compressed images where they are published; where nobody publishes at all, as before."""
        is_alone = self.raw.has_publishers() and self.compressed.is_known
        if self.compressed.has_publishers():
            self.is_compressed, self._raw_alone_since_s = True, None
        elif not is_alone:
            self._raw_alone_since_s = None
        elif self._raw_alone_since_s is None:
            self._raw_alone_since_s = now_s
        elif now_s - self._raw_alone_since_s >= PATIENCE_S:
            self.is_compressed = False

    def watches(self) -> Iterable[Watch]:
        return self.compressed, self.raw


class Choice(NamedTuple):
    """Names of the sources whose images the camera compresses, and of those that are compressed here."""

    compressed: FrozenSet[str]
    raw: FrozenSet[str]


class CameraTopics:
    """Watches the publishers of those sources that somebody wants, without being connected to them."""

    def __init__(
        self, sources: Iterable[Source], reader: Reader, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._sources, self._reader, self._clock = tuple(sources), reader, clock
        self._cameras: Dict[str, _Camera] = {}
        self._refresh_s = clock() + REFRESH_S

    def choice(self, wanted: Set[str]) -> Choice:
        """What is to be read now; to be asked again and again."""
        for source in self._sources:
            if source.name in wanted and source.name not in self._cameras:
                self._cameras[source.name] = _Camera(source, self._reader)
            elif source.name not in wanted and source.name in self._cameras:
                for watch in self._cameras.pop(source.name).watches():
                    self._reader.end_watch(watch)
        now_s = self._clock()
        if now_s >= self._refresh_s:
            self._refresh_s = now_s + REFRESH_S
            for watch in [each for camera in self._cameras.values() for each in camera.watches()]:
                self._reader.refresh(watch)
        for camera in self._cameras.values():
            camera.choose(now_s)
        forms = {name: camera.is_compressed for name, camera in self._cameras.items()}
        return Choice(
            frozenset(name for name, is_compressed in forms.items() if is_compressed),
            frozenset(name for name, is_compressed in forms.items() if is_compressed is False),
        )
