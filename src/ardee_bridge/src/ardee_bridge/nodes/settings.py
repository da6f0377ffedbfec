# SPDX-License-Identifier: MIT
"""Settings of the two nodes: dataclasses of options, and checks of values that must go together."""
import dataclasses
import ipaddress
from dataclasses import MISSING, dataclass
from typing import Any, ClassVar, List, NamedTuple, Optional, Tuple

from ardee_bridge.wire import codec
from ardee_bridge.wire.chunks import MAX_PAYLOAD
from ardee_common.config import Mapping
from ardee_common.errors import GeneratorError
from ardee_common.options import bounded, converted, option, ros_name

# Data types that are too large for a datagram, and slow to convert.
FRAME_KINDS = ("image", "point_cloud")
_SMALL_KINDS = ("imu", "gyro", "acceleration", "orientation", "gps", "lidar", "encoder", "battery")
KINDS = {kind: codec.DataType[kind.upper()] for kind in _SMALL_KINDS + FRAME_KINDS}
# Format of images that a camera compresses itself; no setting, but replaces "jpeg".
COMPRESSED = "compressed"
SELECTIONS = dict(KINDS, all=codec.DataType.ALL, time=codec.DataType.TIME)


class Peers(NamedTuple):
    """Addresses whose messages are accepted."""

    networks: Tuple[Tuple[ipaddress.IPv4Network, Optional[int]], ...]

    def include(self, sender: Tuple[str, int]) -> bool:
        """Returns whether this address and port is one of them."""
        host = ipaddress.IPv4Address(sender[0])
        return any(host in network and port in (None, sender[1]) for network, port in self.networks)


def _all_texts(values: Any) -> List[str]:
    if not (isinstance(values, list) and all(isinstance(value, str) for value in values)):
        raise ValueError(values)
    return values


def _text(value: Any) -> str:
    if not (isinstance(value, str) and value):
        raise ValueError(value)
    return value


def _address(value: Any) -> str:
    return str(ipaddress.IPv4Address(_text(value)))


def _peer(text: str) -> Tuple[ipaddress.IPv4Network, Optional[int]]:
    host, colon, port = text.partition(":")
    if colon and not 1 <= int(port) <= 65535:
        raise ValueError(text)
    network = ipaddress.IPv4Network(host, strict=False)
    if str(network.network_address) != host.partition("/")[0]:
        raise GeneratorError(
            f"found {text!r}, an address in a network, expected the network {network},"
            f" or the address {host.partition('/')[0]} alone"
        )
    return network, int(port) if colon else None


def _peers(values: Any) -> Peers:
    return Peers(tuple(map(_peer, _all_texts(values))))


def _type_mask(values: Any) -> int:
    if not set(_all_texts(values)) <= set(SELECTIONS):
        raise ValueError(values)
    return codec.type_mask([SELECTIONS[word] for word in values])


def _address_option() -> Any:
    return converted(_address, "an IPv4 address such as 127.0.0.1")


def _peers_option() -> Any:
    expected = "a list of 127.0.0.1, 192.168.1.0/24 or 127.0.0.1:5000 and the like"
    return converted(_peers, expected, Peers(()))


@dataclass(frozen=True)
class Destination:
    """A target that gets sensor messages from the start; `data_types` as in SetPort."""

    address: str = _address_option()
    port: int = bounded(1, 65535)
    data_types: int = converted(_type_mask, "a list of " + ", ".join(SELECTIONS))


@dataclass(frozen=True)
class Source:
    """A topic whose messages are sent."""

    name: str = converted(_text, "a text")
    kind: str = option(MISSING, choices=tuple(KINDS))
    topic: str = ros_name()
    component_id: int = option(0, limits=(0, 2**31 - 1))
    max_rate_hz: float = option(0.0, limits=(0.0, 1e6))
    velocity_topic: ClassVar[str] = ""
    format: ClassVar[str] = ""

    @property
    def data_type(self) -> codec.DataType:
        return KINDS[self.kind]


@dataclass(frozen=True)
class GpsSource(Source):
    """Fixes, with the velocity of another topic if one is named."""

    velocity_topic: str = ros_name("")


@dataclass(frozen=True)
class ImageSource(Source):
    """Images of a camera."""

    format: str = option("jpeg", choices=("jpeg", "raw"))
    jpeg_quality: int = option(80, limits=(1, 95))
    chunk_bytes: int = option(MAX_PAYLOAD, limits=(256, MAX_PAYLOAD))

    def of_camera(self) -> "ImageSource":
        """Returns the same images as compressed by their publisher, on the topic that image_transport gives them."""
        return dataclasses.replace(self, topic=f"{self.topic}/compressed", format=COMPRESSED)


