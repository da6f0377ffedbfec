# SPDX-License-Identifier: MIT
from distutils.core import setup

from catkin_pkg.python_setup import generate_distutils_setup

setup(
    **generate_distutils_setup(
        packages=[
            "ardee_navigation",
            "ardee_navigation.evaluation",
            "ardee_navigation.lane_following",
            "ardee_navigation.lbirnt",
            "ardee_navigation.nodes",
            "ardee_navigation.training",
            "ardee_navigation.vision",
        ],
        package_dir={"": "src"},
        package_data={"ardee_navigation.vision": ["*.onnx"]},
    )
)
