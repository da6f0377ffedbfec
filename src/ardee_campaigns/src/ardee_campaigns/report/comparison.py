# SPDX-License-Identifier: MIT
"""Sections of a page that compare the levels of a factor with each other."""
from pathlib import Path
from typing import Any, List, Optional, Sequence

from ardee_campaigns.report import figures, statistics
from ardee_campaigns.report.page import Page
from ardee_campaigns.report.runs import Runs, level_named, short, shown
from ardee_campaigns.report.statistics import Interval

HEADS = (
    *("measure", "pairs", "fields", "mean of the first", "of the other"),
    *("difference", "95 % interval", ""),
)


def three(value: float, sign: str = "") -> str:
    """Returns a number with three significant digits, a dash if there is none."""
    if value != value:
        return "-"
    text = f"{value:{sign}.3g}"
    return f"{value:{sign}.0f}" if "e+" in text and abs(value) < 1e7 else text


def with_interval(found: Interval) -> str:
    """Returns an estimate with its interval."""
    if found.low != found.low:
        return three(found.estimate)
    return f"{three(found.estimate)} ({three(found.low)} to {three(found.high)})"


def base_level(runs: Runs, factor: str, text: Optional[str]) -> Any:
    """Returns the level of a factor with which others are compared: as named, else the first."""
    levels = runs.levels(factor)
    if text is None:
        return levels[0]
    return level_named(text, levels, "--base")


def compare(page: Page, runs: Runs, factor: str, base: Any, picture: Path) -> None:
    """Adds the comparison of a factor's levels: differences from the base level, or slopes along a scale."""
    if statistics.is_scale(runs, factor):
        rows = []
        for measure in runs.measures:
            found = statistics.slope(runs, factor, measure)
            rows.append([measure, three(found.estimate, "+"), _span(found), _verdict(found)])
        page.table(("measure", f"slope over {short(factor)}", "95 % interval", ""), rows)
        figures.effects(picture, runs, [factor], runs.measures)
        page.picture(picture, f"Runs over {short(factor)}, with a fitted line")
        return
    found = statistics.differences(runs, factor, base)
    for level in dict.fromkeys(one.level for one in found):
        page.text(f"{short(factor)} {shown(base)} (the first) and {shown(level)} (the other):")
        page.table(HEADS, _rows([one for one in found if one.level == level]))
    figures.differences(picture, found, factor, base)
    page.picture(picture, f"Differences from {short(factor)} {shown(base)}, 95 % intervals")


def _rows(found: Sequence[statistics.Difference]) -> List[List[str]]:
    rows = []
    for one in found:
        pairs = "unpaired" if one.pairs is None else str(one.pairs)
        cells = [one.measure, pairs, str(one.fields), three(one.base), three(one.other)]
        rows.append([*cells, three(one.found.estimate, "+"), _span(one.found), _verdict(one.found)])
    return rows


def _span(found: Interval) -> str:
    return "-" if found.low != found.low else f"{three(found.low, '+')} to {three(found.high, '+')}"


def _verdict(found: Interval) -> str:
    """Returns whether the interval tells the sign of the difference."""
    if found.low != found.low:
        return "too few fields"
    return "" if found.low <= 0.0 <= found.high else ("more" if found.low > 0.0 else "less")


def rates(page: Page, runs: Runs, factor: str) -> None:
    """Adds the events per 100 m of each level, if they and the way were measured."""
    counted = [name for name in statistics.COUNTS if name in runs.measures]
    if not counted or "way_m" not in runs.measures:
        return
    rows = []
    for level in runs.levels(factor) if not statistics.is_scale(runs, factor) else []:
        part = runs.where(runs[factor] == level)
        for name in counted:
            count, way_m, rate = statistics.rate_per_100_m(part, name)
            rows.append([shown(level), name, f"{count} in {way_m:.1f} m", with_interval(rate)])
    if rows:
        page.table((short(factor), "events", "counted", "per 100 m (95 %, Poisson)"), rows)
