# SPDX-License-Identifier: MIT
"""Derives sizes of grasses and tobacco by stage from published formulas, for the bounds of config/ranges.yaml.

It shares no code with the generator and reads none of its parameters. Each trait has a low and a high value: the bounds
of its source. A quantity is evaluated with all traits at their middle; the largest change of its logarithm over
each trait's range is combined in quadrature, as the traits of a cultivar vary apart from each other. So
low, high = middle / exp(q), middle * exp(q).
"""

import math
from typing import Callable, Dict, NamedTuple, Sequence, Tuple

Bounds = Tuple[float, float]


class Trait(NamedTuple):
    """A trait's least, middle and greatest value over cultivars."""

    low: float
    middle: float
    high: float


def between(low: float, high: float) -> Trait:
    """Returns a trait that varies by a factor; its middle is the geometric mean."""
    return Trait(low, math.sqrt(low * high), high)


def spread(quantity: Callable[..., float], **traits: Trait) -> Bounds:
    """Returns low and high of a quantity whose traits vary independently."""
    middle = {name: trait.middle for name, trait in traits.items()}
    value = quantity(**middle)
    squares = 0.0
    for name, trait in traits.items():
        ends = (quantity(**{**middle, name: end}) for end in (trait.low, trait.high))
        squares += max(abs(math.log(end / value)) for end in ends) ** 2
    factor = math.exp(math.sqrt(squares))
    return value / factor, value * factor


class Grass(NamedTuple):
    """Traits of a species of grass; lengths in metres, areas one-sided in square metres."""

    shape: float  # leaf area over length times width
    index: Trait  # leaf area index of the full-grown stand
    area: Trait  # leaf area of a full-grown plant
    number: Trait  # leaves of a full-grown plant
    largest: Trait  # relative rank of the largest leaf
    skew: Trait  # relative area of a leaf of rank 0, by which ArchiCrop fits the bell
    ratio: Trait  # width over length of a leaf
    height: Trait  # height of the full-grown plant, with its head
    head: float  # tassel, or panicle with its peduncle
    short: int  # phytomers at the base whose internodes stay short


# ArchiCrop: skew, ratio, short phytomers 2-5; Helios: ears on nodes 9-11 of 17, the largest leaf beside them (nominal);
# Agriculture 2020: 17-23 leaves; leaf area index 2.8 (Edoka) to 5.5 (nominal); area = 2.8-4.6 (Edoka) over
# 8.4-6.9 plants/m2 (Ohio State); height 2.0-2.8 m, tassel 0.45 m and 0.75 (Montgomery's factor) nominal.
CORN = Grass(
    0.75,
    between(2.8, 5.5),
    between(2.8 / 8.4, 4.6 / 6.9),
    Trait(17, 20, 23),
    Trait(9 / 17, 10 / 17, 11 / 17),
    between(1e-4, 1e-2),
    between(0.10, 0.13),
    Trait(2.0, 2.4, 2.8),
    0.45,
    5,
)
# 0.741: Shih et al. 1981; area to 0.4 m2, ratio, skew, height 2 m, 15 leaves: ArchiCrop; to 20 leaves, stem 1.5 m:
# Olson et al. 2012; nominal: leaf area index 3-6 (over 30 plants/m2 the least area), largest leaf at two thirds of
# the ranks, panicle with peduncle 0.25 m, six short phytomers.
SORGHUM = Grass(
    0.741,
    between(3.0, 6.0),
    between(3.0 / 30, 0.4),
    Trait(15, 18, 20),
    Trait(0.60, 0.67, 0.74),
    between(1e-4, 1e-2),
    between(0.10, 0.12),
    Trait(1.2, 1.5, 2.0),
    0.25,
    6,
)
BLADE_BASE = (
    0.6  # width of a blade at its ligule over its greatest, ArchiCrop klig (Dornbusch 2011)
)
# The foot is as thick as one sheath wound once (1.0), or as ArchiCrop's base of 2.2 cm under an 8.6 cm leaf (1.33)
WINDING = between(1.0, 1.33)
# A blade leaving at 35 degrees from the vertical rises by cos 35 degrees of its length if straight and by
# (1 - sin 35 degrees) / (120 degrees in rad) if it bends by ArchiCrop's 120 degrees along it
RISE = between(
    (1 - math.sin(math.radians(35))) / math.radians(120),
    math.cos(math.radians(35)),
)
SHEATH = between(0.2, 0.4)  # sheath over blade, nominal
LAG = Trait(1, 2, 4)  # phytomers between the last collar and the last full-grown internode, nominal


