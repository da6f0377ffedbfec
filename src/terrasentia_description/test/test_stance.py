# SPDX-License-Identifier: MIT
"""Tests the stance of the robot: kinematics, and the statics of its springs by an independent route (virtual work)."""
from typing import Dict

import numpy as np
import pytest
from generations import Generation
from robot_urdf import Robot, numbers
from scipy.optimize import fsolve

PLACES = ["front_left", "front_right", "rear_left", "rear_right"]
GRAVITY = 9.81  # m/s^2
WHEEL_RADIUS = 0.097  # m


def wheel_centers(robot: Robot, legs: Dict[str, float]) -> np.ndarray:
    """Returns centres of the wheels' bodies (4, 3) in base_footprint, m."""
    return np.array([robot.center_of_mass(f"{place}_wheel_link", legs) for place in PLACES])


def leg_positions(robot: Robot, front: float, rear: float) -> Dict[str, float]:
    """Returns joint positions of legs deflected by `front` and `rear` (rad >= 0) from extended to their limits."""
    positions = {}
    for place in PLACES:
        joint = f"{place}_leg_joint"
        limit = robot.joints[joint].find("limit")
        lower, extended = float(limit.get("lower")), robot.spring_reference(joint)
        sign = 1 if extended == lower else -1
        positions[joint] = extended + sign * (front if place.startswith("front") else rear)
    return positions


def resting_deflections(robot: Robot, stiffness: float) -> np.ndarray:
    """Returns front and rear deflections (rad) that hold the robot up, wheels free to roll.

    The potential energy of the springs and of all weights, heights counted from the ground under the wheels,
    is stationary; the robot may pitch, so heights are taken along the ground's normal. stiffness: of a leg, N m/rad.
    """

    def energy(front: float, rear: float) -> float:
        legs = leg_positions(robot, front, rear)
        wheels = wheel_centers(robot, legs)
        forward = wheels[0] - wheels[2]
        up = np.array([-forward[2], 0, forward[0]]) / np.hypot(forward[0], forward[2])
        ground = wheels[0] @ up - WHEEL_RADIUS
        weights = sum(
            robot.mass(link) * (robot.center_of_mass(link, legs) @ up - ground)
            for link in robot.links
        )
        return GRAVITY * weights + stiffness * (front**2 + rear**2)

    def slope(deflections: np.ndarray) -> list:
        front, rear = deflections
        h = 1e-4
        return [
            energy(front + h, rear) - energy(front - h, rear),
            energy(front, rear + h) - energy(front, rear - h),
        ]

    return fsolve(slope, [0.01, 0.01], xtol=1e-10)


def height(robot: Robot, front: float, rear: float) -> float:
    """Returns the height of base_footprint above the ground, m, midway between front and rear wheels."""
    return WHEEL_RADIUS - wheel_centers(robot, leg_positions(robot, front, rear))[:, 2].mean()


@pytest.fixture
def deflections(robot: Robot, generation: Generation) -> np.ndarray:
    """Returns front and rear deflections of the standing robot."""
    return resting_deflections(robot, generation.stiffness)


def test_wheels_are_where_the_drive_expects_them(robot: Robot, generation: Generation):
    extended = leg_positions(robot, 0, 0)
    left_front, right_front, left_rear, right_rear = wheel_centers(robot, extended)
    assert left_front - right_front == pytest.approx([0, 0.4318, 0], abs=1e-6)
    assert left_rear - right_rear == pytest.approx([0, 0.4318, 0], abs=1e-6)
    assert left_front - left_rear == pytest.approx([generation.wheelbase, 0, 0], abs=1e-3)
    assert left_front + right_rear == pytest.approx([0, 0, 2 * left_front[2]], abs=1e-6)


