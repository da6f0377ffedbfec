# SPDX-License-Identifier: MIT
"""A mesh of quadrilaterals, a block of 1 x 2 x 3 m whose corner is the origin: its top lies at 3 m."""
import pytest
from heights import heights_of

from ardee_common.ros_graph import RosGraph


def test_quadrilaterals_are_met(graph: RosGraph) -> None:
    found = heights_of(graph, "mesh-quads/block.sdf", [(0.5, 1.0), (0.1, 1.9), (1.5, 1.0)])
    assert found == pytest.approx([3.0, 3.0, 0.0], abs=1e-3)
