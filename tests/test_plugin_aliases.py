# SPDX-License-Identifier: MIT
"""Tests a file of plugin aliases, read by rosparam: another receiver's name and keys are ours, and a wrong one stops
the simulator with a message.
"""
import pathlib

import probes
import pytest
from gazebo_calls import call, pose, simulate, spawn

from ardee_common.ros_graph import RosGraph

ALIAS = """plugin_aliases:
  - filename: liblab_receiver.so
    plugin: libhector_gazebo_ros_gps.so
    keys: {lat0: referenceLatitude}
"""
ROBOT = """<sdf version="1.6"><model name="r"><link name="l"/>
  <plugin name="gps" filename="liblab_receiver.so"><lat0>12.5</lat0></plugin></model></sdf>"""


def load(graph: RosGraph, text: str) -> None:
    file = pathlib.Path(graph.folder) / "aliases.yaml"
    file.write_text(text)
    graph.run("rosparam", "load", str(file), "/gazebo")


def test_another_receivers_name_and_keys_are_ours(graph: RosGraph) -> None:
    load(graph, ALIAS)
    simulate(graph)
    assert call(graph, spawn("r", ROBOT, pose()))[0].success
    fix = graph.call(probes.collect, "/fix", "sensor_msgs/NavSatFix", 1)[0]
    assert fix.latitude == pytest.approx(12.5, abs=1e-3)


@pytest.mark.parametrize(
    "old, new, message",
    [
        ("libhector_gazebo_ros_gps.so", "libnone.so", "found plugin 'libnone.so', expected one"),
        ("plugin: ", "target: ", "plugin_aliases[0]/target: found 'target', expected"),
        ("keys: {lat0: referenceLatitude}", "keys: lat0", "[0]/keys: found 'lat0', expected"),
        ("referenceLatitude", "7", "plugin_aliases[0]/keys/lat0: found the integer 7, e"),
        (
            "  - filename",
            "  first:\n  - filename",
            "plugin_aliases: found a group of 1, expected a list",
        ),
    ],
)
def test_a_wrong_alias_is_refused(graph: RosGraph, old: str, new: str, message: str) -> None:
    load(graph, ALIAS.replace(old, new))
    simulator = simulate(graph)
    assert simulator.wait(20.0) == 2
    assert message in simulator.output()