def relative_areas(number: float, largest: float, skew: float) -> Sequence[float]:
    """Returns the area of each leaf over that of the largest (ArchiCrop's bell)."""
    k = -math.log(skew) * largest
    ranks = (rank / round(number) - largest for rank in range(1, round(number) + 1))
    return [math.exp(-k / largest * (2 * r**2 + r**3)) for r in ranks]


def shown_share(collars: int, young: float, **bell: float) -> float:
    """Returns the visible share of the plant's final leaf area; `young` leaves in the whorl show ever shorter tips."""
    areas = relative_areas(**bell)
    young = round(young)
    tips = areas[collars : collars + young]
    shown = sum(a * ((young - j) / (young + 1)) ** 2 for j, a in enumerate(tips))
    return (sum(areas[:collars]) + shown) / sum(areas)


def blade_lengths(area: float, ratio: float, shape: float, **bell: float) -> Sequence[float]:
    """Returns the length of each full-grown blade, from area = shape * length * width."""
    areas = relative_areas(**bell)
    return [math.sqrt(area * a / sum(areas) / (shape * ratio)) for a in areas]


def _bell(grass: Grass) -> Dict[str, Trait]:
    return {"number": grass.number, "largest": grass.largest, "skew": grass.skew}


def _blades(grass: Grass) -> Dict[str, Trait]:
    return {"area": grass.area, "ratio": grass.ratio, **_bell(grass)}


def _shown(grass: Grass, collars: int, full: Trait) -> Bounds:
    young = Trait(1, 2, 4) if collars < 4 else Trait(2, 3, 5)

    def quantity(full: float, young: float, **bell: float) -> float:
        return full * shown_share(min(collars, round(bell["number"])), young, **bell)

    return spread(quantity, full=full, young=young, **_bell(grass))


def leaf_area(grass: Grass, collars: int) -> Bounds:
    """Returns the leaf area of a plant with so many collars, m2."""
    return _shown(grass, collars, grass.area)


def leaf_area_index(grass: Grass, collars: int) -> Bounds:
    """Returns the leaf area index of a stand of plants with so many collars."""
    return _shown(grass, collars, grass.index)


def longest_blade(grass: Grass) -> Bounds:
    """Returns the length of the longest blade of a full-grown plant, m."""
    return spread(lambda **t: max(blade_lengths(shape=grass.shape, **t)), **_blades(grass))


def widest_blade(grass: Grass) -> Bounds:
    """Returns the width of the widest blade of a full-grown plant, m."""
    return spread(
        lambda **t: t["ratio"] * max(blade_lengths(shape=grass.shape, **t)), **_blades(grass)
    )


def stalk_diameter(grass: Grass, collars: int) -> Bounds:
    """Returns the diameter of the foot, m: the widest sheath so far, as wide as its blade's base, wound round it."""

    def quantity(winding: float, **t: float) -> float:
        widest = t["ratio"] * max(blade_lengths(shape=grass.shape, **t)[: collars + 1])
        return winding * BLADE_BASE * widest / math.pi

    return spread(quantity, winding=WINDING, **_blades(grass))


def plant_height(grass: Grass, collars: int) -> Bounds:
    """Returns the top of a plant in leaf, m: full-grown internodes, the last collar's sheath, the next blade's rise."""

    def quantity(rise: float, sheath: float, height: float, lag: float, **t: float) -> float:
        lengths = blade_lengths(shape=grass.shape, **t)
        last = min(collars, len(lengths))
        internode = (height - grass.head) / (len(lengths) - grass.short)
        grown = max(0.0, last - lag - grass.short)
        following = lengths[min(last, len(lengths) - 1)]
        return grown * internode + sheath * lengths[last - 1] + rise * following

    return spread(
        quantity, rise=RISE, sheath=SHEATH, height=grass.height, lag=LAG, **_blades(grass)
    )


