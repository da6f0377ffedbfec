# SPDX-License-Identifier: MIT
"""A revolute joint without <axis> turns about z, SDF's default, with one warning, as that of test_axis_default."""
from test_axis_default import check_leaf_turns

from ardee_common.ros_graph import RosGraph


def test_the_leaf_turns_about_z_with_one_warning(graph: RosGraph) -> None:
    said = check_leaf_turns(graph, "joint-without-axis")
    assert said.count("found no <axis>, expected one; it is 0 0 1") == 1
