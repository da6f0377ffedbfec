# SPDX-License-Identifier: MIT
"""Tests that no input of scripts/fuzz raises an exception that its target does not expect of bad input."""
from pathlib import Path
from typing import Callable

import pytest
from fuzz_python import corpus


@pytest.mark.parametrize(
    "target, path", corpus("ardee_models"), ids=lambda value: getattr(value, "name", "")
)
def test_corpus(target: Callable[[bytes], None], path: Path) -> None:
    target(path.read_bytes())
