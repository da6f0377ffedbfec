# SPDX-License-Identifier: MIT
"""Settings of the two nodes: read from nested dictionaries (YAML, ROS parameters), checked key by key."""
import ipaddress
import re
from typing import Any, Callable, Dict, List, NamedTuple, Optional, Sequence, Tuple

from ardee_bridge.wire import codec
from ardee_bridge.wire.chunks import MAX_PAYLOAD

# Too large for a datagram, and slow to convert.
FRAME_KINDS = ("image", "point_cloud")
_SMALL_KINDS = ("imu", "gyro", "acceleration", "orientation", "gps", "lidar", "encoder", "battery")
KINDS = {kind: codec.DataType[kind.upper()] for kind in _SMALL_KINDS + FRAME_KINDS}
# Of images that come as JPEG files: no setting, but what becomes of "jpeg" where a camera compresses by itself.
COMPRESSED = "compressed"
SELECTIONS = dict(KINDS, all=codec.DataType.ALL, time=codec.DataType.TIME)
# Names of the ROS graph (wiki.ros.org/Names), relative ones among them.
_NAME = re.compile(r"[~/]?[A-Za-z]\w*(/\w+)*", re.ASCII)
_UNSET = object()


class SettingError(ValueError):
    """A setting that cannot be: key, what was found, what was expected."""


class Reader:
    """A dictionary of settings that knows its own key path; finish() refuses keys that nobody asked for."""

    def __init__(self, values: Any, path: str = "") -> None:
        if not isinstance(values, dict):
            raise SettingError(f"{path or 'settings'}: found {values!r}, expected keys and values")
        self._values, self._path, self._asked = values, path, set()  # type: ignore

    def _fail(self, key: str, expected: str) -> SettingError:
        found = repr(self._values[key]) if key in self._values else "nothing"
        return SettingError(f"{self._path}{key}: found {found}, expected {expected}")

    def _take(
        self, key: str, is_good: Callable[[Any], Any], expected: str, default: Any = _UNSET
    ) -> Any:
        self._asked.add(key)
        value = self._values.get(key, default)
        if not is_good(value):
            raise self._fail(key, expected)
        return value

    def text(self, key: str) -> str:
        """Returns a string that is not empty."""
        return self._take(key, lambda value: isinstance(value, str) and value, "a text")

    def name(self, key: str, default: Any = _UNSET) -> str:
        """Returns the name of a topic or service, or the default."""
        if self._values.get(key, default) == default != _UNSET:
            self._asked.add(key)
            return default
        self.text(key)
        return self._take(key, _NAME.fullmatch, "a ROS name such as ardee/gps")

    def choice(self, key: str, choices: Any, default: Any = _UNSET) -> str:
        """Returns one of several words."""
        expected = "one of " + ", ".join(choices)
        return self._take(key, lambda v: isinstance(v, str) and v in choices, expected, default)

    def number(self, key: str, least: float, most: float, default: Any = _UNSET) -> float:
        """Returns a number within bounds."""
        expected = f"a number from {least:g} to {most:g}"
        kinds = (int, float)
        return self._take(key, lambda v: type(v) in kinds and least <= v <= most, expected, default)

    def whole(self, key: str, least: int, most: int, default: Any = _UNSET) -> int:
        """Returns a whole number within bounds."""
        expected = f"a whole number from {least} to {most}"
        return self._take(key, lambda v: type(v) is int and least <= v <= most, expected, default)

    def address(self, key: str) -> str:
        """Returns an IPv4 address."""
        value = self._take(key, lambda v: True, "")
        try:
            return str(ipaddress.IPv4Address(value if isinstance(value, str) else ""))
        except ValueError:
            raise self._fail(key, "an IPv4 address such as 127.0.0.1") from None

    def items(self, key: str) -> List[Any]:
        """Returns a list."""
        return self._take(key, lambda value: isinstance(value, list), "a list", [])

    def selections(self, key: str) -> int:
        """Returns kinds of sensors as SetPort.data_types; not to be left out, for nothing would be sent without it."""

        def is_good(words: Any) -> bool:
            good = isinstance(words, list) and all(isinstance(word, str) for word in words)
            return good and set(words) <= set(SELECTIONS)

        words = self._take(key, is_good, "a list of " + ", ".join(SELECTIONS))
        return codec.type_mask([SELECTIONS[word] for word in words])

    def readers(self, key: str) -> List["Reader"]:
        """Returns a list of dictionaries."""
        path = f"{self._path}{key}"
        return [Reader(item, f"{path}[{number}].") for number, item in enumerate(self.items(key))]

    def networks(self, key: str) -> "Peers":
        """A list of addresses or networks, each with a port or without."""
        peers = []
        for item in self.items(key):
            host, _, port = item.partition(":") if isinstance(item, str) else ("", "", "")
            try:
                peers.append((ipaddress.IPv4Network(host), _port(port)))
            except ValueError:
                expected = "a list of 127.0.0.1, 192.168.1.0/24 or 127.0.0.1:5000 and the like"
                raise self._fail(key, expected) from None
        return Peers(tuple(peers))

    def finish(self) -> None:
        """Refuse what nobody asked for."""
        for key in sorted(set(self._values) - self._asked, key=str):
            known = ", ".join(sorted(self._asked))
            raise SettingError(f"{self._path}{key}: unknown; known here are {known}")


