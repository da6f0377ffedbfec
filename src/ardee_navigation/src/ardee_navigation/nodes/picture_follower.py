# SPDX-License-Identifier: MIT
"""The row follower by camera in the node row_follower: Image in, and what it sees for rviz drawn on the picture."""
import numpy as np
import rospy
from sensor_msgs.msg import Image

from ardee_common.errors import GeneratorError
from ardee_navigation.vision import Output, VisionFollower, VisionParameters
from ardee_navigation.vision.overlay import drawn

_CHANNELS = {"rgb8": slice(None), "bgr8": slice(None, None, -1)}


def rgb_of(image: Image) -> np.ndarray:
    """Returns the pixels of an image, uint8[h, w, 3] in red, green, blue."""
    if image.encoding not in _CHANNELS:
        raise GeneratorError(f"found a picture in {image.encoding!r}, expected rgb8 or bgr8")
    expected = image.height * image.step
    if len(image.data) != expected or image.step < 3 * image.width or not expected:
        size = f"{image.width} x {image.height} pixels, {image.step} bytes a row"
        raise GeneratorError(f"found a picture of {size}, with {len(image.data)} bytes")
    rows = np.frombuffer(image.data, np.uint8).reshape(image.height, image.step)
    pixels = rows[:, : 3 * image.width].reshape(image.height, image.width, 3)
    return np.ascontiguousarray(pixels[:, :, _CHANNELS[image.encoding]])


class PictureFollower:
    """Answers pictures and publishes them with the rows found."""

    message, readings = Image, "pictures"

    def __init__(self, parameters: VisionParameters) -> None:
        self._parameters, self._follower = parameters, VisionFollower(parameters)
        self._overlay = rospy.Publisher("~overlay", Image, queue_size=1)
        self.reset = self._follower.reset

    def update(self, image: Image, time_s: float) -> Output:
        """Returns the answer to a picture taken at `time_s`."""
        return self._follower.update(rgb_of(image), time_s)

    def show(self, image: Image, output: Output) -> None:
        """Publishes the picture with what was seen in it, if anyone looks."""
        if not self._overlay.get_num_connections():
            return
        rgb = drawn(rgb_of(image), output, self._parameters)
        height, width, _ = rgb.shape
        self._overlay.publish(
            Image(image.header, height, width, "rgb8", 0, 3 * width, rgb.tobytes())
        )
