# SPDX-License-Identifier: MIT
"""A page in the browser that shows a simulation and drives a robot: `python3 -m ardee_sim.view WORLD --robot NAME`.

Needs viser: the extra [view] of the wheel; scripts/setup installs it for the workspace.
"""

try:
    from ardee_sim.view.viewer import Viewer, play, view
except ModuleNotFoundError as error:
    raise ModuleNotFoundError(
        f"{error}, which ardee_sim.view needs; expected: pip install viser, or the wheel with its extra [view]"
    ) from error

__all__ = ["Viewer", "play", "view"]
