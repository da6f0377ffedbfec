# SPDX-License-Identifier: MIT
"""An elevation model of 32-bit floats as ground, 0.2 + 0.1 column m and 1 m more in the northern 16 of 33 rows, with a
size of 32 32 4.2: heights are elevation - 0.2 m, for the span of elevations is 4.2 m."""
import pytest
from heights import heights_of

from ardee_common.ros_graph import RosGraph


def test_the_least_elevation_lies_at_zero(graph: RosGraph) -> None:
    found = heights_of(
        graph,
        "heightmap-float-tiff/ground.sdf",
        [(-10, 8), (0.5, -8.2), (10, 8), (-3, -12)],
    )
    assert found == pytest.approx([1.6, 1.65, 3.6, 1.3], abs=0.05)
