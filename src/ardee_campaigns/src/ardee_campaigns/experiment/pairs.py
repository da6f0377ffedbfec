# SPDX-License-Identifier: MIT
"""Compares the runs of two experiments over the same seeds, in pairs.

A run of one is paired with the run of the other that has the same seed: in one world the same field and start pose.
"""
import math
from typing import Dict, List, Sequence, Tuple

import numpy as np

from ardee_campaigns.report.runs import Runs
from ardee_campaigns.report.statistics import Quantity, mean, rate_per_100_m
from ardee_common.errors import GeneratorError

QUANTITIES = (
    Quantity("lateral_rms_m", "lateral RMS [cm]", 100.0, 2),
    Quantity("lateral_max_m", "lateral max [cm]", 100.0, 2),
    Quantity("share_near", "within 10 cm [%]", 100.0, 2),
    Quantity("heading_rms_rad", "heading RMS [deg]", 180.0 / math.pi, 2),
    Quantity("row_width_m", "perceived width [cm]", 100.0, 2),
    Quantity("interventions", "interventions", 1.0, 2),
    Quantity("collisions", "collisions", 1.0, 2),
    Quantity("plants_knocked", "plants knocked", 1.0, 2),
    Quantity("completed", "came to the end of the row", 1.0, 2),
)


def _difference(one: Runs, other: Runs, shown: Quantity) -> List[str]:
    """Returns the cells of a quantity over runs in the same order, of pairs in which both have a number."""
    form, signed = f"{{:.{shown.digits}f}}".format, f"{{:+.{shown.digits}f}}".format
    values = [shown.scale * part[shown.name] for part in (one, other)]
    known = np.isfinite(values[1] - values[0])
    if not known.any():
        return [f"{shown.text}, no pairs", *"----"]
    found = mean((values[1] - values[0])[known])
    means = [form(part[known].mean()) for part in values]
    count = "" if known.all() else f", {np.count_nonzero(known)} pairs"
    return [
        shown.text + count,
        *means,
        signed(found.estimate),
        f"{signed(found.low)} to {signed(found.high)}" if math.isfinite(found.low) else "-",
    ]


def compare(one: Runs, other: Runs, names: Tuple[str, str]) -> str:
    """Returns Markdown of the runs that both have and that came between the rows.

    Raises GeneratorError if the runs are of more than one world.
    """
    worlds = [runs.levels("world") for runs in (one, other)]
    for each, name in zip(worlds, names):
        if not each:
            raise GeneratorError(f"found no run in {name} that did not fail, expected some")
    if worlds[0] != worlds[1] or len(worlds[0]) != 1:
        found = " and ".join(f"{', '.join(each)} in {name}" for each, name in zip(worlds, names))
        raise GeneratorError(f"found the worlds {found}, expected one and the same in both")
    places: List[Dict[int, int]] = [
        {int(seed): place for place, seed in enumerate(runs["seed"])} for runs in (one, other)
    ]
    both = sorted(places[0].keys() & places[1].keys())
    seeds = [s for s in both if one["way_m"][places[0][s]] and other["way_m"][places[1][s]]]
    if len(seeds) < 2:
        raise GeneratorError(
            f"found {len(seeds)} seeds whose runs came between the rows in both experiments, expected 2 or more"
        )
    pairs = [
        runs.where([place[seed] for seed in seeds]) for runs, place in zip((one, other), places)
    ]
    text = f"{len(seeds)} pairs of runs, seeds {', '.join(map(str, seeds))}"
    left_out = len(places[0].keys() ^ places[1].keys())
    text += f"; {left_out} runs without a partner are left out" if left_out else ""
    astray = len(both) - len(seeds)
    what = "pairs with a run that never came between the rows are left out"
    text += f"; {astray} {what}" if astray else ""
    lines: List[Sequence[str]] = [("mean of the runs", *names, "difference", "95 % interval")]
    lines.append(["---"] * 5)
    lines += [_difference(*pairs, shown) for shown in QUANTITIES]
    text += "\n\n" + "".join("| " + " | ".join(line) + " |\n" for line in lines)
    for part, name in zip(pairs, names):
        count, way_m, (rate, low, high) = rate_per_100_m(part, "interventions")
        what = f"{count} in {way_m:.1f} m: {rate:.2f} per 100 m, {low:.2f} to {high:.2f}"
        text += f"\nInterventions, {name}: {what} (95 %).\n"
    return text
