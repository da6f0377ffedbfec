# SPDX-License-Identifier: MIT
"""Pictures as ROS sends them: colours in their order, and none that is not whole."""
import numpy as np
import pytest
from sensor_msgs.msg import Image

from ardee_common.errors import GeneratorError
from ardee_navigation.nodes.picture_follower import rgb_of

RGB = np.arange(24, dtype=np.uint8).reshape(2, 4, 3)


def image(encoding: str, pixels: np.ndarray, **fields: int) -> Image:
    """Returns a message whose rows end in two bytes that are no pixels."""
    data = np.pad(pixels.reshape(2, 12), ((0, 0), (0, 2))).tobytes()
    return Image(**{**dict(encoding=encoding, height=2, width=4, step=14, data=data), **fields})


def test_colours_come_in_the_order_of_the_encoding() -> None:
    assert (rgb_of(image("rgb8", RGB)) == RGB).all()
    assert (rgb_of(image("bgr8", RGB[:, :, ::-1])) == RGB).all()


@pytest.mark.parametrize(
    "encoding, fields, found",
    [
        ("mono8", {}, "'mono8', expected rgb8 or bgr8"),
        ("rgb8", {"height": 3}, "4 x 3 pixels, 14 bytes a row, with 28 bytes"),
        ("rgb8", {"width": 5}, "5 x 2 pixels, 14 bytes a row, with 28 bytes"),
        ("rgb8", {"height": 0, "data": b""}, "4 x 0 pixels, 14 bytes a row, with 0 bytes"),
    ],
)
def test_a_picture_that_is_not_whole_is_refused(encoding: str, fields: dict, found: str) -> None:
    with pytest.raises(GeneratorError, match=found):
        rgb_of(image(encoding, RGB, **fields))
