# SPDX-License-Identifier: MIT
"""Tests that the services and topics in docs/support.md agree with a running simulator."""
import pathlib
from typing import Dict, Iterator, Tuple

import probes
import pytest

from ardee_common.ros_graph import RosGraph

ROOT = pathlib.Path(__file__).parents[1]
PAGE = (ROOT / "docs" / "support.md").read_text()
WORLD = ROOT / "tests" / "data" / "plane.world"
OF_ROSCPP = ("get_loggers", "set_logger_level")
NOT_OURS = ("/rosout", "/tf_static")  # roscpp's, and those of robots, of which there is none


@pytest.fixture(scope="module")
def world(shared_graph: RosGraph) -> Iterator[RosGraph]:
    shared_graph.spawn("rosrun", "ardee_sim_cpp", "simulator", str(WORLD))
    shared_graph.call(probes.clock_at_least, 0.1)
    yield shared_graph


def table(title: str) -> Dict[str, Tuple[str, ...]]:
    """Returns rows of a section of the page by their first column."""
    section = PAGE.split(f"\n## {title}\n")[1].split("\n## ")[0]
    rows = (line.strip("|").split("|") for line in section.splitlines() if line.startswith("| `"))
    return {row[0].strip(" `"): tuple(cell.strip() for cell in row[1:]) for row in rows}


def test_the_page_has_each_service_and_no_other(world: RosGraph) -> None:
    found = world.call(probes.services_of, "/gazebo")
    ours = {name: kind for name, kind in found.items() if not name.endswith(OF_ROSCPP)}
    assert ours == {name: cells[0] for name, cells in table("Services").items()}


def test_the_page_has_each_topic_and_no_other(world: RosGraph) -> None:
    published, subscribed = world.call(probes.topics_of, "/gazebo")
    rows = table("Topics")
    for names, side in ((published, "published"), (subscribed, "subscribed to")):
        ours = {name for name in names if name not in NOT_OURS}
        said = {name for name, cells in rows.items() if cells[1] == side and name not in NOT_OURS}
        assert ours == said, side