def test_every_axle_points_left_so_that_a_positive_speed_drives_forward(robot: Robot):
    for place in PLACES:
        axis = numbers(robot.joints[f"{place}_wheel_rev"].find("axis").get("xyz"))
        axle = robot.frame(f"{place}_wheel_link")[:3, :3] @ axis
        assert axle == pytest.approx([0, 1, 0], abs=1e-9)


def test_extended_legs_hold_the_robot_a_little_higher(robot: Robot):
    assert 0.175 < height(robot, 0, 0) < 0.195


def test_at_rest_the_chassis_is_as_high_as_the_footprint_offset(
    robot: Robot, generation: Generation, deflections: np.ndarray
):
    front, rear = deflections
    assert height(robot, front, rear) == pytest.approx(0.175, abs=2e-4)
    # A leg at the heavier end yields more.
    assert 0 < (front - rear) * generation.heavy_end < 0.03


def test_at_rest_the_springs_carry_tau_over_k(
    robot: Robot, generation: Generation, deflections: np.ndarray
):
    """The mean of front and rear follows from a wheel's mean load and the levers of the front left leg."""
    mean = deflections.mean()
    wheel_load = GRAVITY * (generation.mass / 4 - generation.wheel_mass)
    legs = leg_positions(robot, mean, mean)
    hinge = robot.frame("front_left_leg_link")[0, 3]
    moment = wheel_load * (wheel_centers(robot, legs)[0][0] - hinge)
    for link in ("front_left_leg_link", "encoder_fl_link"):
        moment -= GRAVITY * robot.mass(link) * (robot.center_of_mass(link, legs)[0] - hinge)
    assert mean == pytest.approx(moment / generation.stiffness, rel=0.02)


def test_at_rest_the_legs_touch_no_stop(generation: Generation, deflections: np.ndarray):
    for deflection in deflections:
        assert 0.005 < deflection < generation.leg_travel - 0.1


def test_weight_turns_each_leg_from_its_reference_into_its_range(
    robot: Robot, generation: Generation
):
    extended = wheel_centers(robot, leg_positions(robot, 0, 0))
    for place in PLACES:
        joint = f"{place}_leg_joint"
        limit = robot.joints[joint].find("limit")
        limits = float(limit.get("lower")), float(limit.get("upper"))
        assert robot.spring_reference(joint) in limits
        far = leg_positions(robot, generation.leg_travel, generation.leg_travel)
        assert far[joint] == pytest.approx(sum(limits) - robot.spring_reference(joint))
        index = PLACES.index(place)
        assert wheel_centers(robot, far)[index][2] > extended[index][2] + 0.03


def test_a_robot_on_soft_springs_appears_standing(robot: Robot, generation: Generation):
    """All joints are at 0 in a spawned robot: v3 has its height at rest, the others stand a little higher."""
    at_zero = WHEEL_RADIUS - wheel_centers(robot, {})[:, 2].mean()
    if generation.appears_at_rest:
        assert at_zero == pytest.approx(0.175, abs=2e-4)
    else:
        assert at_zero == pytest.approx(height(robot, 0, 0))
    assert at_zero < 0.18


def test_legs_stay_outside_the_chassis_and_inside_the_wheels(robot: Robot, generation: Generation):
    for share in (0.0, 0.5, 1.0):
        legs = leg_positions(robot, *(2 * [share * generation.leg_travel]))
        for place in PLACES:
            link = f"{place}_leg_link"
            collision = robot.links[link].find("collision")
            thickness = numbers(collision.find("geometry/box").get("size"))[2]
            middle = abs(robot.center_of_mass(link, legs)[1])
            wheel = abs(wheel_centers(robot, legs)[PLACES.index(place)][1])
            assert generation.chassis_box[1] / 2 < middle - thickness / 2
            assert middle + thickness / 2 < wheel - generation.wheel_depth / 2


def test_at_full_travel_the_belly_clears_the_ground(robot: Robot, generation: Generation):
    belly = generation.chassis_z - generation.chassis_box[2] / 2
    assert height(robot, *(2 * [generation.leg_travel])) + belly > 0.05
