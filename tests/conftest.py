# SPDX-License-Identifier: MIT
"""Fixtures of the system tests."""
import pathlib
from typing import Iterator

import pytest

from ardee_common.ros_graph import RosGraph


def _graph(folder: pathlib.Path) -> Iterator[RosGraph]:
    graph = RosGraph(folder)
    try:
        yield graph
    finally:
        logs = graph.logs()
        left = graph.close()
        print(logs)
    assert not left, f"processes left behind: {left}"


@pytest.fixture
def graph(tmp_path: pathlib.Path) -> Iterator[RosGraph]:
    """Yields a ROS graph of a test's own."""
    yield from _graph(tmp_path)


@pytest.fixture(scope="module")
def shared_graph(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RosGraph]:
    """Yields one ROS graph for all tests of a file."""
    yield from _graph(tmp_path_factory.mktemp("graph"))
