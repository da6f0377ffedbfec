# SPDX-License-Identifier: MIT
from distutils.core import setup

from catkin_pkg.python_setup import generate_distutils_setup

setup(
    **generate_distutils_setup(
        packages=[
            "ardee_models",
            "ardee_models.plant",
            "ardee_models.prepare",
            "ardee_models.report",
            "ardee_models.terrain",
        ],
        package_dir={"": "src"},
    )
)
