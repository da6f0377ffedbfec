# SPDX-License-Identifier: MIT
"""A page in the browser that shows a simulation and drives a robot: `python3 -m ardee_sim.view WORLD --robot NAME`.

Needs viser: the extra [view] of the wheel; scripts/setup installs it for the workspace.
"""

import math
from typing import TYPE_CHECKING, Any

from ardee_sim.simulation import Simulation

try:
    from ardee_sim.view.viewer import Viewer
except ModuleNotFoundError as error:
    raise ModuleNotFoundError(
        f"{error}, which ardee_sim.view needs; expected: pip install viser, or the wheel with its extra [view]"
    ) from error

if TYPE_CHECKING:
    from ardee_sim.envs import Episode

__all__ = ["Viewer", "play", "view"]


def view(sim: Simulation, **options: Any) -> Viewer:
    """Shows a simulation of yours, and returns the Viewer, whose update() is called after each of your steps.

    options : those of Viewer
    Raises ArdeeError if the port is taken.
    """
    return Viewer(sim, **options)


def play(episode: "Episode", *, turns: float = math.inf, **options: Any) -> None:
    """Shows a recorded episode again and again, paused at its end, until Ctrl-C or so many turns.

    options : those of Viewer
    """
    env = episode.make()
    viewer = None
    try:
        while turns > 0:
            for _ in episode.play(env):
                sim = env.unwrapped.simulation
                if viewer is None:
                    viewer = Viewer(sim, robot="robot", drive=False, **options)
                    print(f"{viewer.url} (Ctrl-C ends it)", flush=True)
                viewer.update()
            turns -= 1
            if turns > 0 and viewer:
                viewer.wanted.is_paused = True
                viewer.update()
    except KeyboardInterrupt:
        return
    finally:
        if viewer:
            viewer.close()
        env.close()