def leaf_height(grass: Grass) -> Bounds:
    """Returns the mean height of a full-grown plant's leaf area, m: of each blade, its collar's and half its rise."""

    def quantity(rise: float, sheath: float, height: float, **t: float) -> float:
        lengths = blade_lengths(shape=grass.shape, **t)
        internode = (height - grass.head) / (len(lengths) - grass.short)
        areas = [length**2 for length in lengths]
        heights = (
            max(rank - grass.short, 0) * internode + (sheath + rise / 2) * length
            for rank, length in enumerate(lengths, 1)
        )
        return sum(a * h for a, h in zip(areas, heights)) / sum(areas)

    return spread(quantity, rise=RISE, sheath=SHEATH, height=grass.height, **_blades(grass))


# Tobacco. CORESTA 2003: a leaf appears every 5-6 days to leaf 8, every 2-3 to leaf 18, every 1-2 after, and grows for
# 37 days. A leaf of 1241 cm2 is the largest mean of a trial (PVH-1600), 800 cm2 a small one (nominal);
# 18000-22000 plants/ha (Xingren).
LEAF_AREA = between(0.080, 0.1241)
DENSITY = between(1.8, 2.2)
GROWTH_DAYS = Trait(30, 37, 45)
SEEDBED_LEAVES = 5  # nominal
TOBACCO_RATIO = between(1.45, 2.63)  # length over width, CORESTA 2003
TOBACCO_SHAPE = 0.65  # leaf area over length times width, nominal
FULL_STALK = between(0.025, 0.040)  # nominal


def _leaf_interval_days(rank: int) -> float:
    return 5.5 if rank < 8 else 2.5 if rank < 18 else 1.5


def tobacco_leaves(visible: float, days: float = 0.0, growth_days: float = 37.0) -> float:
    """Returns the sum of leaf areas over the final area of a mean leaf, `days` after the last of them appeared.

    Length grows in proportion to age and area as its square; first and last leaves end at half the size of the middle
    ones, and those of the seedbed, grown in the crowd and set back by transplanting, at a quarter (nominal).
    """
    visible = round(visible)
    number = max(25, visible)
    final = [1 - ((rank / number - 0.5) / 0.75) ** 2 for rank in range(1, number + 1)]
    final[:SEEDBED_LEAVES] = [0.25] * SEEDBED_LEAVES
    total = 0.0
    for rank in range(1, visible + 1):
        age = days + sum(_leaf_interval_days(r) for r in range(rank, visible))
        age += _leaf_interval_days(visible) / 2
        total += final[rank - 1] * min(1.0, age / growth_days) ** 2
    return total * number / sum(final)


def tobacco_index(visible: Trait, days: float = 0.0) -> Bounds:
    """Returns the leaf area index of untopped tobacco."""
    return spread(
        lambda n, g, a, d: a * d * tobacco_leaves(n, days, g),
        n=visible,
        g=GROWTH_DAYS,
        a=LEAF_AREA,
        d=DENSITY,
    )


def transplant_index() -> Bounds:
    """Returns the leaf area index soon after transplanting: 5-8 leaves 10-25 cm long (nominal)."""
    return spread(
        lambda n, long, ratio, d: n * d * TOBACCO_SHAPE * long**2 / ratio,
        n=Trait(5, 6, 8),
        long=between(0.10, 0.25),
        ratio=TOBACCO_RATIO,
        d=DENSITY,
    )


def tobacco_blade() -> Tuple[Bounds, Bounds]:
    """Returns length and width of the largest full-grown leaf, m; it has 1.2 times the mean leaf's area (parabola)."""
    traits = {"area": LEAF_AREA, "ratio": TOBACCO_RATIO}
    length = spread(lambda area, ratio: math.sqrt(1.2 * area * ratio / TOBACCO_SHAPE), **traits)
    width = spread(lambda area, ratio: math.sqrt(1.2 * area / ratio / TOBACCO_SHAPE), **traits)
    return length, width


def topped_index(leaves: Trait) -> Bounds:
    """Returns the leaf area index of topped tobacco with all leaves full-grown."""
    return spread(lambda n, a, d: n * a * d, n=leaves, a=LEAF_AREA, d=DENSITY)


def tobacco_stalk(visible: Trait) -> Bounds:
    """Returns the diameter of the foot, m: its section in proportion to the leaf area above it (pipe model)."""
    full = tobacco_leaves(25, 20.0)
    return spread(
        lambda n, g, stalk: stalk * math.sqrt(tobacco_leaves(n, 0.0, g) / full),
        n=visible,
        g=GROWTH_DAYS,
        stalk=FULL_STALK,
    )