def _port(text: str) -> Optional[int]:
    if text and not 1 <= int(text) <= 65535:
        raise ValueError(text)
    return int(text) if text else None


class Peers(NamedTuple):
    """Addresses that are listened to."""

    networks: Tuple[Tuple[ipaddress.IPv4Network, Optional[int]], ...]

    def include(self, sender: Tuple[str, int]) -> bool:
        """Is this address and port one of them?"""
        host = ipaddress.IPv4Address(sender[0])
        return any(host in network and port in (None, sender[1]) for network, port in self.networks)


class Destination(NamedTuple):
    """Where sensor messages go from the start, and which."""

    address: str
    port: int
    data_types: int


class Source(NamedTuple):
    """A topic whose messages are sent."""

    name: str
    kind: str
    topic: str
    component_id: int
    max_rate_hz: float
    velocity_topic: str
    image_format: str
    jpeg_quality: int
    chunk_bytes: int

    @property
    def data_type(self) -> codec.DataType:
        return KINDS[self.kind]

    @property
    def is_frame(self) -> bool:
        """Does it send images or clouds?"""
        return self.kind in FRAME_KINDS

    def of_camera(self) -> "Source":
        """The same images, compressed by whoever publishes them, on the topic that image_transport gives them."""
        return self._replace(topic=f"{self.topic}/compressed", image_format=COMPRESSED)


class ServerSettings(NamedTuple):
    """Of the sensor server."""

    bind_address: str
    port: int
    destinations: Tuple[Destination, ...]
    allowed_clients: Peers
    max_clients: int
    client_lease_s: float
    multicast_ttl: int
    realtime_priority: int
    sources: Tuple[Source, ...]


class ControlSettings(NamedTuple):
    """Of the controls client."""

    bind_address: str
    port: int
    peers: Peers
    cmd_vel_topic: str
    max_speed_m_s: float
    min_turn_radius_m: float
    watchdog_s: float
    pause_service: str
    unpause_service: str

    @property
    def max_yaw_rate_rad_s(self) -> float:
        """Yaw rate of a turn of the least radius at full speed."""
        return self.max_speed_m_s / self.min_turn_radius_m


def _read_destination(reader: Reader, bind_address: str) -> Destination:
    address, port = reader.address("address"), reader.whole("port", 1, 65535)
    data_types = reader.selections("data_types")
    reader.finish()
    of_bind, of_peer = ipaddress.IPv4Address(bind_address), ipaddress.IPv4Address(address)
    if of_peer.is_unspecified:
        raise SettingError(f"{reader._path}address: found {address}, expected where to send to")
    if of_bind.is_loopback and not (of_peer.is_loopback or of_peer.is_multicast):
        raise SettingError(
            f"{reader._path}address: {address} cannot be reached from bind_address {bind_address}; "
            "expected the bind_address of an interface towards it, or 0.0.0.0"
        )
    return Destination(address, port, data_types)


def _read_source(reader: Reader) -> Source:
    kind = reader.choice("kind", KINDS)
    source = Source(
        name=reader.text("name"),
        kind=kind,
        topic=reader.name("topic"),
        component_id=reader.whole("component_id", 0, 2**31 - 1, 0),
        max_rate_hz=reader.number("max_rate_hz", 0.0, 1e6, 0),
        velocity_topic=reader.name("velocity_topic", "") if kind == "gps" else "",
        image_format=reader.choice("format", ("jpeg", "raw"), "jpeg") if kind == "image" else "",
        jpeg_quality=reader.whole("jpeg_quality", 1, 95, 80) if kind == "image" else 0,
        chunk_bytes=(
            reader.whole("chunk_bytes", 256, MAX_PAYLOAD, MAX_PAYLOAD) if kind in FRAME_KINDS else 0
        ),
    )
    reader.finish()
    if kind == "point_cloud" and source.chunk_bytes % codec.Point.size:
        raise reader._fail("chunk_bytes", f"a multiple of {codec.Point.size}")
    return source


