# SPDX-License-Identifier: MIT
"""What the axes and buttons of a joystick drive."""
import pathlib
from typing import Any, Dict

import pytest
import yaml

from teleop_twist_joy.mapping import Mapping, read_mapping

CONFIG = pathlib.Path(__file__).resolve().parents[1] / "config"


def mapping(**parameters: Any) -> Mapping:
    """The mapping of these parameters."""
    return read_mapping(lambda name, default: parameters.get(name, default))


def velocity(of: Mapping, axes: list, *held: int) -> Dict[str, float]:
    """Velocity with these axes and these of 12 buttons held."""
    return of.velocity(axes, [int(number in held) for number in range(12)])


def test_defaults():
    assert velocity(mapping(), [0.5, 1.0], 0) == {"x": 0.5, "yaw": 0.25}
    assert velocity(mapping(), [0.5, 1.0]) is None


def test_the_numbers_of_the_robots_launch_file():
    xbox = mapping(enable_button=7, axis_angular=2, scale_linear=1, scale_angular=1.5)
    assert velocity(xbox, [0.0, 0.6, -0.4], 7) == pytest.approx({"x": 0.6, "yaw": -0.6})
    assert velocity(xbox, [0.0, 0.6, -0.4], 0, 1, 2, 3, 4, 5, 6, 8, 9, 10, 11) is None


def test_turbo_goes_before_the_enable_button():
    fast = mapping(enable_turbo_button=5, scale_linear_turbo=1.2, scale_angular=0.4)
    assert velocity(fast, [1.0, 1.0], 5) == pytest.approx({"x": 1.2, "yaw": 0.4})
    assert velocity(fast, [1.0, 1.0], 0, 5) == pytest.approx({"x": 1.2, "yaw": 0.4})
    assert velocity(fast, [1.0, 1.0], 0) == pytest.approx({"x": 0.5, "yaw": 0.4})


def test_maps_drive_in_every_direction():
    full = mapping(
        axis_linear={"x": 1, "y": 0},
        scale_linear={"x": 0.7, "y": 0.3},
        scale_linear_turbo={"x": 1.5},
        axis_angular={"yaw": 2, "pitch": -1},
        scale_angular={"yaw": 0.4, "pitch": 1.0},
        enable_turbo_button=1,
    )
    assert velocity(full, [1.0, 0.5, -1.0], 0) == pytest.approx(
        {"x": 0.35, "y": 0.3, "yaw": -0.4, "pitch": 0.0}
    )
    assert velocity(full, [1.0, 0.5, -1.0], 1) == pytest.approx(
        {"x": 0.75, "y": 0.0, "yaw": -0.4, "pitch": 0.0}
    )


def test_axes_and_buttons_that_the_joystick_does_not_have():
    assert mapping().velocity([], [1]) == {"x": 0.0, "yaw": 0.0}
    assert mapping().velocity([float("nan"), float("inf")], [1]) == {"x": 0.0, "yaw": 0.0}
    assert mapping(enable_button=7).velocity([1.0, 1.0], [1]) is None
    assert mapping(enable_button=-1).velocity([1.0, 1.0], [1]) is None


@pytest.mark.parametrize("file", sorted(CONFIG.iterdir()), ids=lambda file: file.name)
def test_configurations_can_be_read(file: pathlib.Path):
    read = mapping(**yaml.safe_load(file.read_text()))
    driven = velocity(read, [0.0, 1.0], read.enable_button)
    turbo = velocity(read, [0.0, 1.0], read.enable_turbo_button)
    assert 0 < driven["x"] < turbo["x"] <= 1.2


@pytest.mark.parametrize(
    "parameters, message",
    [
        ({"axis_linear": {"forward": 1}}, "unknown 'forward'; expected some of x, y, z"),
        ({"axis_linear": {"x": 1.5}}, "axis_linear/x: 1.5; expected a whole number"),
        ({"enable_button": "seven"}, "enable_button: 'seven'; expected a whole number"),
        ({"scale_angular": float("nan")}, "scale_angular/yaw: nan; expected a number"),
        ({"axis_angular": {"yaw": 2}, "scale_angular": 1.5}, "expected a map"),
    ],
)
def test_a_wrong_parameter_is_named(parameters: Dict[str, Any], message: str):
    with pytest.raises(ValueError, match=message.replace("'", ".")):
        mapping(**parameters)
