# SPDX-License-Identifier: MIT
from distutils.core import setup

from catkin_pkg.python_setup import generate_distutils_setup

setup(
    **generate_distutils_setup(
        packages=["ardee_datasets", "ardee_datasets.examples"],
        package_dir={"": "src"},
        package_data={"ardee_datasets.examples": ["*.yaml"]},
    )
)