def read_server(values: Dict[str, Any]) -> ServerSettings:
    """Settings of the sensor server; SettingError names the first that cannot be."""
    reader = Reader(values)
    bind_address = reader.address("bind_address")
    sources = tuple(_read_source(item) for item in reader.readers("sources"))
    settings = ServerSettings(
        bind_address=bind_address,
        port=reader.whole("port", 0, 65535),
        destinations=tuple(
            _read_destination(each, bind_address) for each in reader.readers("peers")
        ),
        allowed_clients=reader.networks("allowed_clients"),
        max_clients=reader.whole("max_clients", 0, 1024),
        client_lease_s=reader.number("client_lease_s", 0.1, 86400.0),
        multicast_ttl=reader.whole("multicast_ttl", 0, 255),
        realtime_priority=reader.whole("realtime_priority", 0, 99, 0),
        sources=sources,
    )
    reader.finish()
    _check_unique(sources)
    _check_destinations(settings.destinations, (bind_address, settings.port))
    return settings


def kept_here(settings: ServerSettings) -> List[str]:
    """Multicast groups whose messages reach this computer alone, for they leave from loopback."""
    if not ipaddress.IPv4Address(settings.bind_address).is_loopback:
        return []
    addresses = [peer.address for peer in settings.destinations]
    return [each for each in addresses if ipaddress.IPv4Address(each).is_multicast]


def silent(peers: Peers) -> List[str]:
    """Those from whose address nothing ever comes: multicast groups, and the broadcast to all."""
    everybody = ipaddress.IPv4Address("255.255.255.255")
    hosts = [network.network_address for network, _ in peers.networks if network.num_addresses == 1]
    return [str(host) for host in hosts if host.is_multicast or host == everybody]


def _check_distinct(values: Sequence[Any], complaint: Callable[[int, int], str]) -> None:
    """Refuses a value that occurs twice; the complaint is of the later one, and names the first."""
    for number, value in enumerate(values):
        if value in values[:number]:
            raise SettingError(complaint(number, values.index(value)))


def _check_unique(sources: Tuple[Source, ...]) -> None:
    """Sources are told apart by their names here, and by kind and component on the wire."""
    _check_distinct(
        [source.name for source in sources],
        lambda number, other: f"sources[{number}].name: found {sources[number].name!r}, "
        f"which is sources[{other}]'s; expected one of its own",
    )
    _check_distinct(
        [(source.data_type, source.component_id) for source in sources],
        lambda number, other: f"sources[{number}].component_id: found {sources[number].component_id}, "
        f"which is {sources[other].name}'s; expected one of its own among kind {sources[number].kind}",
    )


def _check_destinations(destinations: Tuple[Destination, ...], own: Tuple[str, int]) -> None:
    """One selection for each address and port: the server keeps no more. None for the server itself."""
    places = [(peer.address, peer.port) for peer in destinations]
    if own in places:
        found = f"peers[{places.index(own)}]: found {own[0]}:{own[1]}"
        raise SettingError(f"{found}, which is the server's own; expected another's")
    _check_distinct(
        places,
        lambda number, other: "peers[%d]: found %s:%d, which is " % (number, *places[number])
        + f"peers[{other}]'s; expected each address and port once, with all its data_types",
    )


def read_controls(values: Dict[str, Any]) -> ControlSettings:
    """Settings of the controls client; SettingError names the first that cannot be."""
    reader = Reader(values)
    settings = ControlSettings(
        bind_address=reader.address("bind_address"),
        port=reader.whole("port", 0, 65535),
        peers=reader.networks("peers"),
        cmd_vel_topic=reader.name("cmd_vel_topic"),
        max_speed_m_s=reader.number("max_speed_m_s", 0.001, 100.0),
        min_turn_radius_m=reader.number("min_turn_radius_m", 0.001, 1000.0),
        watchdog_s=reader.number("watchdog_s", 0.01, 60.0),
        pause_service=reader.name("pause_service"),
        unpause_service=reader.name("unpause_service"),
    )
    reader.finish()
    return settings
