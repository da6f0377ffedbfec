# SPDX-License-Identifier: MIT
from distutils.core import setup

from catkin_pkg.python_setup import generate_distutils_setup

setup(
    **generate_distutils_setup(
        packages=[
            "ardee_campaigns",
            "ardee_campaigns.examples",
            "ardee_campaigns.experiment",
            "ardee_campaigns.lane",
            "ardee_campaigns.overlay",
            "ardee_campaigns.report",
            "ardee_campaigns.ros",
        ],
        package_dir={"": "src"},
        package_data={
            "ardee_campaigns.examples": ["*.yaml"],
            "ardee_campaigns.lane": ["*.yaml"],
        },
    )
)
