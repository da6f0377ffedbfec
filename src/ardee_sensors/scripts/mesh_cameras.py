# SPDX-License-Identifier: MIT
"""Meshes of the cameras. Nothing stands before a lens, whose front is in the middle of the camera's front."""
import numpy as np
from device_numbers import load
from mesh_shapes import at_height, box, circle, lathe, loft, turn


def barrel(radius: float, length: float, front: tuple) -> np.ndarray:
    """Cylinder along x whose front face has its middle at `front`."""
    along_z = loft([at_height(circle(radius, 24), -length), at_height(circle(radius, 24), 0)])
    return turn(along_z, 1, np.pi / 2) + front


def bar(device: str, lenses_y_m: list, foot_height_m: float = 0.0) -> np.ndarray:
    """A bar across the view with lens rims on its front, on a foot if it has one."""
    numbers = load(device)
    size_x, size_y, size_z = (numbers[f"size_{axis}_m"] for axis in "xyz")
    rim = 0.002
    depth, height = size_x - rim, size_z - foot_height_m
    middle = (-rim / 2, 0, foot_height_m + height / 2)
    parts = [box((depth, size_y, height), middle, corner=0.3 * depth, edge=0.002)]
    if foot_height_m:
        half = 0.3 * size_x
        parts.append(lathe([(half, 0), (half, 0.01), (0.3 * half, foot_height_m + 0.003)], 24))
    radius = 0.3 * min(height, 0.06)
    parts += [barrel(radius, 2 * rim, (size_x / 2, y, size_z / 2)) for y in lenses_y_m]
    return np.concatenate(parts)


def ueye_cp_gige() -> np.ndarray:
    """Cube with a lens."""
    numbers = load("ueye_cp_gige")
    size_x, size_y, size_z = (numbers[f"size_{axis}_m"] for axis in "xyz")
    lens, radius = numbers["lens_length_m"], numbers["lens_diameter_m"] / 2
    housing = box((size_x - lens, size_y, size_z), (-lens / 2, 0, size_z / 2), edge=0.001)
    middle_z = size_z / 2
    thick = barrel(radius, 0.4 * lens, (size_x / 2, 0, middle_z))
    thin = barrel(0.85 * radius, 0.7 * lens, (size_x / 2 - 0.3 * lens, 0, middle_z))
    return np.concatenate([housing, thin, thick])


def ptz_base(device: str) -> np.ndarray:
    """Round foot of a dome camera."""
    numbers = load(device)
    radius, height = numbers["base_size_x_m"] / 2, numbers["base_size_z_m"]
    profile = [
        (radius, 0),
        (radius, 0.6 * height),
        (0.9 * radius, 0.9 * height),
        (0.8 * radius, height),
    ]
    return lathe(profile, 48)


def ptz_yoke(device: str) -> np.ndarray:
    """Fork that carries the head between its two plates."""
    numbers = load(device)
    size_x, size_y, size_z = (numbers[f"yoke_size_{axis}_m"] for axis in "xyz")
    plate = 0.09 * size_y
    floor = box((size_x, size_y, 0.006), (0, 0, 0.003))
    sides = [
        box((size_x, plate, size_z), (0, sign * (size_y - plate) / 2, size_z / 2))
        for sign in (1, -1)
    ]
    return np.concatenate([floor, *sides])


def ptz_head(device: str) -> np.ndarray:
    """Ball with a flat front where the lens is; its middle is head_size_z_m / 2 above its origin."""
    numbers = load(device)
    radius = numbers["head_size_z_m"] / 2
    angles = np.linspace(-np.pi / 2, np.pi / 2, 13)[1:-1]
    ring = [(0.02 * radius, -radius)]
    ring += [(radius * np.cos(a), radius * np.sin(a)) for a in angles]
    ring += [(0.02 * radius, radius)]
    lens = barrel(0.3 * radius, 0.2 * radius, (radius, 0, radius))
    return np.concatenate([lathe(ring, 24) + (0, 0, radius), lens])


def meshes() -> dict:
    """Meshes of all cameras by file name."""
    found = {
        "ueye_cp_gige.stl": ueye_cp_gige(),
        "asus_xtion_pro.stl": bar("asus_xtion_pro", [-0.07, 0, 0.03]),
        "kinect.stl": bar("kinect", [-0.06, 0, 0.03], foot_height_m=0.03),
        "kinectv2.stl": bar("kinectv2", [0, 0.052]),
        "fotonic.stl": bar("fotonic", [0]),
        "orbbec_astra.stl": bar("orbbec_astra", [-0.03, 0, 0.05]),
        "realsense_d435.stl": bar("realsense_d435", [-0.032, 0, 0.015, 0.03]),
        "zed2.stl": bar("zed2", [-0.06, 0.06]),
    }
    for device in ("axis_m5013", "axis"):
        found[f"{device}_base.stl"] = ptz_base(device)
        found[f"{device}_yoke.stl"] = ptz_yoke(device)
        found[f"{device}_head.stl"] = ptz_head(device)
    return found
