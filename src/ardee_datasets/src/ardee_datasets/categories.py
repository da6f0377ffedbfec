# SPDX-License-Identifier: MIT
"""Categories of a data set: ARDEE's labels, and those that a recipe names for models of its own."""

from typing import Any, Dict, List, Mapping

_CROP = {"supercategory": "crop", "keypoints": ["foot"], "skeleton": []}
CATEGORIES = (
    {"id": 1, "name": "corn", **_CROP},
    {"id": 2, "name": "sorghum", **_CROP},
    {"id": 3, "name": "tobacco", **_CROP},
    {"id": 10, "name": "weed", "supercategory": "weed"},
    {"id": 11, "name": "stone", "supercategory": "clutter"},
    {"id": 12, "name": "litter", "supercategory": "clutter"},
)
OWN_LABELS = (13, 65535)  # least and greatest; a picture of labels has 16 bits
Category = Dict[str, Any]


def categories(labels: Mapping[str, int]) -> List[Category]:
    """Returns all categories in the order of their ids; `labels` are a recipe's own, by name."""
    own = [
        {"id": label, "name": name, **_CROP, "supercategory": "own"}
        for name, label in labels.items()
    ]
    return [*CATEGORIES, *sorted(own, key=lambda category: category["id"])]
