# SPDX-License-Identifier: MIT
"""Shows a world and a robot in the browser, and drives it."""

import argparse
import sys
from typing import Any, Dict

import ardee_sim


def main() -> None:
    """Runs the command."""
    parser = argparse.ArgumentParser(prog="python3 -m ardee_sim.view", description=__doc__)
    parser.add_argument(
        "world", nargs="?", help="SDF file, or the name of a shipped world such as corn.world"
    )
    parser.add_argument(
        "--episode", help="file of ardee_sim.envs.RecordEpisode, to be shown instead of a world"
    )
    parser.add_argument(
        "--robot",
        default="tsv1_default",
        help="name of a shipped robot such as tsv1_default, or a file",
    )
    parser.add_argument(
        "--parameters",
        metavar="FILE",
        help=".yaml file of the robot's ros_control controllers, and joints' gains",
    )
    parser.add_argument(
        "--controllers", nargs="+", default=[], metavar="NAME", help="of ros_control, started"
    )
    parser.add_argument("--seed", type=int, default=0, help="of all noise, default 0")
    parser.add_argument(
        "--host",
        default="127.0.0.1",
        help="address of the page, default 127.0.0.1: this computer alone; anyone who reaches it can drive",
    )
    parser.add_argument("--port", type=int, default=8080, help="of the page, default 8080")
    parser.add_argument(
        "--radius-m",
        type=float,
        default=12.0,
        help="of the part of a field that is shown [m], default 12",
    )
    given = parser.parse_args()
    if (given.world is None) == (given.episode is None):
        parser.error("found both or none of WORLD and --episode, expected one of them")
    page = dict(host=given.host, port=given.port, radius_m=given.radius_m)
    try:
        if given.episode is not None:
            _play(given.episode, page)
        else:
            _drive(given, page)
    except (ardee_sim.ArdeeError, ImportError) as error:
        print(f"ardee_sim.view: {error}", file=sys.stderr)
        sys.exit(2)
    except KeyboardInterrupt:  # before the page was there, or once more while it ends
        sys.exit(130)


def _play(file: str, page: Dict[str, Any]) -> None:
    from ardee_sim.envs import Episode
    from ardee_sim.view import play

    play(Episode.load(file), **page)


def _drive(given: argparse.Namespace, page: Dict[str, Any]) -> None:
    from ardee_sim.view import Viewer

    world = ardee_sim.World.from_file(given.world)
    with ardee_sim.Simulation(world, seed=given.seed) as sim:
        if given.parameters is not None:
            sim.set_parameters(given.parameters)
        sim.spawn("robot", ardee_sim.robot(given.robot), **world.start)
        if given.controllers:
            sim.start_controllers("robot", *given.controllers)
        with Viewer(sim, robot="robot", **page) as viewer:
            print(f"{viewer.url} (Ctrl-C ends it)", flush=True)
            viewer.run()


if __name__ == "__main__":
    main()
