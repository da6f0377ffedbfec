# SPDX-License-Identifier: MIT
"""A page in the browser that shows a simulation and drives a robot: `python3 -m ardee_sim.view WORLD --robot NAME`.

Needs viser: the extra [view] of the wheel; scripts/setup installs it for the workspace.
"""

from typing import Any

from ardee_sim.simulation import Simulation

try:
    from ardee_sim.view.viewer import Viewer
except ModuleNotFoundError as error:
    raise ModuleNotFoundError(
        f"{error}, which ardee_sim.view needs; expected: pip install viser, or the wheel with its extra [view]"
    ) from error

__all__ = ["Viewer", "view"]


def view(sim: Simulation, **options: Any) -> Viewer:
    """Shows a simulation of yours, and returns the Viewer, whose update() is called after each of your steps.

    options : those of Viewer
    Raises ArdeeError if the port is taken.
    """
    return Viewer(sim, **options)
