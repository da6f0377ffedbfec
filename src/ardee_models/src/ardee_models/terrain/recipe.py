# SPDX-License-Identifier: MIT
"""The recipe of a terrain: shapes and a surface, from arguments or a YAML file, checked."""

import dataclasses
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Iterator, Tuple

from ardee_common.config import build, read_yaml_lines
from ardee_common.errors import GeneratorError
from ardee_common.options import check, option
from ardee_common.output import check_name

_ANGLE = (-360.0, 360.0)
_FAR = (-10_000.0, 10_000.0)
SAMPLES = tuple(2**n + 1 for n in range(4, 13))  # sizes that OGRE's terrain accepts


def group(default: Any, kind: type) -> Any:
    """Dataclass field that is a group of options, or a tuple of them."""
    return dataclasses.field(default=default, metadata={"group": kind})


@dataclass(frozen=True)
class Ridges:
    """Ridges under crop rows, furrows between: raised cosines along `direction_deg`; a lane lies on the origin."""

    # 30 inches, usual for corn
    spacing_m: float = option(0.762, "distance between ridges", (0.1, 10.0))
    height_m: float = option(0.05, "height of a ridge over the furrow", (0.0, 1.0))
    half_width_m: float = option(0.25, "distance from the top of a ridge to its foot", (0.01, 5.0))
    direction_deg: float = option(0.0, "direction of the ridges, from the x axis", _ANGLE)


@dataclass(frozen=True)
class Ruts:
    """Two wheel tracks of a tractor, with the earth pressed out beside them, and lugs' marks across."""

    offset_m: float = option(0.0, "offset of the tracks' middle to the left of the origin", _FAR)
    direction_deg: float = option(0.0, "direction of the tracks, from the x axis", _ANGLE)
    track_m: float = option(1.524, "distance between the tracks' middles (60 inches)", (0.1, 10.0))
    width_m: float = option(0.4, "width of a track", (0.05, 3.0))
    depth_m: float = option(0.06, "depth of a track", (0.0, 1.0))
    lug_spacing_m: float = option(0.2, "distance between lugs' marks", (0.02, 2.0))
    lug_depth_m: float = option(0.01, "depth of lugs' marks", (0.0, 0.2))


@dataclass(frozen=True)
class Clods:
    """Rough ground of one scale: Gaussian heights, or lumps on level ground."""

    size_m: float = option(0.1, "correlation length", (0.005, 100.0))
    sd_m: float = option(0.008, "standard deviation of heights", (0.0, 0.5))
    lumps: bool = option(False, "separate clods on level ground, instead of rough ground")


@dataclass(frozen=True)
class Slope:
    """The whole ground tilted about the origin."""

    grade_percent: float = option(0.0, "rise over run", (-100.0, 100.0))
    direction_deg: float = option(
        0.0, "direction in which the ground rises, from the x axis", _ANGLE
    )


@dataclass(frozen=True)
class Ditch:
    """A trench with sloping banks; crop ridges, ruts and clods go on inside it."""

    offset_m: float = option(8.0, "offset of the ditch's middle to the left of the origin", _FAR)
    direction_deg: float = option(0.0, "direction of the ditch, from the x axis", _ANGLE)
    depth_m: float = option(0.4, "depth below the field", (0.0, 10.0))
    bottom_width_m: float = option(0.4, "width of the level bottom", (0.0, 100.0))
    bank_width_m: float = option(0.8, "width of each bank", (0.01, 100.0))


@dataclass(frozen=True)
class Headland:
    """The ends of the ridges: beyond these distances from the origin, along and across them, the ground is level."""

    along_m: float = option(10.0, "half length of the ridged part", (0.0, 10_000.0))
    across_m: float = option(10_000.0, "half width of the ridged part", (0.0, 10_000.0))
    fade_m: float = option(0.5, "distance over which ridges end", (0.0, 100.0))


@dataclass(frozen=True)
class Surface:
    """Numbers of the contact with wheels: friction along and across, stiffness and damping."""

    mu: float = option(0.8, "friction coefficient (rubber on firm soil)", (1e-6, 100.0))
    mu2: float = option(
        0.8,
        "friction coefficient in the second direction; that of mu if only mu is given",
        (1e-6, 100.0),
    )
    kp: float = option(100_000.0, "contact stiffness [N/m] (thesis Listing A.23)", (1.0, 1e12))
    kd: float = option(10_000.0, "contact damping [N s/m]", (0.0, 1e12))


