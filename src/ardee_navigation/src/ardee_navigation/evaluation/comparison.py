# SPDX-License-Identifier: MIT
"""Two experiments over the same seeds, side by side: paired differences of their runs, with confidence intervals.

A run of one is paired with the run of the other that has the same seed: the same field and start pose. Differences
get Student's interval on their mean; rates of interventions the exact interval of a Poisson count (Garwood 1936).
"""
import csv
import math
from pathlib import Path
from typing import Dict, List, NamedTuple, Sequence, Tuple

import numpy as np
from scipy import stats

from ardee_common.errors import GeneratorError

CONFIDENCE = 0.95
_LARGEST_BYTES = 16 << 20
Run = Dict[str, float]


class Measure(NamedTuple):
    """A column of runs.csv, how it is called and shown."""

    column: str
    name: str
    scale: float
    digits: int


MEASURES = (
    Measure("lateral_rms_m", "lateral RMS [cm]", 100.0, 2),
    Measure("lateral_max_m", "lateral max [cm]", 100.0, 2),
    Measure("share_near", "within 10 cm [%]", 100.0, 2),
    Measure("heading_rms_rad", "heading RMS [deg]", 180.0 / math.pi, 2),
    Measure("width_m", "perceived width [cm]", 100.0, 2),
    Measure("interventions", "interventions", 1.0, 2),
    Measure("collisions", "collisions", 1.0, 2),
    Measure("knocked", "plants knocked", 1.0, 2),
    Measure("completed", "came to the end of the row", 1.0, 2),
)
_COLUMNS = ("way_m", *(measure.column for measure in MEASURES))


class Interval(NamedTuple):
    """An estimate and the interval that holds the true value with the stated confidence."""

    estimate: float
    low: float
    high: float


def mean_interval(values: Sequence[float]) -> Interval:
    """Returns the interval of the mean of two or more normal values (Student)."""
    mean = float(np.mean(values))
    error = float(np.std(values, ddof=1)) / math.sqrt(len(values))
    reach = float(stats.t.ppf(0.5 + CONFIDENCE / 2.0, len(values) - 1)) * error
    return Interval(mean, mean - reach, mean + reach)


def poisson_interval(count: int) -> Interval:
    """Returns the interval of the expectation of a Poisson count (Garwood 1936)."""
    tail = (1.0 - CONFIDENCE) / 2.0
    low = float(stats.chi2.ppf(tail, 2 * count)) / 2.0 if count else 0.0
    return Interval(float(count), low, float(stats.chi2.ppf(1.0 - tail, 2 * count + 2)) / 2.0)


def _run(row: Dict[str, str], where: str) -> Tuple[int, Run]:
    try:
        run = {name: float(row[name]) for name in _COLUMNS}
        seed = int(row["seed"])
    except (KeyError, TypeError, ValueError) as error:
        raise GeneratorError(f"{where}: not a line of run_experiment's runs.csv: {error}") from None
    wrong = [name for name, value in run.items() if not math.isfinite(value)]
    if (
        wrong and run["way_m"] != 0.0
    ):  # a run that covered no distance has no value for most measures
        raise GeneratorError(f"{where}: {wrong[0]}: found {run[wrong[0]]}, expected a number")
    return seed, run


def read_runs(folder: Path) -> Dict[int, Run]:
    """Seed to figures of the runs of an experiment."""
    path, runs = folder / "runs.csv", {}  # type: Path, Dict[int, Run]
    try:
        if path.stat().st_size > _LARGEST_BYTES:
            raise GeneratorError(f"{path}: found more than {_LARGEST_BYTES} bytes, expected fewer")
        with path.open(newline="") as file:
            reader = csv.DictReader(file)
            for row in reader:
                seed, run = _run(row, f"{path}:{reader.line_num}")
                if seed in runs:
                    raise GeneratorError(f"{path}:{reader.line_num}: found seed {seed} twice")
                runs[seed] = run
    except OSError as error:
        raise GeneratorError(f"{path}: cannot be read: {error.strerror}") from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise GeneratorError(f"{path}: not a CSV file: {error}") from error
    return runs


def _difference(pairs: List[Tuple[Run, Run]], measure: Measure) -> List[str]:
    form = f"{{:.{measure.digits}f}}".format
    one, other = (
        measure.scale * np.array([pair[side][measure.column] for pair in pairs]) for side in (0, 1)
    )
    found = mean_interval(other - one)
    cells = [measure.name, form(one.mean()), form(other.mean())]
    signed = f"{{:+.{measure.digits}f}}".format
    return [*cells, signed(found.estimate), f"{signed(found.low)} to {signed(found.high)}"]


def _rate(runs: List[Run]) -> str:
    way_m = sum(run["way_m"] for run in runs)
    count = round(sum(run["interventions"] for run in runs))
    rate, low, high = (100.0 * value / way_m for value in poisson_interval(count))
    return f"{count} in {way_m:.1f} m: {rate:.2f} per 100 m, {low:.2f} to {high:.2f}"


def compare(one: Dict[int, Run], other: Dict[int, Run], names: Tuple[str, str]) -> str:
    """Markdown of the runs that both have and that came between the rows."""
    both = one.keys() & other.keys()
    seeds = sorted(seed for seed in both if one[seed]["way_m"] and other[seed]["way_m"])
    if len(seeds) < 2:
        raise GeneratorError(
            f"found {len(seeds)} seeds whose runs came between the rows in both experiments, expected 2 or more"
        )
    pairs = [(one[seed], other[seed]) for seed in seeds]
    lines: List[Sequence[str]] = [("mean of the runs", *names, "difference", "95 % interval")]
    lines.append(["---"] * 5)
    lines += [_difference(pairs, measure) for measure in MEASURES]
    left_out = len(one.keys() | other.keys()) - len(both)
    astray = len(both) - len(seeds)
    text = f"{len(seeds)} pairs of runs, seeds {', '.join(map(str, seeds))}"
    text += f"; {left_out} runs without a partner are left out" if left_out else ""
    text += (
        f"; {astray} pairs with a run that never came between the rows are left out"
        if astray
        else ""
    )
    text += "\n\n" + "".join("| " + " | ".join(line) + " |\n" for line in lines)
    for side, name in enumerate(names):
        rate = _rate([pair[side] for pair in pairs])
        text += f"\nInterventions, {name}: {rate} (95 %).\n"
    return text
