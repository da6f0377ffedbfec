# SPDX-License-Identifier: MIT
"""Meshes of the lidars. No part of a lidar blocks its own rays: a window is free space."""
import numpy as np
from device_numbers import load
from mesh_shapes import at_height, box, circle, lathe, loft, rectangle

SEGMENTS = 36


def _by_heading(outline: np.ndarray) -> np.ndarray:
    """The outline's points, the one of the smallest non-negative heading first."""
    heading = np.arctan2(outline[:, 1], outline[:, 0])
    return np.roll(outline, -int(np.argmin(np.where(heading < -1e-9, np.inf, heading))), axis=0)


def _dome(radius: float, low: float, high: float) -> np.ndarray:
    """Round cap from height low to high."""
    edge = 0.08 * radius
    return lathe(
        [
            (radius * 0.94, low),
            (radius, low + edge),
            (radius, high - 3 * edge),
            (radius * 0.93, high - edge),
            (radius * 0.80, high),
        ],
        SEGMENTS,
    )


def scanner(device: str, base_height_m: float) -> np.ndarray:
    """2D lidar on its mounting face z = 0, the scan's centre at x = y = 0: box, round neck, window, dome.

    The pillar that carries the dome stands in the blind quarter behind.
    """
    numbers = load(device)
    size_x, size_y, height = (numbers[f"size_{axis}_m"] for axis in "xyz")
    slot_low = numbers["scan_height_m"] - numbers["window_height_m"] / 2
    slot_high = slot_low + numbers["window_height_m"]
    side = min(size_x, size_y)
    radius = 0.48 * side
    body = box((size_x, size_y, base_height_m), (0, 0, base_height_m / 2), 0.12 * side, 0.03 * side)
    levels = [
        (rectangle(0.94 * size_x, 0.94 * size_y, 0.12 * side, 8), base_height_m),
        (circle(radius, SEGMENTS), min(base_height_m + 0.1 * side, slot_low)),
        (circle(radius, SEGMENTS), slot_low + 1e-6),
    ]
    # both outlines have 36 points that start on different headings: line the rectangle up with the circle
    neck = loft([at_height(_by_heading(outline), z) for outline, z in levels])
    pillar_height = slot_high - slot_low
    pillar = box(
        (0.1 * side, 0.48 * side, pillar_height),
        (-0.41 * side, 0, slot_low + pillar_height / 2),
    )
    return np.concatenate([body, neck, _dome(radius, slot_high, height), pillar])


def rplidar() -> np.ndarray:
    """RPLIDAR A1: base plate, motor behind, turning head whose upper half floats over the window."""
    numbers = load("rplidar")
    size_x, size_y, height = (numbers[f"size_{axis}_m"] for axis in "xyz")
    slot_low = numbers["scan_height_m"] - numbers["window_height_m"] / 2
    slot_high = slot_low + numbers["window_height_m"]
    axis = np.array([numbers["turret_x_m"], 0, 0])
    radius = numbers["turret_radius_m"]
    plate = box((size_x, size_y, 0.004), (0, 0, 0.002), corner=0.006)
    drum = lathe([(radius - 0.003, 0.004), (radius, 0.02), (radius, slot_low)], SEGMENTS) + axis
    head = lathe(
        [(radius, slot_high), (radius, height - 0.002), (radius - 0.002, height)], SEGMENTS
    )
    motor = lathe([(0.012, 0.004), (0.012, 0.026)], 24) + (-size_x / 2 + 0.014, 0, 0)
    return np.concatenate([plate, drum, head + axis, motor])


def round_3d(device: str) -> np.ndarray:
    """Velodyne: foot below the lowest rays, cap above the highest ones, the window between left out."""
    numbers = load(device)
    radius, height, centre = numbers["size_x_m"] / 2, numbers["size_z_m"], numbers["frame_z_m"]
    low = centre - radius * np.tan(-numbers["vertical_min_angle_rad"]) - 0.001
    high = centre + radius * np.tan(numbers["vertical_max_angle_rad"]) + 0.001
    foot = lathe([(radius * 0.97, 0), (radius, 0.003), (radius, low)], SEGMENTS)
    cap = lathe([(radius, high), (radius, height - 0.003), (radius * 0.95, height)], SEGMENTS)
    return np.concatenate([foot, cap])


def hokuyo3d() -> np.ndarray:
    """YVT: foot, back behind the field of view, head; the mirror looks out between them."""
    numbers = load("hokuyo3d")
    size_x, size_y, height = (numbers[f"size_{axis}_m"] for axis in "xyz")
    foot, head = numbers["foot_height_m"], numbers["head_height_m"]
    back = 0.018
    parts = [
        box((size_x, size_y, foot), (0, 0, foot / 2), corner=0.006, edge=0.002),
        box((size_x, size_y, head), (0, 0, height - head / 2), corner=0.006, edge=0.002),
        box(
            (back, 0.9 * size_y, height - foot - head),
            (-size_x / 2 + back / 2 + 0.003, 0, (height + foot - head) / 2),
        ),
    ]
    return np.concatenate(parts)


def meshes() -> dict:
    """Meshes of all lidars by file name."""
    base_heights_m = {
        "hokuyo_urg04lx": 0.03,
        "hokuyo_ust10lx": 0.026,
        "hokuyo_utm30lx": 0.036,
        "sick_s300": 0.08,
        "sick_s3000": 0.085,
        "sick_tim571": 0.04,
    }
    found = {f"{device}.stl": scanner(device, h) for device, h in base_heights_m.items()}
    found.update({f"{device}.stl": round_3d(device) for device in ("vlp16", "hdl32e")})
    found.update({"rplidar.stl": rplidar(), "hokuyo3d.stl": hokuyo3d()})
    return found
