# SPDX-License-Identifier: MIT
"""Command `generate_field`."""

import argparse
from pathlib import Path

from ardee_models.cli import run, seed_number
from ardee_models.errors import GeneratorError
from ardee_models.lookup import crop_model, search_path, terrain_model
from ardee_world.centres import read_centres
from ardee_world.config import FieldConfig, Plots
from ardee_world.layout import generate
from ardee_world.writers.field import write_field


def _plan_arguments(parser: argparse.ArgumentParser) -> None:
    usual = Plots()
    group = parser.add_argument_group("planting plan; rows run along -y of the field's frame")
    whole = (
        ("--rows", usual.rows_per_plot, "rows per plot"),
        ("--plots-x", usual.plots_x, "number of plots along x"),
        ("--plots-y", usual.plots_y, "number of plots along y"),
    )
    for flag, value, text in whole:
        group.add_argument(
            flag, type=int, default=value, metavar="N", help=f"{text} (default {value})"
        )
    metres = (
        ("--row-spacing", usual.row_spacing_m, "between rows"),
        ("--stalk-spacing", usual.stalk_spacing_m, "between stalks in a row"),
        (
            "--plot-spacing-x",
            usual.plot_spacing_x_m,
            "between the outer rows of plots side by side",
        ),
        (
            "--plot-spacing-y",
            usual.plot_spacing_y_m,
            "between the ends of plots one behind the other",
        ),
        ("--headland", usual.headland_m, "from the field's origin to the first stalks"),
    )
    for flag, value, text in metres:
        group.add_argument(
            flag, type=float, default=value, metavar="M", help=f"{text} [m] (default {value:g})"
        )
    length = group.add_mutually_exclusive_group()
    length.add_argument(
        "--row-length",
        type=float,
        default=usual.row_length_m,
        metavar="M",
        help="length of rows [m]",
    )
    length.add_argument("--stalks-per-row", type=int, metavar="N", help="instead of --row-length")
    group.add_argument(
        "--centers", type=Path, metavar="CSV", help="stalk centres x_m,y_m of your own instead"
    )


def _random_arguments(parser: argparse.ArgumentParser) -> None:
    usual = FieldConfig()
    group = parser.add_argument_group("variation")
    group.add_argument(
        "--noise-covariance",
        type=float,
        nargs="+",
        default=list(usual.noise_covariance_m2),
        metavar="M2",
        help="placement noise [m^2]: XX YY, or XX XY YY; x across the rows (default 0.000225 0 0.00125)",
    )
    for flag, value, text in (
        ("min", usual.emergence_min, "lowest"),
        ("max", usual.emergence_max, "highest"),
    ):
        group.add_argument(
            f"--emergence-{flag}",
            type=float,
            default=value,
            metavar="P",
            help=f"{text} probability (default {value})",
        )
    for flag in ("min", "max"):
        group.add_argument(
            f"--stalk-height-{flag}",
            type=float,
            metavar="M",
            help="plant height [m] (default: model's)",
        )
    group.add_argument(
        "--seed", type=seed_number, default=0, help="root of all random numbers (default 0)"
    )


def make_parser() -> argparse.ArgumentParser:
    """Arguments of thesis Figure 4.4."""
    parser = argparse.ArgumentParser(
        prog="generate_field",
        description="Write a random crop field as a Gazebo model directory with its ground truth.",
    )
    parser.add_argument(
        "--models",
        nargs="+",
        required=True,
        metavar="MODEL",
        help="pool of crop models to draw from",
    )
    parser.add_argument("--name", required=True, help="name of the field's model")
    parser.add_argument(
        "--output", type=Path, required=True, help="folder of models to write it in"
    )
    parser.add_argument(
        "--model-path",
        type=Path,
        nargs="+",
        default=[],
        metavar="DIR",
        help="folders of models before GAZEBO_MODEL_PATH",
    )
    _plan_arguments(parser)
    _random_arguments(parser)
    place = parser.add_argument_group("position")
    place.add_argument(
        "--terrain",
        metavar="MODEL",
        help="heightmap model at the world's origin to stand on (default level)",
    )
    place.add_argument(
        "--world-pose",
        type=float,
        nargs=3,
        default=list(FieldConfig().world_pose),
        metavar=("X", "Y", "YAW"),
        help="where the world will include the field [m m rad] (default 0 0 -1.57, as farm.world does)",
    )
    place.add_argument(
        "--gps-origin",
        type=float,
        nargs=2,
        metavar=("LAT", "LON"),
        help="of the world's origin [deg]",
    )
    return parser


def _config(args: argparse.Namespace) -> FieldConfig:
    covariance = args.noise_covariance
    if len(covariance) == 2:
        covariance = [covariance[0], 0.0, covariance[1]]
    if len(covariance) != 3:
        raise GeneratorError(
            f"noise covariance: found {len(covariance)} numbers, expected XX YY or XX XY YY"
        )
    length = args.row_length
    if args.stalks_per_row is not None:
        if args.stalks_per_row < 1:
            raise GeneratorError(
                f"stalks per row: found {args.stalks_per_row}, expected a whole number from 1"
            )
        length = round((args.stalks_per_row - 1) * args.stalk_spacing, 9)
    latitude, longitude = args.gps_origin or (None, None)
    return FieldConfig(
        plots=Plots(
            rows_per_plot=args.rows,
            plots_x=args.plots_x,
            plots_y=args.plots_y,
            row_length_m=length,
            row_spacing_m=args.row_spacing,
            stalk_spacing_m=args.stalk_spacing,
            plot_spacing_x_m=args.plot_spacing_x,
            plot_spacing_y_m=args.plot_spacing_y,
            headland_m=args.headland,
        ),
        noise_covariance_m2=tuple(covariance),
        emergence_min=args.emergence_min,
        emergence_max=args.emergence_max,
        stalk_height_min_m=args.stalk_height_min,
        stalk_height_max_m=args.stalk_height_max,
        origin_latitude_deg=latitude,
        origin_longitude_deg=longitude,
        world_pose=tuple(args.world_pose),
    )


def make_field(args: argparse.Namespace) -> Path:
    """Arguments to a written field."""
    config = _config(args)
    config.validate()
    folders = search_path(args.model_path)
    pool = tuple(crop_model(name, folders) for name in args.models)
    terrain = terrain_model(args.terrain, folders) if args.terrain else None
    centres = read_centres(args.centers) if args.centers else None
    layout = generate(config, pool, args.seed, terrain, centres)
    return write_field(layout, args.name, args.output, from_file=centres is not None)


def main() -> int:
    """`generate_field --models corn_variant_1 ... --name my_field --output DIR`."""
    return run(make_parser(), make_field)


if __name__ == "__main__":
    raise SystemExit(main())
