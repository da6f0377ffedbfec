# SPDX-License-Identifier: MIT
"""The command `crop_report`: a picture of all crop models, and their metrics beside the literature's ranges."""

import argparse
import csv
import io
import json
from pathlib import Path
from typing import Dict, List, Optional, Sequence

from ardee_common.cli import Parser, add_model_path, run
from ardee_common.errors import GeneratorError
from ardee_common.output import output_folder, write_file
from ardee_models.lookup import find_model, search_path
from ardee_models.plant.plant_metrics import METRICS_FILE
from ardee_models.plant.stages import SEASONS
from ardee_models.plant.variants import load_variants
from ardee_models.report.contact_sheet import draw_contact_sheet
from ardee_models.report.ranges import MARKS, check_metrics, load_ranges


def read_metrics(model: Path) -> dict:
    """Reads metrics.json of a model directory."""
    path = model / METRICS_FILE
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise GeneratorError(f"{path}: cannot be read: {error.strerror}") from error
    except ValueError as error:
        raise GeneratorError(f"{path}: not valid JSON: {error}") from error
    missing = {"species", "stage", "season", "height_m"} - set(data)
    if missing:
        raise GeneratorError(f"{path}: missing key {sorted(missing)[0]!r}")
    return data


def _rows(models: Sequence[Path]) -> List[dict]:
    ranges, _ = load_ranges()
    rows = []
    for model in models:
        metrics = read_metrics(model)
        checks = check_metrics(metrics, ranges)
        if not checks:
            raise GeneratorError(
                f"{model}: no range in the literature for {metrics['species']} {metrics['stage']}"
            )
        for check in checks:
            rows.append(
                {
                    "model": model.name,
                    **{key: metrics[key] for key in ("species", "stage", "season")},
                    "metric": check.metric,
                    "value": f"{check.value:g}",
                    "min": f"{check.low:g}",
                    "max": f"{check.high:g}",
                    "within": "yes" if check.holds() else "NO",
                    "mark": check.mark,
                    "source": check.source,
                }
            )
    return rows


def _csv(rows: List[dict]) -> str:
    buffer = io.StringIO()
    writer = csv.DictWriter(buffer, list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return buffer.getvalue()


def _marks(rows: List[dict]) -> str:
    counts = ((sum(row["mark"] == mark for row in rows), mark) for mark in MARKS)
    return ", ".join(f"{count} {mark}" for count, mark in counts)


def _markdown(rows: List[dict], models: Sequence[Path]) -> str:
    _, sources = load_ranges()
    outside = sum(row["within"] == "NO" for row in rows)
    lines = [
        "# Crop models",
        "",
        f"{len(models)} models, {len(rows)} metrics, {outside} outside the literature's range.",
        "",
        f"The ranges are {_marks(rows)}; `config/ranges.yaml` says what that means, and how each follows.",
        "",
        "![all models](contact_sheet.png)",
        "",
    ]
    by_model: Dict[str, List[dict]] = {}
    for row in rows:
        by_model.setdefault(row["model"], []).append(row)
    for name, own in by_model.items():
        lines += [
            f"## {name}: {own[0]['species']} {own[0]['stage']}, {own[0]['season']} season",
            "",
        ]
        lines += [
            "| metric | value | range | within | mark | source |",
            "|---|---|---|---|---|---|",
        ]
        lines += [
            f"| {r['metric']} | {r['value']} | {r['min']} to {r['max']}"
            f" | {r['within']} | {r['mark']} | {r['source']} |"
            for r in own
        ]
        lines.append("")
    lines += ["## Sources", ""] + [f"- **{key}**: {text}" for key, text in sources.items()]
    return "\n".join(lines) + "\n"


def _season_order(model: Path) -> tuple:
    metrics = read_metrics(model)
    season = SEASONS.index(metrics["season"]) if metrics["season"] in SEASONS else len(SEASONS)
    return metrics["species"], season, metrics["height_m"]


def report(models: Sequence[Path], output: Path) -> int:
    """Writes crop_report.md, crop_report.csv and contact_sheet.png; returns how many values lie outside."""
    rows = _rows(models)
    with output_folder(output):
        draw_contact_sheet(sorted(models, key=_season_order), output / "contact_sheet.png")
        write_file(output / "crop_report.csv", _csv(rows).encode())
        write_file(output / "crop_report.md", _markdown(rows, models).encode())
    return sum(row["within"] == "NO" for row in rows)


def _report(args: argparse.Namespace) -> None:
    folders = search_path(args.model_path)
    models = [find_model(name, folders) for name in args.models or load_variants()]
    outside = report(models, args.output)
    print(f"{args.output}: {len(models)} models, {outside} values outside the literature's range")
    if outside:
        raise SystemExit(1)


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """Returns 0 if every metric lies in its range; exits with 1 if one does not, with 2 for bad input."""
    parser = Parser(prog="crop_report", description=__doc__)
    parser.add_argument("--output", type=Path, required=True, help="folder to write the report in")
    add_model_path(parser)
    parser.add_argument(
        "models", nargs="*", help="models by name (default: all that the build makes)"
    )
    return run(parser, _report, arguments)