@dataclass(frozen=True)
class Blend:
    """Texture k + 1 fades in over `fade_m` above this height over the lowest ground."""

    min_height_m: float = option(0.5, "height at which the next texture begins", (0.0, 10_000.0))
    fade_m: float = option(1.0, "height over which the next texture fades in", (0.0, 10_000.0))


@dataclass(frozen=True)
class Look:
    """Textures of the ground and how they blend (thesis Listing A.23)."""

    textures: Tuple[str, ...] = option(
        ("dirt", "grass", "fungus"), "names of textures, from the lowest ground upwards"
    )
    texture_size_m: float = option(1.0, "side of a texture's tile", (0.01, 1000.0))
    blends: Tuple[Blend, ...] = group((Blend(), Blend()), Blend)


@dataclass(frozen=True)
class Recipe:
    """A square of ground about the origin. Every part may be left out but the surface and the look."""

    form: str = option(
        "heightmap",
        "what is written: heights on a grid, or triangles",
        choices=("heightmap", "mesh"),
    )
    size_m: float = option(30.0, "side of the square", (1.0, 2000.0))
    samples: int = option(513, "pixels a side, 2^n + 1", (SAMPLES[0], SAMPLES[-1]))
    seed: int = option(0, "root of all random numbers", (0, 2**63))
    ridges: Tuple[Ridges, ...] = group((), Ridges)
    headland: Tuple[Headland, ...] = group((), Headland)
    ruts: Tuple[Ruts, ...] = group((), Ruts)
    clods: Tuple[Clods, ...] = group((), Clods)
    slope: Slope = group(Slope(), Slope)
    ditches: Tuple[Ditch, ...] = group((), Ditch)
    surface: Surface = group(Surface(), Surface)
    look: Look = group(Look(), Look)

    def validate(self) -> None:
        """Raises GeneratorError for the first value out of range."""
        check(self, "terrain ")
        if self.samples not in SAMPLES:
            known = ", ".join(map(str, SAMPLES))
            raise GeneratorError(f"terrain samples: found {self.samples}, expected one of {known}")
        for name, many in (("ridges", self.ridges), ("headland", self.headland)):
            if len(many) > 1:
                raise GeneratorError(f"terrain {name}: found {len(many)}, expected one or none")
        parts = (*self.ridges, *self.headland, *self.ruts, *self.clods, self.slope, *self.ditches)
        for part in (*parts, self.surface, self.look, *self.look.blends):
            check(part, f"terrain {type(part).__name__.lower()} ")
        for ridges in self.ridges:
            if ridges.half_width_m > 0.5 * ridges.spacing_m:
                raise GeneratorError(
                    f"terrain ridges half width: found {ridges.half_width_m:g} m, expected at most half"
                    f" of their spacing, {0.5 * ridges.spacing_m:g} m"
                )
        if (
            not 1 <= len(self.look.textures) <= 5
            or len(self.look.blends) < len(self.look.textures) - 1
        ):
            raise GeneratorError(
                f"terrain look: found {len(self.look.textures)} textures and {len(self.look.blends)} blends, "
                "expected 1 to 5 textures and a blend between each two"
            )
        for texture in self.look.textures:
            check_name(texture)
        if self.form == "mesh" and self.look != Look():
            raise GeneratorError(
                "terrain look: found one with form mesh, which has one texture, expected none"
            )


def too_fine(recipe: Recipe) -> Iterator[str]:
    """Yields a warning for each part of a recipe that its pixels are too coarse for."""
    pixel_m = recipe.size_m / (recipe.samples - 1)
    sizes = [("ridges", "spacing", ridges.spacing_m) for ridges in recipe.ridges]
    sizes += [("clods", "size", clods.size_m) for clods in recipe.clods]
    for part, what, size_m in sizes:
        if pixel_m > 0.5 * size_m:
            yield (
                f"terrain {part} {what}: found {size_m:g} m, expected at least two pixels of {pixel_m:g} m,"
                " or more samples"
            )


def read_recipe(path: Path) -> Recipe:
    """Reads a recipe from its YAML file; a single ridges or headland mapping needs no list, mu2 is by default mu."""
    mapping = read_yaml_lines(path)
    for key in ("ridges", "headland"):
        if isinstance(mapping.get(key), dict):
            mapping[key] = [mapping[key]]
    surface = mapping.get("surface")
    if isinstance(surface, dict) and "mu" in surface:
        surface.setdefault("mu2", surface["mu"])
    recipe = build(Recipe, mapping)
    try:
        recipe.validate()
    except GeneratorError as error:
        raise GeneratorError(f"{path}: {error}") from error
    return recipe
