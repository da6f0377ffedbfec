# SPDX-License-Identifier: MIT
"""Learns to tell plants from the rest by the colour of a pixel: train_plant_mask.py MY_SET."""
import sys
from pathlib import Path
from typing import Tuple

import numpy as np
from PIL import Image

PLANTS = (1, 2, 3, 10)  # corn, sorghum, tobacco, weed: categories.json
EVERY = 7  # pixels of which one is learned from


def features(rgb: np.ndarray) -> np.ndarray:
    """Returns a constant, the colours and their products, [n, 10]."""
    r, g, b = rgb.reshape(-1, 3).T / 255.0
    return np.stack((np.ones_like(r), r, g, b, r * r, g * g, b * b, r * g, g * b, b * r), axis=1)


def pixels(folder: Path, split: str) -> Tuple[np.ndarray, np.ndarray]:
    """Returns features of all pixels of a split, and whether each shows a plant."""
    xs, ys = [], []
    for file in sorted((folder / split / "rgb").glob("*.png")):
        xs.append(features(np.asarray(Image.open(file), dtype=float)))
        labels = np.asarray(Image.open(folder / split / "labels" / file.name))
        ys.append(np.isin(labels, PLANTS).ravel())
    return np.concatenate(xs), np.concatenate(ys)


def learn(x: np.ndarray, is_plant: np.ndarray) -> np.ndarray:
    """Returns the weights of a logistic regression, by Newton's method."""
    weights = np.zeros(x.shape[1])
    for _ in range(12):
        chance = 1.0 / (1.0 + np.exp(-np.clip(x @ weights, -30.0, 30.0)))
        slope = x.T @ (is_plant - chance) - 1e-3 * weights
        curvature = (x * (chance * (1.0 - chance))[:, None]).T @ x + 1e-3 * np.eye(len(weights))
        weights += np.linalg.solve(curvature, slope)
    return weights


def iou(weights: np.ndarray, x: np.ndarray, is_plant: np.ndarray) -> float:
    """Returns intersection over union of the plants found and those that are there."""
    found = x @ weights > 0.0
    return float((found & is_plant).sum() / (found | is_plant).sum())


if __name__ == "__main__":
    data_set = Path(sys.argv[1])
    x_train, y_train = pixels(data_set, "train")
    learned = learn(x_train[::EVERY], y_train[::EVERY])
    for split, (x, y) in {"train": (x_train, y_train), "val": pixels(data_set, "val")}.items():
        print(f"{split}: {y.mean():.0%} of the pixels are plants, IoU {iou(learned, x, y):.2f}")
