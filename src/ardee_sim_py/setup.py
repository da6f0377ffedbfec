# SPDX-License-Identifier: MIT
from distutils.core import setup

from catkin_pkg.python_setup import generate_distutils_setup

setup(
    **generate_distutils_setup(
        packages=["ardee_sim", "ardee_sim.envs", "ardee_sim.examples", "ardee_sim.view"],
        package_dir={"": "src"},
        package_data={"ardee_sim": ["_core.pyi", "py.typed", "examples/*.npz"]},
    )
)
