# SPDX-License-Identifier: MIT
"""Lets the tests import the package's scripts."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "scripts"))
