# SPDX-License-Identifier: MIT
"""Meshes of devices other than lidars and cameras, and of the board in the scene that shows the sensors."""
import numpy as np
from device_numbers import load
from mesh_cameras import barrel
from mesh_shapes import box, lathe, turn


def gps() -> np.ndarray:
    """Round antenna under a flat dome."""
    numbers = load("gps")
    radius, height = numbers["size_x_m"] / 2, numbers["size_z_m"]
    heights = np.linspace(0, 1, 7)
    dome = [(radius * max(np.sqrt(1 - h * h), 0.05), height * (0.35 + 0.65 * h)) for h in heights]
    return lathe([(0.9 * radius, 0), (radius, 0.2 * height), *dome], 48)


def imu(device: str, chip: tuple, places: tuple) -> np.ndarray:
    """Printed board of the device with a chip of a size (x y) at each place, and a connector."""
    numbers = load(device)
    size_x, size_y, height = (numbers[f"size_{axis}_m"] for axis in "xyz")
    board = box((size_x, size_y, 0.0016), (0, 0, 0.0008))
    chips = [box((*chip, 0.001), (x, y, 0.0021)) for x, y in places]
    plug = box((0.006, 0.016, height - 0.0016), (-size_x / 2 + 0.005, 0, (height + 0.0016) / 2))
    return np.concatenate([board, *chips, plug])


def magnetometer() -> np.ndarray:
    """Chip on a board."""
    numbers = load("magnetometer")
    size = tuple(numbers[f"size_{axis}_m"] for axis in "xyz")
    return box(size, (0, 0, size[2] / 2))


def sonar() -> np.ndarray:
    """Upright board with transmitter and receiver."""
    numbers = load("sonar")
    size_x, size_y, size_z = (numbers[f"size_{axis}_m"] for axis in "xyz")
    board = box((0.002, size_y, size_z), (-size_x / 2 + 0.001, 0, size_z / 2))
    eyes = [barrel(0.008, size_x - 0.002, (size_x / 2, y, size_z / 2)) for y in (-0.0125, 0.0125)]
    return np.concatenate([board, *eyes])


def approx_battery() -> np.ndarray:
    """Brick in a shrink tube."""
    numbers = load("approx_battery")
    size = tuple(numbers[f"size_{axis}_m"] for axis in "xyz")
    return box(size, (0, 0, size[2] / 2), corner=0.004, edge=0.003)


def encoder() -> np.ndarray:
    """Square flange and a round can along x."""
    numbers = load("encoder")
    size_x, size_y, size_z = (numbers[f"size_{axis}_m"] for axis in "xyz")
    flange = box((0.008, size_y, size_z), (-size_x / 2 + 0.004, 0, size_z / 2))
    can = barrel(0.45 * size_y, size_x - 0.008, (size_x / 2, 0, size_z / 2))
    return np.concatenate([flange, can])


def checkerboard_black(squares: tuple = (8, 6), side_m: float = 0.25) -> np.ndarray:
    """The black squares of a board in the plane x = 0 that faces -x, its middle at the origin."""
    tiles = []
    for column in range(squares[0]):
        for row in range(squares[1]):
            if (column + row) % 2 == 0:
                middle = (column - (squares[0] - 1) / 2, row - (squares[1] - 1) / 2)
                tiles.append(box((side_m, side_m, 0.002)) + (*np.multiply(middle, side_m), 0))
    upright = turn(turn(np.concatenate(tiles), 2, np.pi / 2), 1, -np.pi / 2)
    return upright


def meshes() -> dict:
    """All other meshes by file name."""
    return {
        "antenna_3GO16.stl": gps(),
        "imu.stl": imu("imu", (0.004, 0.004), ((0.006, 0), (-0.004, 0.006), (-0.004, -0.006))),
        "imu_bno055.stl": imu("imu_bno055", (0.0052, 0.0038), ((0, 0),)),
        "magnetometer.stl": magnetometer(),
        "sonar.stl": sonar(),
        "approx_battery.stl": approx_battery(),
        "encoder.stl": encoder(),
        "checkerboard_black.stl": checkerboard_black(),
    }
