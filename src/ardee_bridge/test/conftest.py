# SPDX-License-Identifier: MIT
"""Makes the package importable from the source tree."""

import sys
from pathlib import Path
from typing import Any, Iterator

import pytest

PACKAGE = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(PACKAGE / "src"))


@pytest.fixture(scope="session")
def package() -> Path:
    """Returns the source folder of ardee_bridge."""
    return PACKAGE


@pytest.fixture
def bench(request: pytest.FixtureRequest) -> Iterator[Any]:
    """Yields a test file's own `Bench`, closed after the test."""
    made = request.module.Bench()
    yield made
    made.close()
