# SPDX-License-Identifier: MIT
"""Statistics of runs: means and interquartile means with 95 % intervals, rates of events, effects of factors.

Means have Student's interval, counts the exact one of a Poisson count (Garwood 1936), interquartile means (IQM: of the
middle half of the runs, as rliable has them) a percentile interval of a bootstrap that draws within each world.
"""
import math
from typing import Any, Dict, Hashable, List, NamedTuple, Optional, Sequence, Tuple

import numpy as np
from scipy import stats

from ardee_campaigns.report.runs import Runs

CONFIDENCE = 0.95
DRAWS = 1000  # of a bootstrap
MOST_LEVELS = 8  # a number with more different values is a scale, not a set of levels
# Measures that count events
COUNTS = ("interventions", "collisions", "plants_touched", "plants_knocked")


class Interval(NamedTuple):
    """An estimate and the interval that holds the true value with the stated confidence."""

    estimate: float
    low: float
    high: float


class Quantity(NamedTuple):
    """Something that is measured, and how it is shown."""

    name: str
    text: str  # with the unit of what is shown
    scale: float  # from SI
    digits: int


NONE = Interval(math.nan, math.nan, math.nan)


def mean_interval(values: Sequence[float]) -> Interval:
    """Returns the interval of the mean of two or more normal values (Student)."""
    mid = float(np.mean(values))
    error = float(np.std(values, ddof=1)) / math.sqrt(len(values))
    reach = float(stats.t.ppf(0.5 + CONFIDENCE / 2.0, len(values) - 1)) * error
    return Interval(mid, mid - reach, mid + reach)


def poisson_interval(count: int) -> Interval:
    """Returns the interval of the expectation of a Poisson count (Garwood 1936)."""
    tail = (1.0 - CONFIDENCE) / 2.0
    low = float(stats.chi2.ppf(tail, 2 * count)) / 2.0 if count else 0.0
    return Interval(float(count), low, float(stats.chi2.ppf(1.0 - tail, 2 * count + 2)) / 2.0)


def mean(values: np.ndarray) -> Interval:
    """Returns the mean of the finite values and its interval, unknown for less than two."""
    known = values[np.isfinite(values)]
    if len(known) < 2:
        return Interval(float(known[0]) if len(known) else math.nan, math.nan, math.nan)
    return mean_interval(known)


def field_mean(runs: Runs, measure: str) -> Interval:
    """Returns the mean of the fields' means of a measure, and its interval over the fields."""
    return mean(_field_means(runs[measure], _fields(runs)))


def iqm(values: np.ndarray, strata: Sequence[Hashable], seed: int = 0) -> Interval:
    """Returns the interquartile mean and the interval of a bootstrap that keeps the number of runs of each stratum."""
    finite = np.isfinite(values)
    known, groups = values[finite], np.array(strata, dtype=object)[finite]
    if len(known) < 2:
        return NONE
    rng = np.random.default_rng(seed)
    drawn = []
    for group in sorted(set(groups.tolist()), key=str):
        members = known[groups == group]
        drawn.append(members[rng.integers(len(members), size=(DRAWS, len(members)))])
    means = stats.trim_mean(np.concatenate(drawn, axis=1), 0.25, axis=1)
    tail = (1.0 - CONFIDENCE) / 2.0
    low, high = np.quantile(means, (tail, 1.0 - tail))
    return Interval(float(stats.trim_mean(known, 0.25)), float(low), float(high))


def rate_per_100_m(runs: Runs, measure: str) -> Tuple[int, float, Interval]:
    """Returns the number of events of all runs, their way [m], and events per 100 m."""
    good = np.isfinite(runs[measure]) & np.isfinite(runs["way_m"])
    count, way_m = round(float(runs[measure][good].sum())), float(runs["way_m"][good].sum())
    if way_m <= 0.0:
        return count, way_m, NONE
    return count, way_m, Interval(*(100.0 * value / way_m for value in poisson_interval(count)))


def is_scale(runs: Runs, factor: str) -> bool:
    """Returns whether the values of a factor are a scale of numbers, along which a line is fitted.

    They are if they are many, were drawn between a low and a high one, or if no two runs that are alike in all else
    have different ones: in a Latin hypercube.
    """
    levels = runs.levels(factor)
    if len(levels) < 3 or not all(isinstance(level, float) for level in levels):
        return False
    is_drawn = factor in runs.scales or len(levels) > MOST_LEVELS
    return is_drawn or len(set(_all_else(runs, factor))) == len(runs)


def share_of_variance(runs: Runs, factor: str, measure: str) -> float:
    """Returns the share of a measure's variance that a factor explains: of its levels' means, or of a line."""
    finite = np.isfinite(runs[measure])
    values, levels = runs[measure][finite], runs[factor][finite]
    total = float(((values - values.mean()) ** 2).sum()) if len(values) > 2 else 0.0
    if total <= 0.0:
        return math.nan
    if is_scale(runs, factor):
        return float(np.corrcoef(levels.astype(float), values)[0, 1] ** 2)
    parts = (values[levels == level] for level in set(levels.tolist()))
    between = sum(len(part) * (part.mean() - values.mean()) ** 2 for part in parts)
    return float(between) / total


