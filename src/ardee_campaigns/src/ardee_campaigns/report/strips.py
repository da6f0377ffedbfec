# SPDX-License-Identifier: MIT
"""Strips of pictures along a run: its field is sown again, and the robot set down where it was."""
import math
import tempfile
from pathlib import Path
from typing import List, NamedTuple, Tuple

import ardee_sim
import numpy as np
from matplotlib import image

from ardee_campaigns import tables
from ardee_campaigns.plan import Job
from ardee_campaigns.robot import Driven
from ardee_campaigns.run import sow
from ardee_world.row_truth import Pose
from ardee_world.trial import Trial

COUNT = 3  # pictures of a strip
_SIZE_PX = (320, 240)
_BEHIND_M, _ABOVE_M, _DOWN_RAD = 1.1, 0.55, 0.30  # of the camera behind the robot
_NEAR_M = 0.7  # leaves before the camera are left out
_GAP_PX = 4


class Moment(NamedTuple):
    """A sample of a run of which a picture is taken."""

    number: int
    text: str


def moments(run: tables.RunFile) -> List[Moment]:
    """Returns the first times that a person stepped in, and places evenly spread along the run, in order."""
    count = len(run.samples)
    if not count:
        return []
    events = run.samples["event"].to_pylist()
    chosen = [number for number, event in enumerate(events) if event][:COUNT]
    left = COUNT - len(chosen)
    chosen += [int(place) for place in np.linspace(0, count - 1, left + 2)[1:-1]]
    columns = [run.samples[name].to_numpy() for name in ("along_m", "lateral_m")]
    made = []
    for number in sorted(set(chosen)):
        along_m, lateral_m = (float(column[number]) for column in columns)
        side = "left" if lateral_m > 0 else "right"
        text = f"{along_m:.1f} m along, {100 * abs(lateral_m):.0f} cm {side}"
        made.append(Moment(number, text + (f": {events[number]}" if events[number] else "")))
    return made


def draw(path: Path, job: Job, run: tables.RunFile, chosen: List[Moment]) -> None:
    """Writes the pictures of these moments side by side."""
    with tempfile.TemporaryDirectory(prefix="ardee_strip_") as work:
        trial = sow(job, Path(work) / "models")
        world = ardee_sim.World.from_file(trial.world, model_paths=trial.models)
        pictures = [_picture(world, trial, job, _pose(run, moment.number)) for moment in chosen]
    gap = np.full((_SIZE_PX[1], _GAP_PX, 3), 255, np.uint8)
    parts = [part for picture in pictures for part in (picture, gap)]
    image.imsave(path, np.hstack(parts[:-1]), metadata={"Software": None})


def _picture(world: ardee_sim.World, trial: Trial, job: Job, pose: Pose) -> np.ndarray:
    """Returns a picture; its simulation ends with it, for what is near a camera takes hundreds of MB."""
    keys = job.campaign.robots[job.cell.robot]
    with ardee_sim.Simulation(world, seed=job.seed) as sim:
        driven = Driven(sim, job.cell.robot, keys, job.urdf.read_text())
        driven.spawn(trial.start, trial)
        driven.set_pose(pose, trial)
        place, turn = _camera(pose, trial.height_m(pose))
        lens = {"width_px": _SIZE_PX[0], "height_px": _SIZE_PX[1], "near_m": _NEAR_M}
        return sim.render(place, turn, **lens)


def _pose(run: tables.RunFile, number: int) -> Pose:
    return Pose(*(float(run.samples[name][number].as_py()) for name in ("x_m", "y_m", "yaw_rad")))


def _camera(
    pose: Pose, height_m: float
) -> Tuple[Tuple[float, float, float], Tuple[float, float, float, float]]:
    """Returns place and quaternion of a camera behind and above the robot, which looks down at it."""
    c, s = math.cos(pose.yaw_rad), math.sin(pose.yaw_rad)
    place = (pose.x_m - _BEHIND_M * c, pose.y_m - _BEHIND_M * s, height_m + _ABOVE_M)
    cy, sy = math.cos(pose.yaw_rad / 2), math.sin(pose.yaw_rad / 2)
    cp, sp = math.cos(_DOWN_RAD / 2), math.sin(_DOWN_RAD / 2)
    return place, (-sy * sp, cy * sp, sy * cp, cy * cp)  # yaw, then pitch
