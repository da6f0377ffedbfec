# SPDX-License-Identifier: MIT
"""Assigns the triangles of a scene of several plants to their stalks."""

from typing import List, Sequence

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

_WELD_M = 1e-5  # vertices nearer than this are one
_GROUND = 0.06  # part of the scene's height: a component that reaches lower stands on the ground
_RISE = 0.1  # part of the scene's height that a stalk has at least
# A stalk's sideways spread over its height: bare stalks, else plants of one piece, else any standing component.
# Leaves that hang to the ground spread more than a bare stalk.
_SLENDER = (0.12, 0.5, float("inf"))
_EDGE = 0.01  # part of the scene's height: edges longer than this get points along them
_MOST_ON_EDGE = 200
_TOUCH_M = 0.004  # parts nearer than this belong together


def components(vertices: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Connected component of each vertex; vertices at the same place count as one."""
    cells = np.round(vertices / _WELD_M).astype(np.int64)
    _, welded = np.unique(cells, axis=0, return_inverse=True)
    welded = welded.reshape(-1)
    a = welded[triangles[:, [0, 1, 2]].ravel()]
    b = welded[triangles[:, [1, 2, 0]].ravel()]
    count = int(welded.max()) + 1
    graph = coo_matrix((np.ones(len(a), dtype=np.int8), (a, b)), shape=(count, count))
    return connected_components(graph, directed=False)[1][welded]


def _slenderness(points: np.ndarray, ground: float, height: float) -> float:
    """Spread over height of a component that stands on the ground and is tall enough; -1 for others."""
    low, high = points[:, 2].min(), points[:, 2].max()
    if low > ground + _GROUND * height or high - low < _RISE * height:
        return -1.0
    spread = np.linalg.norm(points[:, :2] - np.median(points[:, :2], axis=0), axis=1)
    return float(np.quantile(spread, 0.9) / (high - low))


def _seeds(parts: Sequence[np.ndarray], ground: float, height: float) -> np.ndarray:
    """Components that are stalks: those of the most slender kind present; all if none stands."""
    found = np.array([_slenderness(points, ground, height) for points in parts])
    for limit in _SLENDER:
        chosen = np.flatnonzero((found >= 0.0) & (found <= limit))
        if len(chosen):
            return chosen
    return np.arange(len(parts))


def _foot(points: np.ndarray) -> np.ndarray:
    """Ground position of a component: mean of its lowest vertices."""
    low = points[:, 2].min()
    return points[points[:, 2] <= low + 0.02 * np.ptp(points[:, 2]) + 1e-6, :2].mean(axis=0)


def _near_groups(feet: np.ndarray, gap_m: float) -> np.ndarray:
    """Groups of feet: feet nearer than `gap_m` to one another belong to one plant."""
    pairs = cKDTree(feet).query_pairs(gap_m, output_type="ndarray").reshape(-1, 2)
    graph = coo_matrix((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(len(feet),) * 2)
    return connected_components(graph, directed=False)[1]


def _with_edges(
    parts: Sequence[np.ndarray],
    component: np.ndarray,
    vertices: np.ndarray,
    triangles: np.ndarray,
    step_m: float,
) -> List[np.ndarray]:
    """Points of each component, with more along its long edges: a stalk may have vertices only at its ends."""
    edges = np.unique(np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
    a, b = vertices[edges[:, 0]], vertices[edges[:, 1]]
    count = np.minimum(np.linalg.norm(b - a, axis=1) // step_m, _MOST_ON_EDGE).astype(int)
    edge = np.repeat(np.arange(len(edges)), count)
    nth = np.arange(len(edge)) - np.repeat(np.cumsum(count) - count, count) + 1
    along = (nth / (count[edge] + 1))[:, None]
    points, owner = a[edge] * (1.0 - along) + b[edge] * along, component[edges[edge, 0]]
    return [np.concatenate((part, points[owner == i])) for i, part in enumerate(parts)]


def _attach(parts: Sequence[np.ndarray], group: np.ndarray) -> None:
    """Gives every component without a group (-1) the group of its nearest neighbour, touching components first."""
    while (group < 0).any():
        open_parts = np.flatnonzero(group < 0)
        groups = range(int(group.max()) + 1)
        trees = [
            cKDTree(np.concatenate([parts[i] for i in np.flatnonzero(group == g)])) for g in groups
        ]
        distance = np.array([[tree.query(parts[i])[0].min() for tree in trees] for i in open_parts])
        nearest = distance.min(axis=1)
        now = nearest <= max(_TOUCH_M, nearest.min())
        group[open_parts[now]] = distance[now].argmin(axis=1)


def plant_of_vertices(vertices: np.ndarray, triangles: np.ndarray, gap_m: float) -> np.ndarray:
    """Plant number of each vertex; plants are numbered by their feet from -x to x (then -y to y)."""
    component = components(vertices, triangles)
    count = int(component.max()) + 1
    order = np.argsort(component, kind="stable")
    bounds = np.searchsorted(component[order], np.arange(count + 1))
    parts = [vertices[order[bounds[i] : bounds[i + 1]]] for i in range(count)]
    ground, height = float(vertices[:, 2].min()), float(np.ptp(vertices[:, 2]))
    seeds = _seeds(parts, ground, height)
    feet = np.array([_foot(parts[i]) for i in seeds])
    near = _near_groups(feet, gap_m)
    middles = np.array([feet[near == g].mean(axis=0) for g in range(near.max() + 1)])
    number = np.empty(len(middles), dtype=int)
    number[np.lexsort((middles[:, 1], middles[:, 0]))] = np.arange(len(middles))
    group = np.full(count, -1)
    group[seeds] = number[near]
    _attach(_with_edges(parts, component, vertices, triangles, _EDGE * height), group)
    return group[component]
