# SPDX-License-Identifier: MIT
"""Tests that the configuration reader names the line, the unknown key and the nearest known one."""
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Tuple

import pytest

from ardee_common.config import build, from_values, read_yaml_lines
from ardee_common.errors import GeneratorError
from ardee_common.options import option, ros_name


@dataclass(frozen=True)
class Ditch:
    """Options of the test."""

    depth_m: float = option(0.5, limits=(0.0, 10.0))
    count: int = option(1, limits=(1, 9))


def read(folder: Path, text: str) -> Ditch:
    """Returns the reader's result for a file of this text."""
    file = folder / "ditch.yaml"
    file.write_text(text)
    return build(Ditch, read_yaml_lines(file))


def test_a_good_file(tmp_path: Path) -> None:
    assert read(tmp_path, "depth_m: 1e-1\n") == Ditch(0.1, 1)


@pytest.mark.parametrize(
    "text, message",
    [
        (
            "count: 2\ndepht_m: 1\n",
            ":2: unknown key 'depht_m', known: depth_m, count; did you mean 'depth_m'?",
        ),
        ("xyz: 1\n", ":1: unknown key 'xyz', known: depth_m, count"),
        ("\ndepth_m: 11\n", ":2: depth_m: found 11, expected 0 to 10 m"),
        ("count: 1\ncount: 2\n", ":2: found key 'count' a second time, first in line 1"),
        (
            "count: 1\n<<: 2\n",
            ":2: <<: found 2, expected a mapping or a list of them",
        ),
        (
            "count: 1\ndepth_m: 1:30\n",
            ":2: found 1:30, which YAML takes for 90, expected a decimal number or a text in quotes",
        ),
        (
            "depth_m: -1:30.5\n",
            ":1: found -1:30.5, which YAML takes for -90.5, expected a decimal number or a text in quotes",
        ),
        (
            "count: [0, 010]\n",
            ":1: found 010, which YAML takes for 8, expected a decimal number or a text in quotes",
        ),
        (
            "010: 1\n",
            ":1: found 010, which YAML takes for 8, expected a decimal number or a text in quotes",
        ),
        ("<<: {count: 2,\n  depth_m: 11}\n", ":2: depth_m: found 11, expected 0 to 10 m"),
    ],
)
def test_bad_files(text: str, message: str, tmp_path: Path) -> None:
    with pytest.raises(GeneratorError) as refused:
        read(tmp_path, text)
    assert str(refused.value) == f"{tmp_path}/ditch.yaml{message}"


def test_a_text_that_looks_like_a_number_stays_one(tmp_path: Path) -> None:
    file = tmp_path / "texts.yaml"
    file.write_text("a: '1:30'\nb: \"010\"\nc: !!str 010\nd: 00:1b\ne: [0, -0.5, 0x10, 1_000]\n")
    texts = {"a": "1:30", "b": "010", "c": "010", "d": "00:1b"}
    assert read_yaml_lines(file) == {**texts, "e": [0, -0.5, 16, 1000]}


def test_a_few_aliases_are_read(tmp_path: Path) -> None:
    assert read(tmp_path, "depth_m: &depth 2\ncount: *depth\n") == Ditch(2.0, 2)


def test_keys_are_merged_as_yaml_says(tmp_path: Path) -> None:
    """A key of the mapping's own comes first, then those of the mappings in their order."""
    merged = "<<: [{count: 3}, {<<: {depth_m: 3}, count: 4}]\n"
    assert read(tmp_path, merged) == Ditch(3.0, 3)
    assert read(tmp_path, f"{merged}depth_m: 1\n") == Ditch(1.0, 3)


LIST = "[{0}, {0}, {0}, {0}, {0}, {0}, {0}, {0}, {0}, {0}]"


@pytest.mark.parametrize("form", [LIST, "{{<<: " + LIST + "}}"])
def test_aliases_of_aliases_are_refused(tmp_path: Path, form: str) -> None:
    lines = ["a0: &a0 " + form.format("{b: 1}")]
    lines += [f"a{n}: &a{n} {form.format(f'*a{n - 1}')}" for n in range(1, 10)]
    with pytest.raises(
        GeneratorError, match="found aliases that stand for more than 100000 values, expected fewer"
    ):
        read(tmp_path, "\n".join(lines))


@pytest.mark.parametrize(
    "text", ["", "- 1\n", "a: [", "\x00", "a: !!bool maybe", "a: !!timestamp soon"]
)
def test_files_that_are_no_mapping(text: str, tmp_path: Path) -> None:
    with pytest.raises(GeneratorError, match="ditch.yaml"):
        read(tmp_path, text)


@dataclass(frozen=True)
class Field:
    """Groups of options, and an option with a form of its own."""

    topic: str = ros_name()
    ditches: Tuple[Ditch, ...] = field(default=(), metadata={"group": Ditch})


def test_values_that_stand_in_no_file() -> None:
    made = from_values(Field, {"topic": "/a/b", "ditches": [{}, {"count": 2}]})
    assert made == Field("/a/b", (Ditch(), Ditch(count=2)))


@pytest.mark.parametrize(
    "values, message",
    [
        (5, "found 5, expected a mapping of keys to values"),
        ({}, "missing key 'topic'"),
        ({"topic": "a b"}, "topic: found 'a b', expected a ROS name such as ardee/gps"),
        (
            {"topic": "a", "ditches": [{}, {"cuont": 1}]},
            "ditches[1]: unknown key 'cuont', known: count, depth_m; did you mean 'count'?",
        ),
        ({"topic": "a", "ditches": {}}, "ditches: found {}, expected a list"),
    ],
)
def test_bad_values_that_stand_in_no_file(values: Any, message: str) -> None:
    with pytest.raises(GeneratorError) as refused:
        from_values(Field, values)
    assert str(refused.value) == message
