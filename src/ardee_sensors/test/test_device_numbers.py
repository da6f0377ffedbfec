# SPDX-License-Identifier: MIT
"""Tests that every number in config/ has a unit in its name, the mark of a known source, and a possible value."""
import math
import pathlib

import pytest
from device_numbers import CONFIG, SHARED, TEXTS, devices, load, read_numbers, sources

from ardee_common.errors import GeneratorError

COUNTS = ("samples", "vertical_samples", "sub_rays")
OF_FULL_SCALE = ("noise_std",)  # noise of an image's channels: no unit
MIXED = ("noise",)  # noise of an IMU's quaternion, rad/s and m/s2 alike
UNITLESS = COUNTS + OF_FULL_SCALE + MIXED + ("depth_noise_linear", "detection_noise")
UNITS = (
    "_m _rad _deg _hz _kg _px _v _s _count _a _a_h _a_s_per_m _a_s_per_rad _ohm "
    "_m_s _rad_s _rad_s2 _m_s2 _t _n_m _n_m_s_per_rad _m_per_m _per_m"
).split()


def values(text: str) -> list:
    return [float(word) for word in text.split()]


@pytest.mark.parametrize("device", devices())
def test_every_number_has_unit_and_source(device: str):
    known = sources()
    numbers = read_numbers(CONFIG / f"{device}.yaml")
    assert numbers
    for number in numbers:
        assert number.key in UNITLESS or number.key.endswith(tuple(UNITS)), number.key
        assert number.marks, f"{number.key}: no [mark]"
        for mark in number.marks:
            assert mark.split()[0] in known, f"{number.key}: unknown mark [{mark}]"
        assert all(map(math.isfinite, values(number.value)))


@pytest.mark.parametrize("device", devices())
def test_the_lines_and_the_yaml_say_the_same(device: str):
    loaded = load(device)
    numbers = {n.key: values(n.value) for n in read_numbers(CONFIG / f"{device}.yaml")}
    assert set(loaded) == set(numbers) | (set(loaded) & set(TEXTS))
    for key, value in numbers.items():
        assert values(str(loaded[key])) == value


@pytest.mark.parametrize("device", devices())
def test_texts(device: str):
    loaded = load(device)
    assert loaded["macro"] == f"sensor_{device}"
    assert loaded["device"] and loaded["kind"] and loaded["topics"]
    for kind, _ in loaded["topics"].values():
        assert kind.count("/") == 1
    assert set(loaded.get("also", "").split()) <= set(devices())


@pytest.mark.parametrize("device", devices())
def test_ranges_are_ranges(device: str):
    numbers = load(device)
    for low, high in (
        ("range_min_m", "range_max_m"),
        ("depth_min_m", "depth_max_m"),
        ("clip_near_m", "clip_far_m"),
        ("vertical_min_angle_rad", "vertical_max_angle_rad"),
    ):
        assert (low in numbers) == (high in numbers)
        if low in numbers:
            assert numbers[low] < numbers[high]
    if "reflectivity_range_m" in numbers:
        assert numbers["range_min_m"] < numbers["reflectivity_range_m"] <= numbers["range_max_m"]
    for key, value in numbers.items():
        positive = ("rate_hz", "mass_kg", "size_x_m", "size_y_m", "size_z_m", "_px")
        if key.endswith(positive) or key in COUNTS:
            assert value > 0, key
        if "noise" in key and not isinstance(value, str):
            assert value >= 0, key


def test_every_source_is_cited():
    cited = {
        mark.split()[0]
        for path in CONFIG.glob("*.yaml")
        if path.stem not in SHARED
        for number in read_numbers(path)
        for mark in number.marks
    }
    assert cited == set(sources())


def test_a_line_that_is_no_number_is_named(tmp_path: pathlib.Path):
    bad = tmp_path / "bad.yaml"
    bad.write_text("rate_hz: 40  # [N]\nrate hz 30\n")
    with pytest.raises(GeneratorError, match=r"bad.yaml:2: found 'rate hz 30'"):
        read_numbers(bad)


def test_an_unknown_device_is_refused_with_the_known_ones():
    with pytest.raises(
        GeneratorError, match=r"unknown sensor 'hokuyo', nearest of \d+: .*hokuyo_ust10lx"
    ):
        load("hokuyo")
