# SPDX-License-Identifier: MIT
"""Tests settings: the shipped files are sound, and each mistake is one message with key, found and expected value."""
import pytest
import yaml

from ardee_bridge.nodes.settings import ControlSettings, ServerSettings, kept_here, silent
from ardee_bridge.wire import codec
from ardee_common.config import from_values
from ardee_common.errors import GeneratorError


def shipped(package, name):
    return yaml.safe_load((package / "config" / name).read_text())


def test_shipped_defaults_are_those_of_the_thesis(package):
    server = from_values(ServerSettings, shipped(package, "sensor_server.yaml"))
    assert [(peer.address, peer.port) for peer in server.peers] == [("127.0.0.1", 30000)]
    topics = {source.topic for source in server.sources}
    assert {"ardee/imu/custom", "ardee/gps", "ardee/hokuyo", "ardee/battery"} <= topics
    assert {f"ardee/encoder/{place}" for place in ("fr", "fl", "rr", "rl")} <= topics
    controls = from_values(ControlSettings, shipped(package, "controls_client.yaml"))
    assert (controls.bind_address, controls.port) == ("127.0.0.1", 35555)
    assert controls.max_yaw_rate_rad_s == pytest.approx(codec.MAX_YAW_RATE_RAD_S)
    assert controls.max_speed_m_s == codec.MAX_SPEED_M_S


def test_a_group_is_kept_here_by_a_socket_on_loopback(package):
    def peer(address):
        return dict(address=address, port=1, data_types=["imu"])

    values = shipped(package, "sensor_server.yaml")
    values["peers"] = [peer("127.0.0.1"), peer("239.7.7.7")]
    assert kept_here(from_values(ServerSettings, values)) == ["239.7.7.7"]
    values["peers"] = [peer("239.7.7.7")]
    for address in ("192.168.1.1", "0.0.0.0"):
        assert kept_here(from_values(ServerSettings, dict(values, bind_address=address))) == []


@pytest.mark.parametrize(
    "change, message",
    [
        (dict(port=70000), "port: found 70000, expected a whole number, 0 to 65535"),
        (dict(port=True), "port: found True, expected a whole number"),
        (dict(realtime_priority=100), "realtime_priority: found 100, expected a whole number"),
        (dict(prot=1), "^unknown key 'prot', nearest of .*: port, .* did you mean 'port'"),
        (
            dict(bind_address="localhost"),
            "bind_address: found 'localhost', expected an IPv4 address",
        ),
        (dict(client_lease_s=float("nan")), "client_lease_s: found nan, expected 0.1 to 86400"),
        (dict(allowed_clients=["::1"]), "allowed_clients: found"),
        (dict(allowed_clients=["10.0.0.1:99999"]), "allowed_clients: found"),
        (
            dict(allowed_clients=["127.0.0.1:"]),
            r"allowed_clients: found \['127.0.0.1:'\], expected",
        ),
        (
            dict(allowed_clients=["192.168.1.135/24"]),
            "allowed_clients: found '192.168.1.135/24', an address in a network, expected the network"
            " 192.168.1.0/24, or the address 192.168.1.135 alone",
        ),
        (
            dict(peers=[dict(address="10.0.0.1", port=1, data_types=[])]),
            "cannot be reached from bind_address 127.0.0.1",
        ),
        (
            dict(peers=[dict(address="127.0.0.1")]),
            r"peers\[0\]: missing key 'port'",
        ),
        (
            dict(peers=[dict(address="127.0.0.1", port=1, data_types=["sonar"])]),
            r"peers\[0\]: data_types: found \['sonar'\], expected a list of imu",
        ),
        (
            dict(peers=[dict(address="127.0.0.1", port=1)]),
            r"peers\[0\]: missing key 'data_types'",
        ),
        (
            dict(peers=[dict(address="127.0.0.1", port=1, data_types=[k]) for k in ("imu", "gps")]),
            r"peers\[1\]: found 127.0.0.1:1, which is peers\[0\]'s",
        ),
        (
            dict(bind_address="0.0.0.0", peers=[dict(address="0.0.0.0", port=1, data_types=[])]),
            r"peers\[0\]: address: found 0.0.0.0, expected the address of a receiver",
        ),
        (
            dict(port=5, peers=[dict(address="127.0.0.1", port=5, data_types=[])]),
            r"peers\[0\]: found 127.0.0.1:5, which is the server's own",
        ),
        (
            dict(sources=[dict(name="a", topic="t", kind="sonar")]),
            r"sources\[0\]: kind: found 'sonar'",
        ),
        (dict(sources=[dict(name="a", kind="imu")]), r"sources\[0\]: missing key 'topic'"),
        (
            dict(sources=[dict(name="a", topic="t", kind="imu", jpeg_quality=5)]),
            r"sources\[0\]: unknown key 'jpeg_quality', known: ",
        ),
        (
            dict(sources=[dict(name=n, topic="t", kind="imu") for n in "ab"]),
            r"sources\[1\]: component_id: found 0, which is a's",
        ),
        (
            dict(sources=[dict(name="a", topic="t", kind="point_cloud", chunk_bytes=1000)]),
            "chunk_bytes: found 1000, expected a multiple of 16",
        ),
        (dict(sources=3), "sources: found 3, expected a list"),
        (dict(sources=[3]), "sources: found 3, expected a mapping of keys"),
    ],
)
def test_a_bad_server_setting_is_named(package, change, message):
    with pytest.raises(GeneratorError, match=message):
        from_values(ServerSettings, dict(shipped(package, "sensor_server.yaml"), **change))


@pytest.mark.parametrize(
    "change, message",
    [
        (dict(watchdog_s=0), "watchdog_s: found 0, expected 0.01 to 60"),
        (dict(max_speed_m_s="fast"), "max_speed_m_s: found 'fast', expected 0.001 to 100"),
        (dict(cmd_vel_topic=""), "cmd_vel_topic: found '', expected a ROS name"),
        (dict(peers="127.0.0.1"), "peers: found '127.0.0.1', expected a list"),
    ],
)
def test_a_bad_control_setting_is_named(package, change, message):
    with pytest.raises(GeneratorError, match=message):
        from_values(ControlSettings, dict(shipped(package, "controls_client.yaml"), **change))


def test_groups_and_the_broadcast_to_all_drive_nobody(package):
    peers = ["127.0.0.1", "239.7.7.7", "192.168.1.0/24", "255.255.255.255:5", "0.0.0.0/0"]
    values = dict(shipped(package, "controls_client.yaml"), peers=peers)
    assert silent(from_values(ControlSettings, values).peers) == ["239.7.7.7", "255.255.255.255"]
