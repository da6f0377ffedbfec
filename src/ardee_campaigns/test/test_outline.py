# SPDX-License-Identifier: MIT
"""Tests a robot's outline and the stalks that it touches against closed forms."""
import math

import ardee_sim
import numpy as np
import pytest

from ardee_campaigns.outline import Contacts, convex_hull, depths_m, outline_of, rectangle
from ardee_common.errors import GeneratorError
from ardee_world.row_truth import Pose, Stalks

URDF = """<robot name="r"><link name="base"><collision><geometry><box size="0.4 0.2 0.1"/></geometry></collision></link>
<link name="arm"><collision><origin xyz="0 0 0.1"/><geometry>{shape}</geometry></collision></link>
<joint name="j" type="fixed"><parent link="base"/><child link="arm"/><origin xyz="0.3 0 0" rpy="0 0 {yaw}"/></joint>
</robot>"""


def test_the_hull_of_points_leaves_out_those_inside() -> None:
    points = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0.5, 0.5], [0.5, 0.0]])
    assert sorted(map(tuple, convex_hull(points))) == [(0, 0), (0, 1), (1, 0), (1, 1)]


@pytest.mark.parametrize(
    "shape, yaw, ahead, aside",
    [
        ('<box size="0.1 0.6 0.1"/>', 0.0, 0.35, 0.3),
        ('<box size="0.1 0.6 0.1"/>', math.pi / 2, 0.6, 0.1),
        ('<cylinder radius="0.25" length="1"/>', 0.0, 0.55, 0.25),
        ('<sphere radius="0.05"/>', 0.0, 0.35, 0.1),
    ],
)
def test_the_outline_is_that_of_all_collision_bodies(
    shape: str, yaw: float, ahead: float, aside: float
) -> None:
    outline = outline_of(URDF.format(shape=shape, yaw=yaw))
    assert outline[:, 0].min() == pytest.approx(-0.2)
    assert outline[:, 0].max() == pytest.approx(ahead)
    assert np.abs(outline[:, 1]).max() == pytest.approx(aside)


def test_terrasentia_is_as_wide_and_as_long_as_its_wheels_stand() -> None:
    outline = outline_of(ardee_sim.robot("tsv1_default"))
    assert np.ptp(outline[:, 1]) == pytest.approx(0.4702, abs=0.001)
    assert outline[:, 0].max() == pytest.approx(0.2666, abs=0.001)


@pytest.mark.parametrize("text", ["<robot", "<robot name='r'><link name='a'/></robot>"])
def test_a_model_without_collision_body_is_refused(text: str) -> None:
    with pytest.raises(GeneratorError, match="outline"):
        outline_of(text)


def test_depths_are_those_of_circles_in_a_rectangle() -> None:
    places = np.array([[0.0, 0.5], [0.6, 0.0], [0.8, 0.9], [0.0, 0.0]])
    found = depths_m(rectangle(1.0, 1.0), places, np.full(4, 0.1))
    assert found == pytest.approx([0.1, 0.0, 0.1 - 0.5, 0.6])


def test_a_contact_counts_once_while_it_lasts() -> None:
    stalks = Stalks(np.array([[0.0, 0.3], [5.0, 0.0]]), np.array([0.01, 0.01]))
    contacts = Contacts(rectangle(1.0, 0.5), stalks)
    counts = [contacts.update(Pose(0.0, y, math.pi)) for y in (0.0, 0.05, 0.06, 0.0, 0.1)]
    assert counts == [0, 1, 1, 0, 1]
    assert contacts.collisions == 2
    assert (contacts.touched, contacts.knocked) == ({0}, {0})
