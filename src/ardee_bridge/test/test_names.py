# SPDX-License-Identifier: MIT
"""Tests settings that are names: of topics and services, valid in ROS, and of sources, which must differ."""
import pytest
import yaml

from ardee_bridge.nodes.settings import ControlSettings, ServerSettings
from ardee_common.config import from_values
from ardee_common.errors import GeneratorError


def shipped(package, name):
    return yaml.safe_load((package / "config" / name).read_text())


def encoders(*names_and_topics):
    return [
        dict(name=name, kind="encoder", topic=topic, component_id=number)
        for number, (name, topic) in enumerate(names_and_topics)
    ]


@pytest.mark.parametrize("topic", ["a", "/a/b_2", "~own", "ardee/encoder/fr"])
def test_names_that_ros_takes(package, topic):
    values = shipped(package, "sensor_server.yaml")
    assert (
        from_values(ServerSettings, dict(values, sources=encoders(("e", topic)))).sources[0].topic
        == topic
    )
    values = shipped(package, "controls_client.yaml")
    assert from_values(ControlSettings, dict(values, cmd_vel_topic=topic)).cmd_vel_topic == topic


@pytest.mark.parametrize("topic", ["a b", "1a", "a//b", "ä", "a/", "/", "a-b", "a\n"])
def test_names_that_ros_does_not_take(package, topic):
    expected = "expected a ROS name such as ardee/gps"
    values = shipped(package, "sensor_server.yaml")
    with pytest.raises(GeneratorError, match=rf"sources\[0\]: topic: found .*, {expected}"):
        from_values(ServerSettings, dict(values, sources=encoders(("e", topic))))
    fix = dict(name="g", kind="gps", topic="fix", velocity_topic=topic)
    with pytest.raises(
        GeneratorError, match=rf"sources\[0\]: velocity_topic: found .*, {expected}"
    ):
        from_values(ServerSettings, dict(values, sources=[fix]))
    values = shipped(package, "controls_client.yaml")
    for key in ("cmd_vel_topic", "pause_service", "unpause_service"):
        with pytest.raises(GeneratorError, match=rf"^{key}: found .*, {expected}"):
            from_values(ControlSettings, dict(values, **{key: topic}))


def test_two_sources_of_one_name_are_refused(package):
    values = shipped(package, "sensor_server.yaml")
    two = encoders(("wheel", "left"), ("wheel", "right"))
    with pytest.raises(GeneratorError) as refused:
        from_values(ServerSettings, dict(values, sources=two))
    assert str(refused.value) == (
        "sources[1]: name: found 'wheel', which is sources[0]'s; expected one of its own"
    )
