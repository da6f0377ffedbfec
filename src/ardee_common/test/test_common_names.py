# SPDX-License-Identifier: MIT
"""Tests that a wrong name is answered by the right names that are nearest to it."""
import pytest

from ardee_common.errors import known_names

MODELS = [f"corn_variant_{number}" for number in range(1, 23)] + ["sorghum_variant_1", "weed_a"]


@pytest.mark.parametrize(
    "name, known, text",
    [
        ("dpeth", ["width", "depth"], "known: depth, width; did you mean 'depth'?"),
        (
            "rows",
            ["row_shape", "cross_rows", "rows_per_plot"],
            "known: rows_per_plot, cross_rows, ",
        ),
        ("sorgum_variant_1", MODELS, "nearest of 24: sorghum_variant_1, corn_variant_1, "),
        ("qqq", ["width", "depth"], "known: width, depth"),
        ("any", [], "known: none"),
    ],
)
def test_nearest_names_come_first(name, known, text) -> None:
    assert known_names(name, known).startswith(text)


def test_of_many_names_only_some_are_listed() -> None:
    assert known_names("weed_b", MODELS).count(",") == 4


def test_nothing_is_guessed_of_a_name_unlike_all() -> None:
    assert "did you mean" not in known_names("qqq", ["width", "depth"])
    assert "did you mean" not in known_names("x", ["axis_camera", "xtion_pro"])
