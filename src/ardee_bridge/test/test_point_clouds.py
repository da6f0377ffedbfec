# SPDX-License-Identifier: MIT
"""Tests point clouds of any layout in their form on the wire."""
import math

import numpy as np
import pytest
from sensor_msgs.msg import PointCloud2, PointField

from ardee_bridge.nodes import convert
from ardee_bridge.wire import chunks


def cloud(points, height=1, pad=0):
    kind = np.dtype(
        [("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("ring", "<u2"), ("intensity", "<f4")]
    )
    array = np.zeros(len(points), kind)
    for name, column in zip(("x", "y", "z", "intensity"), np.array(points).T):
        array[name] = column
    width = len(points) // height
    message = PointCloud2(width=width, height=height, point_step=18, row_step=18 * width + pad)
    rows = array.reshape(height, width)
    message.data = b"".join(row.tobytes() + b"\xee" * pad for row in rows)
    fields = (("x", 0, 7), ("y", 4, 7), ("z", 8, 7), ("ring", 12, 4), ("intensity", 14, 7))
    message.fields = [PointField(name, offset, kind, 1) for name, offset, kind in fields]
    return message


@pytest.mark.parametrize("height, pad", [(1, 0), (2, 6)])
def test_point_cloud(height, pad):
    points = [(1.0, -2.5, 0.125, 7.0), (math.nan, 0, 0, 0), (0, 0, math.inf, 1), (3.5, 4, 5, 0.5)]
    frame = convert.point_cloud(cloud(points, height, pad))
    assert chunks.points_si(frame.payload) == [points[0], points[3]]


@pytest.mark.parametrize(
    "offsets, step, order",
    [
        ((0, 4, 8, 12), 16, "<"),  # most lidars: all numbers in a row
        ((0, 4, 8, 12), 22, "<"),
        ((6, 10, 14, 18), 25, "<"),
        ((0, 4, 8, 12), 16, ">"),
        ((0, 4, 8, 16), 32, "<"),
        ((8, 4, 0, 12), 16, "<"),
        ((0, 4, 8), 12, "<"),
        ((0, 4, 8), 16, "<"),
    ],
)
def test_the_numbers_of_clouds_are_found_wherever_they_are(offsets, step, order):
    count = 24_577
    names = ("x", "y", "z", "intensity")[: len(offsets)]
    kind = np.dtype(
        dict(names=names, formats=[order + "f4"] * len(names), offsets=offsets, itemsize=step)
    )
    array = np.frombuffer(b"\xee" * (step * count), kind).copy()
    expected = np.zeros((count, 4))
    for column, name in enumerate(names):
        array[name] = expected[:, column] = np.arange(count) * 0.25 - 1000.0 * column
    fields = [PointField(name, at, 7, 1) for name, at in zip(names, offsets)]
    message = PointCloud2(width=count, height=1, fields=fields, is_bigendian=order == ">")
    message.point_step, message.row_step, message.data = step, step * count, array.tobytes()
    found = np.frombuffer(convert.point_cloud(message).payload, "<i4").reshape(-1, 4)
    assert (found == 1000.0 * expected).all()
    array["y"][[0, 5000]] = math.nan, 1e36
    message.data = array.tobytes()
    found = np.frombuffer(convert.point_cloud(message).payload, "<i4").reshape(-1, 4)
    expected[5000, 1] = (2**31 - 1) / 1000.0
    assert (found == np.rint(1000.0 * expected[1:])).all()


def test_numbers_are_rounded_to_the_nearest_count_that_a_float_can_tell():
    points = np.random.default_rng(1).uniform(-100, 100, (30_000, 4)).astype("<f4")
    message = PointCloud2(width=len(points), height=1, point_step=16, row_step=points.nbytes)
    names = ("x", "y", "z", "intensity")
    message.fields = [PointField(name, 4 * at, 7, 1) for at, name in enumerate(names)]
    message.data = points.tobytes()
    found = np.frombuffer(convert.point_cloud(message).payload, "<i4").reshape(-1, 4)
    exact = 1000.0 * points.astype(float)
    # The rounding of a product of floats is half a unit in the last of 24 bits.
    assert (abs(found - exact) <= 0.5 + abs(exact) * 2.0**-24).all()


def test_malformed_clouds_are_refused():
    good = cloud([(1, 2, 3, 4)] * 4)
    good.data = good.data[:-1]
    with pytest.raises(convert.ConvertError, match="does not fit"):
        convert.point_cloud(good)
    good.fields = good.fields[1:]
    with pytest.raises(convert.ConvertError, match="without field x"):
        convert.point_cloud(good)


@pytest.mark.parametrize("offset", [15, 2**31 - 1, 2**31 - 4, 2**32 - 1])
@pytest.mark.parametrize("index", [0, 4])
def test_a_field_beyond_its_point_is_refused(index, offset):
    bad = cloud([(1, 2, 3, 4)] * 4)
    bad.fields[index].offset = offset
    name = bad.fields[index].name
    with pytest.raises(convert.ConvertError, match=f"{name} at byte {offset}, expected .* 18 of"):
        convert.point_cloud(bad)


@pytest.mark.parametrize("step", [0, 17, 2**31 - 1, 2**32 - 1])
def test_a_step_that_does_not_fit_is_refused(step):
    bad = cloud([(1, 2, 3, 4)] * 4)
    bad.point_step = step
    with pytest.raises(convert.ConvertError, match="a point cloud"):
        convert.point_cloud(bad)
