# SPDX-License-Identifier: MIT
"""Tests contacts of the robot's outline with stalks against closed forms."""
import math

import numpy as np
import pytest

from ardee_navigation.evaluation.contacts import LENGTH_M, WIDTH_M, Contacts, depths_m
from ardee_world.row_truth import Pose, Stalks


def test_stalks_in_the_outline_by_hand() -> None:
    """The robot is at the origin, turned by 90 degrees: its length lies along y."""
    half_length, half_width = LENGTH_M / 2, WIDTH_M / 2
    xy = [
        [0.0, half_length + 0.05],
        [half_width - 0.01, 0.0],
        [half_width + 0.03, half_length + 0.04],
    ]
    stalks = Stalks(np.array(xy), np.array([0.01, 0.01, 0.02]))
    depth = depths_m(Pose(0.0, 0.0, math.pi / 2), stalks, np.arange(3))
    assert depth == pytest.approx([0.01 - 0.05, 0.01 + 0.01, 0.02 - 0.05])


def test_contacts_count_beginnings_stalks_and_depth() -> None:
    stalks = Stalks(np.array([[1.0, 0.24], [2.0, -0.1], [50.0, 0.0]]), np.full(3, 0.01))
    contacts = Contacts(stalks)
    for x in np.arange(0.0, 3.0, 0.02):
        contacts.update(Pose(float(x), 0.0, 0.0))
    assert contacts.collisions == 2 and contacts.touched == {0, 1} and contacts.knocked == {1}
    contacts.update(Pose(1.0, 0.0, 0.0))  # the first one once more
    assert contacts.collisions == 3 and len(contacts.touched) == 2
