# SPDX-License-Identifier: MIT
"""The literature's range of each metric, by species and stage, from config/ranges.yaml."""

from dataclasses import dataclass
from pathlib import Path
from typing import Dict, List, Mapping, Optional, Tuple

from ardee_common.config import build_list, read_yaml_lines
from ardee_common.errors import GeneratorError
from ardee_common.options import bounded
from ardee_models.config_dir import config_dir

# Kinds of evidence for a range; the head of config/ranges.yaml defines each
MARKS = ("read", "computed", "derived", "nominal")


@dataclass(frozen=True)
class Range:
    """Least and greatest value of a metric at some stages, and their derivation from the source."""

    stages: Tuple[str, ...]
    source: str
    mark: str
    how: str
    min: float = bounded(0, 1000)
    max: float = bounded(0, 1000)


@dataclass(frozen=True)
class Check:
    """A metric of a model beside its range."""

    metric: str
    value: float
    low: float
    high: float
    mark: str
    source: str

    def holds(self) -> bool:
        """Tells whether the value lies in the range, ends included."""
        return self.low <= self.value <= self.high


def load_ranges(path: Optional[Path] = None) -> tuple:
    """Ranges by species and metric, and the text of each source."""
    path = path or config_dir() / "ranges.yaml"
    data = read_yaml_lines(path)
    sources = data.pop("sources", {})
    ranges: Dict[str, Dict[str, List[Range]]] = {}
    for species, metrics in data.items():
        if not isinstance(metrics, dict):
            raise GeneratorError(f"{path}: {species}: found {metrics!r}, expected metrics")
        for metric in metrics:
            where = f"{path}: {species}.{metric}"
            parsed = list(build_list(Range, metrics, metric))
            for row in parsed:
                if row.mark not in MARKS:
                    raise GeneratorError(
                        f"{where}: found mark {row.mark!r}, expected one of {', '.join(MARKS)}"
                    )
                if row.min > row.max or row.source not in sources:
                    raise GeneratorError(
                        f"{where}: found {row.min:g} to {row.max:g} from {row.source!r},"
                        f" expected min <= max and a source among {', '.join(sources)}"
                    )
            ranges.setdefault(species, {})[metric] = parsed
    return ranges, sources


def check_metrics(
    metrics: Mapping[str, object], ranges: Dict[str, Dict[str, List[Range]]]
) -> List[Check]:
    """One check for each metric that has a range at the model's stage."""
    checks = []
    for metric, rows in ranges.get(str(metrics["species"]), {}).items():
        for row in rows:
            if metrics["stage"] in row.stages:
                value = float(metrics[metric])  # type: ignore[arg-type]
                checks.append(Check(metric, value, row.min, row.max, row.mark, row.source))
    return checks