def slope(runs: Runs, factor: str, measure: str) -> Interval:
    """Returns the mean slope of a measure over a factor's scale, and its interval over the fields.

    Each field with three values or more has a fitted line; of fewer than two such fields the interval is unknown.
    """
    finite = np.isfinite(runs[measure])
    x, y, fields = runs[factor][finite].astype(float), runs[measure][finite], _fields(runs)[finite]
    parts = [fields == field for field in set(fields.tolist())]
    lines = [stats.linregress(x[part], y[part]) for part in parts if len(set(x[part])) > 2]
    return mean(np.array([line.slope for line in lines]))


class Difference(NamedTuple):
    """A level of a factor against the base level, in one measure.

    pairs : number of pairs of runs that are alike in all else, of the same seed; None if they are not paired
    fields : number of fields in which they drove
    """

    level: Any
    measure: str
    pairs: Optional[int]
    fields: int
    base: float  # mean
    other: float
    found: Interval  # other - base


def differences(runs: Runs, factor: str, base: Any) -> List[Difference]:
    """Returns each other level's difference from the base level in all measures.

    Runs in one field are alike, so each field counts once, with the means of its runs. Runs of different worlds have
    different seeds and are not paired: their interval is Welch's.
    """
    made = []
    for level in runs.levels(factor):
        if level == base:
            continue
        pairs = None if factor == "world" else _pairs(runs, factor, base, level)
        for measure in runs.measures:
            if pairs is not None:
                made.append(_paired(runs, level, measure, pairs))
            else:
                one, other = (runs.where(runs[factor] == each) for each in (base, level))
                made.append(_unpaired(level, measure, one, other))
    return made


def _fields(runs: Runs) -> np.ndarray:
    """Returns the number of each run's field; runs of one world and seed have the same."""
    keys = list(zip(runs["world"].tolist(), runs["seed"].tolist()))
    numbers = {key: number for number, key in enumerate(dict.fromkeys(keys))}
    return np.array([numbers[key] for key in keys], dtype=int)


def _field_means(values: np.ndarray, fields: np.ndarray) -> np.ndarray:
    """Returns the mean of each field's finite values, for those fields that have some."""
    finite = np.isfinite(values)
    values, fields = values[finite], fields[finite]
    return np.array([values[fields == field].mean() for field in dict.fromkeys(fields.tolist())])


def _all_else(runs: Runs, factor: str) -> List[Tuple[Any, ...]]:
    """Returns what each run is but for a factor; runs that are alike in it can be paired."""
    others = [name for name in runs.factors if name != factor]
    return list(zip(*(runs[name].tolist() for name in (*others, "replicate", "seed"))))


def _pairs(runs: Runs, factor: str, base: Any, level: Any) -> np.ndarray:
    """Returns indices (n, 2) of runs of both levels that are alike in all else."""
    keys = _all_else(runs, factor)
    levels = runs[factor].tolist()
    partner: Dict[Any, int] = {k: i for i, k in enumerate(keys) if levels[i] == base}
    found = [
        (partner[key], number)
        for number, key in enumerate(keys)
        if levels[number] == level and key in partner
    ]
    return np.array(found, dtype=int).reshape(-1, 2)


def _paired(runs: Runs, level: Any, measure: str, pairs: np.ndarray) -> Difference:
    one, other = (runs[measure][pairs[:, side]] for side in (0, 1))
    both = np.isfinite(one) & np.isfinite(other)
    fields = _fields(runs)[pairs[:, 0]][both]
    one, other = (_field_means(side[both], fields) for side in (one, other))
    means = [mean(side).estimate for side in (one, other)]
    return Difference(level, measure, int(both.sum()), len(one), *means, mean(other - one))


def _unpaired(level: Any, measure: str, first: Runs, second: Runs) -> Difference:
    one, other = (_field_means(part[measure], _fields(part)) for part in (first, second))
    count = len(one) + len(other)
    if min(len(one), len(other)) < 2:
        return Difference(level, measure, None, count, math.nan, math.nan, NONE)
    errors = [part.var(ddof=1) / len(part) for part in (one, other)]
    mid, error = float(other.mean() - one.mean()), math.sqrt(sum(errors))
    freedom = _welch(errors, (len(one), len(other)))
    reach = float(stats.t.ppf(0.5 + CONFIDENCE / 2.0, freedom)) * error if error else 0.0
    found = Interval(mid, mid - reach, mid + reach)
    return Difference(level, measure, None, count, float(one.mean()), float(other.mean()), found)


def _welch(errors: Sequence[float], counts: Sequence[int]) -> float:
    """Returns the degrees of freedom of Welch and Satterthwaite."""
    parts = sum(error**2 / (count - 1) for error, count in zip(errors, counts))
    return sum(errors) ** 2 / parts if parts else float(sum(counts) - 2)


# Measures of which more is better; of all others less is.
_MORE_IS_BETTER = (
    "way_m",
    "distance_m",
    "share_near",
    "metres_per_intervention",
    "completed",
    "row_coverage",
    "headland_coverage",
    "fre_score_m",
)
_JUDGED_BY = ("interventions", "collisions", "lateral_rms_m")  # if measured; else by the first


def order_by(runs: Runs, measure: Optional[str]) -> np.ndarray:
    """Returns indices of the runs, the worst first: by a measure, or by interventions, collisions and offset."""
    names = [measure] if measure else [name for name in _JUDGED_BY if name in runs.measures]
    names = names or runs.measures[:1]
    keys = [runs["run_id"].astype(str)]
    for name in reversed(names):
        sign = 1.0 if name in _MORE_IS_BETTER else -1.0
        keys.append(np.where(np.isfinite(runs[name]), sign * runs[name], np.inf))
    return np.lexsort(keys)
