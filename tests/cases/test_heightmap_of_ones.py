# SPDX-License-Identifier: MIT
"""A height image of 0 and, in its middle third, 1 of 255 with a size of 32 32 10, as the corn rows of the thesis's
Figure 4.9 are made: the band stands at 10 / 255 m."""
import pytest
from heights import heights_of

from ardee_common.ros_graph import RosGraph


def test_one_of_255_is_not_full_height(graph: RosGraph) -> None:
    found = heights_of(graph, "heightmap-of-ones/ground.sdf", [(-10, 8), (0.5, -8.2), (10, 8)])
    assert found == pytest.approx([0.0, 10 / 255, 0.0], abs=0.005)
