# SPDX-License-Identifier: MIT
"""A height image of bands of 0, 60 and 120 of 255 with a size of 32 32 3: its brightest pixel stands at 3 m."""
import pytest
from heights import heights_of

from ardee_common.ros_graph import RosGraph


def test_the_brightest_pixel_stands_at_size_z(graph: RosGraph) -> None:
    found = heights_of(graph, "heightmap-not-white/ground.sdf", [(-10, 8), (0.5, -8.2), (10, 8)])
    assert found == pytest.approx([0.0, 1.5, 3.0], abs=0.05)
