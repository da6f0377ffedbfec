# SPDX-License-Identifier: MIT
"""Finds the extension of a catkin workspace also where the sources come first on sys.path, as in a spawned process."""

import pkgutil
import sys

_package = sys.modules["ardee_sim"]
_package.__path__ = pkgutil.extend_path(_package.__path__, "ardee_sim")
