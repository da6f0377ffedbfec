#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""The old spelling `$(find xacro)/xacro.py` of the script beside this file."""
import pathlib
import runpy

runpy.run_path(str(pathlib.Path(__file__).resolve().with_name("xacro")), run_name="__main__")
