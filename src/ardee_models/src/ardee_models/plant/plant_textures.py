# SPDX-License-Identifier: MIT
"""Texture images of plants, drawn by the program. RGB uint8, row 0 on top, the organ's base at the lower edge."""

from typing import Callable, Dict, Tuple

import numpy as np

from ardee_models.plant import corn_organs, sorghum_head, tobacco_head
from ardee_models.plant.organ_params import Colours
from ardee_models.plant.plan import Plan
from ardee_models.plant.shoot import STRIP_DRYNESS
from ardee_models.plant.species import CropParams
from ardee_models.plant.stalk import StalkPlan
from ardee_models.smooth_noise import layered_noise, smooth_noise

_STRIP = (256, 48)  # pixels of one leaf strip
_STEM = (512, 32)
_HEAD = (128, 64)
_PARALLEL_VEINS = 14  # veins drawn across a blade; a corn leaf has some 20 large ones
_PINNATE_VEINS = 9  # side veins drawn along a blade
_BRAN = np.array([92.0, 66.0, 44.0])
_WAX = np.array([196.0, 206.0, 180.0])


def _image(rgb: np.ndarray) -> np.ndarray:
    return np.clip(np.rint(rgb), 0, 255).astype(np.uint8)


def _mix(a: np.ndarray, b: np.ndarray, part: np.ndarray) -> np.ndarray:
    """Mixed colours: a where part is 0, b where it is 1; `part` has one dimension less than colours."""
    part = np.clip(part, 0.0, 1.0)[..., None]
    return a * (1.0 - part) + b * part


def _axes(shape: Tuple[int, int]) -> tuple:
    """Texture axes: v from 0 at the lower edge to 1 on top, u from -1 to 1 across."""
    v = (1.0 - np.linspace(0.0, 1.0, shape[0]))[:, None]
    return v, np.linspace(-1.0, 1.0, shape[1])[None, :]


def _veins(venation: str, v: np.ndarray, u: np.ndarray) -> np.ndarray:
    """Strength of the side veins, 0 to 1."""
    if venation == "parallel":
        return np.broadcast_to(0.5 + 0.5 * np.cos(np.pi * _PARALLEL_VEINS * u), (len(v), u.size))
    # side veins leave the midrib forwards and bend along the edge
    phase = _PINNATE_VEINS * (v - 0.16 * np.abs(u) - 0.10 * u**2) + 0.25 * np.sign(u)
    return (0.5 + 0.5 * np.cos(2.0 * np.pi * phase)) ** 7


def leaf_strip(
    colours: Colours, venation: str, dryness: float, rng: np.random.Generator
) -> np.ndarray:
    """One blade from base to tip: veins, pale midrib, yellowing and brown that come from tip and edges."""
    v, u = _axes(_STRIP)
    grain = layered_noise(_STRIP, (2.0, 10.0), rng)
    patches = smooth_noise(_STRIP, 11.0, rng)
    shade = 1.0 + rng.normal(0.0, 0.04) + 0.035 * grain + 0.06 * (v - 0.5)
    leaf = np.array(colours.leaf) * shade[..., None]
    yellow, dry = np.array(colours.yellowing), np.array(colours.dry)
    # a drying front: where it passes 0 the blade yellows, where it passes 1 it is dead
    front = 3.2 * dryness - 1.0 + 0.5 * v**3 + 0.35 * np.abs(u) ** 3 + 0.28 * patches
    tissue = _mix(leaf, yellow * shade[..., None], front + 0.45)
    tissue = _mix(tissue, dry * shade[..., None], 1.6 * (front - 0.55))
    spots = np.clip(2.5 * (smooth_noise(_STRIP, 2.0, rng) - 2.7 + 1.1 * dryness), 0.0, 0.7)
    tissue = _mix(tissue, np.broadcast_to(_BRAN, tissue.shape), spots)
    pale = _mix(np.array(colours.midrib)[None, None, :], dry[None, None, :], np.array([[dryness]]))
    depth = 0.16 if venation == "parallel" else 0.42
    tissue = _mix(tissue, np.broadcast_to(pale, tissue.shape), depth * _veins(venation, v, u))
    width = 0.13 - 0.10 * v
    return tissue + (np.broadcast_to(pale, tissue.shape) - tissue) * (
        0.85 * np.exp(-((u / width) ** 2))[..., None]
    )


def leaves(colours: Colours, venation: str, rng: np.random.Generator) -> np.ndarray:
    """Image of leaf strips side by side, from green to dead."""
    return _image(
        np.concatenate([leaf_strip(colours, venation, d, rng) for d in STRIP_DRYNESS], axis=1)
    )


