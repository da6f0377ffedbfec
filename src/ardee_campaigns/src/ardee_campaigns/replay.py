# SPDX-License-Identifier: MIT
"""Finds the inputs of a run of a campaign's folder by its id; keeps the scans of one that is done again."""
import dataclasses
from pathlib import Path
from typing import List, Optional

import numpy as np
from ardee_sim import LidarReading

from ardee_campaigns import tables
from ardee_campaigns.campaign_file import read_campaign
from ardee_campaigns.lane.scans import Scans, returns_m
from ardee_campaigns.plan import Job, Planner
from ardee_campaigns.robot import Observation
from ardee_common.errors import GeneratorError
from ardee_common.output import write_file

FILE = "campaign_file.txt"  # in a campaign's folder: where the campaign's file lies
ROBOTS = "robots"  # folder of descriptions in a campaign's folder


def note_file(folder: Path, file: Path) -> None:
    """Notes in a campaign's folder where its file lies."""
    write_file(folder / FILE, f"{file}\n".encode())


def noted_file(folder: Path) -> Optional[Path]:
    """Returns the campaign's file that was noted in a campaign's folder; None without a note."""
    note = folder / FILE
    return Path(note.read_text().strip()) if note.is_file() else None


class Replayer:
    """Runs of a campaign's folder. `file` is the campaign's file, if it has been moved since."""

    def __init__(self, folder: Path, file: Optional[Path] = None) -> None:
        self._folder = folder.resolve()
        found = file or noted_file(folder)
        if found is None:
            raise GeneratorError(
                f"{folder / FILE}: found no such file, expected the path of the campaign's"
            )
        if not found.is_file():
            moved = "expected --campaign FILE if it was moved"
            raise GeneratorError(f"{found}: found no such file, {moved}")
        self.file = found
        self._planner = Planner(read_campaign(self.file))

    def job(self, run_id: str) -> Job:
        """Returns the inputs of a run. Raises GeneratorError if they have changed since."""
        row = tables.read_run_head(self._folder, run_id).row
        wanted = (row.world, row.robot, row.controller, dict(row.factors))
        for cell in self._planner.cells:
            if (cell.world, cell.robot, cell.controller, dict(cell.factors)) != wanted:
                continue
            job = self._planner.job(cell, row.replicate, self._folder / ROBOTS)
            if job.run_id == run_id:
                if not job.urdf.is_file():
                    write_file(job.urdf, self._planner.urdf(cell).encode())
                return job
        raise GeneratorError(f"{self.file}: found no run {run_id} in it: its inputs have changed")


class ScanLog:
    """Scans of a run as its controller gets them."""

    def __init__(self) -> None:
        self.readings: List[LidarReading] = []

    def watch(self, observation: Observation) -> None:
        """Takes the observation's reading of use `scan`, if there is a new one."""
        reading = observation.get("scan")
        if isinstance(reading, LidarReading) and (
            not self.readings or reading.stamp_ns > self.readings[-1].stamp_ns
        ):
            self.readings.append(reading)

    def scans(self) -> Scans:
        """Returns the scans so far, two or more."""
        if len(self.readings) < 2:
            found = f"found {len(self.readings)} readings of use scan"
            raise GeneratorError(f"{found}, expected 2 or more of a lidar")
        first = self.readings[0]
        ranges = np.array([reading.ranges_m for reading in self.readings], dtype=float)
        time_s = np.array([reading.stamp_ns for reading in self.readings]) * 1e-9
        return Scans(time_s, returns_m(ranges), first.angle_min_rad, first.angle_increment_rad)


def in_lane(scans: Scans, run: tables.RunFile) -> Scans:
    """Returns the scans that were taken while the lidar was between the rows' first and last places."""
    time_s = run.samples["time_ns"].to_numpy() * 1e-9
    along_m = run.samples["along_m"].to_numpy() + run.about["lidar_ahead_m"]
    here_m = np.interp(scans.time_s, time_s, along_m)
    inside = (here_m >= 0.0) & (here_m <= run.about["length_m"])
    return dataclasses.replace(scans, time_s=scans.time_s[inside], ranges_m=scans.ranges_m[inside])
