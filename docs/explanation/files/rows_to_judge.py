#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the pictures of a data set with their straight crop rows in the form that judge_vision reads.

python3 rows_to_judge.py DATA FOLDER
"""
import json
import sys
from pathlib import Path

import numpy as np
from PIL import Image


def offsets_and_periods(sample: dict) -> np.ndarray:
    """Returns offset and period [px] of the rows in the lowest picture rows, [v, 2]: those that show two rows."""
    found = []
    for v in range(sample["height_px"]):
        places = []
        for row in sample["rows"]:
            u_px, v_px = np.array(sorted(row["line_px"], key=lambda point: point[1])).T
            if v_px[0] <= v <= v_px[-1]:
                places.append(float(np.interp(v, v_px, u_px)) + 0.5 - sample["width_px"] / 2)
        if len(places) < 2:
            found.clear()
            continue
        period = float(np.median(np.diff(np.sort(places))))
        phase = np.angle(np.exp(2j * np.pi * np.array(places) / period).sum())
        found.append((phase / (2 * np.pi) * period, period))
    return np.array(found)


def main(data: Path, folder: Path) -> None:
    """Writes NAME.jpg and NAME.crp of each picture in which rows are seen."""
    folder.mkdir(parents=True, exist_ok=True)
    for path in sorted(data.glob("*/samples/*.json")):
        sample = json.loads(path.read_text())
        rows = offsets_and_periods(sample)
        if len(rows):
            picture = Image.open(path.parents[1] / "rgb" / f"{path.stem}.png")
            picture.save(folder / f"{path.stem}.jpg", quality=90)
            np.savetxt(folder / f"{path.stem}.crp", rows, fmt="%.3f")


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