def stem(
    colours: Colours, stalk: StalkPlan, maturity: float, rng: np.random.Generator
) -> np.ndarray:
    """Image of a stem from foot to top: fibres, a ring at each node, the pale edge of each sheath at its collar."""
    v, _ = _axes(_STEM)
    fibres = smooth_noise((1, _STEM[1]), 1.2, rng)
    shade = 1.0 + 0.07 * fibres + 0.05 * layered_noise(_STEM, (3.0, 14.0), rng)
    body = _mix(
        np.array(colours.stem), np.array(colours.dry), np.broadcast_to(maturity, shade.shape)
    )
    body = _mix(body, np.broadcast_to(np.array(colours.foot), body.shape), 0.75 * np.exp(-v / 0.05))
    length = stalk.curve.length_m
    rings, edges = np.zeros_like(v), np.zeros_like(v)
    for collar, sheathed in zip(stalk.collars_m[:-1], stalk.sheathed):
        offset = (v - collar / length) * length
        if sheathed and stalk.sheath_m > 0.0:
            edges = np.maximum(edges, np.exp(-((offset / 0.006) ** 2)))
        else:
            rings = np.maximum(rings, np.exp(-((offset / 0.007) ** 2)))
    body = _mix(body, np.broadcast_to(_WAX, body.shape), 0.6 * edges + 0.0 * shade)
    body = _mix(body, np.broadcast_to(_BRAN, body.shape), 0.5 * rings + 0.0 * shade)
    return _image(body * shade[..., None])


def _banded(bands: dict, rng: np.random.Generator) -> np.ndarray:
    """Image of bands, given as (low, high) -> (colour at its lower edge, at its upper, contrast of grain in pixels)."""
    v, _ = _axes(_HEAD)
    rgb = np.zeros((*_HEAD, 3))
    for (low, high), (bottom, top, contrast, size) in bands.items():
        # the gaps between bands belong to the band below, so that filtering does not mix the colours of two organs
        inside = (v[:, 0] >= low - 0.03) & (v[:, 0] <= high + 0.03)
        part = np.broadcast_to((v - low) / (high - low), _HEAD)
        colour = _mix(np.array(bottom, dtype=float), np.array(top, dtype=float), part)
        shade = 1.0 + contrast * smooth_noise(_HEAD, size, rng)
        rgb[inside] = (colour * shade[..., None])[inside]
    return _image(rgb)


def _tassel(c: Colours, maturity: float, rng: np.random.Generator) -> np.ndarray:
    head = _mix(np.array(c.head), np.array(c.head_ripe), np.array(maturity))
    return _banded({(0.0, 1.0): (0.8 * head + 0.2 * np.array(c.stem), head, 0.14, 1.2)}, rng)


def _ears(c: Colours, maturity: float, rng: np.random.Generator) -> np.ndarray:
    husk = _mix(np.array([130.0, 160.0, 78.0]), np.array([204.0, 182.0, 126.0]), np.array(maturity))
    fresh, withered = np.array([206.0, 200.0, 128.0]), np.array([96.0, 54.0, 34.0])
    silk = _mix(fresh, withered, np.array(min(3.5 * maturity, 1.0)))
    image = _banded(
        {
            corn_organs.HUSK_BAND: (0.9 * husk, husk, 0.05, 5.0),
            corn_organs.SILK_BAND: (silk, 0.8 * silk, 0.12, 1.0),
        },
        rng,
    ).astype(float)
    _, u = _axes(_HEAD)
    return _image(image * (1.0 + 0.07 * np.cos(24.0 * np.pi * u))[..., None])


def _panicle(c: Colours, maturity: float, rng: np.random.Generator) -> np.ndarray:
    head = _mix(np.array(c.head), np.array(c.head_ripe), np.array(min(1.35 * maturity, 1.0)))
    return _banded(
        {
            sorghum_head.PEDUNCLE_BAND: (c.stem, c.stem, 0.05, 3.0),
            sorghum_head.GRAIN_BAND: (0.92 * head, 1.05 * head, 0.20, 1.0),
        },
        rng,
    )


def _flowers(c: Colours, maturity: float, rng: np.random.Generator) -> np.ndarray:
    twig = _mix(np.array(c.stem), np.array(c.dry), np.array(maturity))
    return _banded(
        {
            tobacco_head.BRANCH_BAND: (twig, twig, 0.06, 3.0),
            tobacco_head.TUBE_BAND: ([170.0, 190.0, 120.0], [232.0, 196.0, 196.0], 0.03, 3.0),
            tobacco_head.LIMB_BAND: ([240.0, 206.0, 208.0], c.head, 0.04, 3.0),
            tobacco_head.CAPSULE_BAND: (c.head_ripe, c.head_ripe, 0.10, 2.0),
        },
        rng,
    )


def _roots(c: Colours, maturity: float, rng: np.random.Generator) -> np.ndarray:
    return _banded({(0.0, 1.0): ([132.0, 142.0, 88.0], [122.0, 92.0, 66.0], 0.08, 2.0)}, rng)


_HEADS: Dict[str, Callable[[Colours, float, np.random.Generator], np.ndarray]] = {
    "Tassel": _tassel,
    "Ears": _ears,
    "Panicle": _panicle,
    "Flowers": _flowers,
    "Roots": _roots,
}


def plant_textures(
    params: CropParams, plan: Plan, rng: np.random.Generator
) -> Dict[str, np.ndarray]:
    """Images by organ texture name, of the organs that the plant has."""
    colours, maturity = params.colours, params.stage.maturity
    images = {
        "leaves": leaves(colours, params.architecture.leaves.venation, rng),
        "stem": stem(colours, plan.main.stalk, 0.6 * maturity, rng),
    }
    for name in plan.bodies:
        images[name.lower()] = _HEADS[name](colours, maturity, rng)
    return images