@dataclass(frozen=True)
class CloudSource(Source):
    """Point clouds."""

    chunk_bytes: int = option(MAX_PAYLOAD, limits=(256, MAX_PAYLOAD))

    def __post_init__(self) -> None:
        if self.chunk_bytes % codec.Point.size:
            found = f"chunk_bytes: found {self.chunk_bytes}"
            raise GeneratorError(f"{found}, expected a multiple of {codec.Point.size}")


def _source_class(mapping: Mapping) -> type:
    classes = {"gps": GpsSource, "image": ImageSource, "point_cloud": CloudSource}
    return classes.get(str(mapping.get("kind")), Source)


@dataclass(frozen=True)
class ServerSettings:
    """Settings of the sensor server."""

    bind_address: str = _address_option()
    port: int = bounded(0, 65535)
    max_clients: int = bounded(0, 1024)
    client_lease_s: float = bounded(0.1, 86400.0)
    multicast_ttl: int = bounded(0, 255)
    realtime_priority: int = bounded(0, 99, 0)
    allowed_clients: Peers = _peers_option()
    peers: Tuple[Destination, ...] = dataclasses.field(default=(), metadata={"group": Destination})
    sources: Tuple[Source, ...] = dataclasses.field(default=(), metadata={"group": _source_class})

    def __post_init__(self) -> None:
        _check_unique(self.sources)
        _check_destinations(self.peers, (self.bind_address, self.port))


@dataclass(frozen=True)
class ControlSettings:
    """Settings of the controls client."""

    bind_address: str = _address_option()
    port: int = bounded(0, 65535)
    cmd_vel_topic: str = ros_name()
    max_speed_m_s: float = bounded(0.001, 100.0)
    min_turn_radius_m: float = bounded(0.001, 1000.0)
    watchdog_s: float = bounded(0.01, 60.0)
    pause_service: str = ros_name()
    unpause_service: str = ros_name()
    peers: Peers = _peers_option()

    @property
    def max_yaw_rate_rad_s(self) -> float:
        """Yaw rate of a turn of the least radius at full speed."""
        return self.max_speed_m_s / self.min_turn_radius_m


def kept_here(settings: ServerSettings) -> List[str]:
    """Multicast groups whose messages reach this computer alone, for they leave from loopback."""
    if not ipaddress.IPv4Address(settings.bind_address).is_loopback:
        return []
    addresses = [peer.address for peer in settings.peers]
    return [each for each in addresses if ipaddress.IPv4Address(each).is_multicast]


def silent(peers: Peers) -> List[str]:
    """Destinations that are never a sender's address: multicast groups, and the broadcast to all."""
    everybody = ipaddress.IPv4Address("255.255.255.255")
    hosts = [network.network_address for network, _ in peers.networks if network.num_addresses == 1]
    return [str(host) for host in hosts if host.is_multicast or host == everybody]


def _check_unique(sources: Tuple[Source, ...]) -> None:
    """Refuses sources of the same name, and of the same kind and component, which the wire could not tell apart."""
    for number, source in enumerate(sources):
        for place, other in enumerate(sources[:number]):
            if source.name == other.name:
                found = f"name: found {source.name!r}, which is sources[{place}]'s"
                raise GeneratorError(f"sources[{number}]: {found}; expected one of its own")
            if (source.kind, source.component_id) == (other.kind, other.component_id):
                found = f"component_id: found {source.component_id}, which is {other.name}'s"
                expected = f"expected one of its own among kind {source.kind}"
                raise GeneratorError(f"sources[{number}]: {found}; {expected}")


def _check_destinations(destinations: Tuple[Destination, ...], own: Tuple[str, int]) -> None:
    """Refuses destinations that cannot be reached, the server itself, and a second entry of an address and port."""
    of_bind = ipaddress.IPv4Address(own[0])
    places: List[Tuple[str, int]] = []
    for number, peer in enumerate(destinations):
        address, place = ipaddress.IPv4Address(peer.address), (peer.address, peer.port)
        if address.is_unspecified:
            found, expected = f"address: found {peer.address}", "the address of a receiver"
            raise GeneratorError(f"peers[{number}]: {found}, expected {expected}")
        if of_bind.is_loopback and not (address.is_loopback or address.is_multicast):
            raise GeneratorError(
                f"peers[{number}]: address: found {peer.address}, which cannot be reached from "
                f"bind_address {own[0]}; expected the bind_address of an interface towards it, or 0.0.0.0"
            )
        found = f"peers[{number}]: found {peer.address}:{peer.port}"
        if place == own:
            raise GeneratorError(f"{found}, which is the server's own; expected another's")
        if place in places:
            expected = "expected each address and port once, with all its data_types"
            raise GeneratorError(f"{found}, which is peers[{places.index(place)}]'s; {expected}")
        places.append(place)
