# SPDX-License-Identifier: MIT
"""Tables of a campaign that nobody ran: effects of known size, and some failures."""
from pathlib import Path
from typing import List

import numpy as np
import pyarrow as pa

from ardee_campaigns import tables

MEASURES = ("way_m", "lateral_rms_m", "interventions", "collisions")
WORLDS, CONTROLLERS, SPEEDS = ("corn", "sorghum"), ("one", "other"), (0.3, 0.6)
SHIFT_M = 0.02  # of lateral_rms_m, from controller one to the other
FAILED_EVERY = 50


def _samples(count: int, rng: np.random.Generator) -> pa.Table:
    time_s = 0.025 * np.arange(count)
    lateral = 0.03 * np.sin(time_s) + 0.01 * rng.normal(size=count)
    values = {name: np.zeros(count) for name, _ in tables.SAMPLE_FIELDS}
    values.update(time_ns=(1e9 * time_s).astype(np.int64), touching=np.zeros(count, np.int32))
    values.update(x_m=0.5 * time_s, along_m=0.5 * time_s, lateral_m=lateral)
    values.update(left_true_m=0.38 - lateral, right_true_m=0.38 + lateral)
    values.update(left_seen_m=0.37 - lateral, right_seen_m=0.37 + lateral)
    events = [""] * count
    events[count // 2] = "off the lane"
    raw = [[0.0, 0.0]] * count
    columns = {**values, "event": events, "raw_along_m": raw, "raw_lateral_m": raw}
    return pa.table(columns, schema=tables.RUN_FILE_SCHEMA)


def rows(count: int) -> List[tables.RunRow]:
    """Returns runs of all combinations; those of a replicate share a field, which makes them alike."""
    rng, made = np.random.default_rng(1), []
    cells = [(w, c, s) for w in WORLDS for c in CONTROLLERS for s in SPEEDS]
    fields = 0.02 * np.random.default_rng(2).random((len(WORLDS), count))
    for number in range(count):
        world, controller, speed = cells[number % len(cells)]
        replicate = number // len(cells)
        field = fields[WORLDS.index(world), replicate]
        lateral = 0.03 + field + SHIFT_M * (controller == "other") + 0.001 * rng.normal()
        is_failed = number % FAILED_EVERY == FAILED_EVERY - 1
        values = (10.0, lateral, float(rng.poisson(0.2)), float(rng.poisson(1.0)))
        made.append(
            tables.RunRow(
                run_id=f"{number:016x}",
                world=world,
                robot="tsv1",
                controller=controller,
                factors={"speed_m_s": speed},
                replicate=replicate,
                seed=1000 * WORLDS.index(world) + replicate,
                status=tables.FAILED if is_failed else tables.OK,
                error=f"wheel {number} <came> off" if is_failed else "",
                end_reason="" if is_failed else "end of the row",
                sim_s=20.0,
                measures={} if is_failed else dict(zip(MEASURES, values)),
            )
        )
    return made


def write(folder: Path, count: int, samples: int = 200) -> Path:
    """Writes all tables of so many runs of so many samples; returns the folder."""
    made, rng = rows(count), np.random.default_rng(3)
    schema = tables.runs_schema({"speed_m_s": pa.float64()}, MEASURES, {"name": "synthetic"})
    about = {"length_m": 10.0, "width_m": 0.76, "lidar_ahead_m": 0.2}
    driven = _samples(samples, rng)
    timings = [tables.Timing(row.run_id, 1.5, "here") for row in made]
    tables.write_runs(folder, made, schema)
    tables.write_timings(folder, timings)
    for row, timing in zip(made, timings):
        kept = driven if row.status == tables.OK else tables.RUN_FILE_SCHEMA.empty_table()
        tables.write_run(folder, tables.RunFile(row, timing, kept, about))
    tables.write_samples(folder, [row.run_id for row in made])
    return folder
