# SPDX-License-Identifier: MIT
"""Targets of scripts/fuzz in this package: each takes any bytes and raises an exception only for a finding."""

import tempfile
from pathlib import Path
from typing import Callable, Dict, Optional

from ardee_common.errors import GeneratorError
from ardee_models.lookup import CropModel
from ardee_world.centres import listed_centres, read_centres
from ardee_world.clutter import KINDS
from ardee_world.field_config import FieldConfig
from ardee_world.field_layout import generate
from ardee_world.plots import Plan
from ardee_world.request import configure, yaml_values
from ardee_world.writers.field import write_field

# Larger fields are checked but not planted, because that takes long and runs the same code.
_MOST_PLANTS = 200
_FOLDER = tempfile.TemporaryDirectory(prefix="ardee_fuzz_")
_POOL = (CropModel("corn_a", 0.8, 0.01, 1), CropModel("corn_b", 1.2, 0.012, 1))


def _write(config: FieldConfig, plan: Optional[Plan], seed: int, form: str) -> None:
    count = config.plots.planned_count() if plan is None else len(plan.centres_m)
    if count <= _MOST_PLANTS:
        layout = generate(config, _POOL, seed, None, plan, {})
        if layout.count() > 0:
            write_field(layout, "field", Path(_FOLDER.name), form)


def field(data: bytes) -> None:
    """Reads a field's options from a YAML file; plants a small field."""
    path = Path(_FOLDER.name) / "input.yaml"
    path.write_bytes(data)
    try:
        sources, config = configure(
            {**{"name": "field", "output": "out", "models": ("corn_a",)}, **yaml_values(path)}
        )
        has_clutter = any(getattr(config.clutter, f"{kind}_density_per_m2") for kind in KINDS)
        plan = None
        if isinstance(sources.centers, str):
            return
        if sources.centers is not None:
            plan = listed_centres(sources.centers, "field")
        if not has_clutter and not config.shape.cross_rows:
            _write(config, plan, sources.seed, sources.format)
    except GeneratorError:
        pass


def centres(data: bytes) -> None:
    """Reads a table of stalk centres and plants it."""
    path = Path(_FOLDER.name) / "input.csv"
    path.write_bytes(data)
    try:
        _write(FieldConfig(), read_centres(path), 0, "auto")
    except GeneratorError:
        pass


TARGETS: Dict[str, Callable[[bytes], None]] = {"field": field, "centres": centres}
