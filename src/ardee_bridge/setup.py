# SPDX-License-Identifier: MIT
from distutils.core import setup

from catkin_pkg.python_setup import generate_distutils_setup

packages = ["ardee_bridge", "ardee_bridge.nodes", "ardee_bridge.wire"]
setup(**generate_distutils_setup(packages=packages, package_dir={"": "src"}))
