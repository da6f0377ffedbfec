# SPDX-License-Identifier: MIT
"""The field of a scene: sown in a folder, opened as a simulation, with poses for cameras in its lanes."""

import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import Dict, List, Optional, Tuple

import numpy as np
from ardee_sim import Simulation, World, packages
from ardee_sim.world import Placement, Plant
from scipy.spatial.transform import Rotation

from ardee_common.errors import GeneratorError
from ardee_datasets.camera import CameraKeys
from ardee_datasets.field_options import FIELD, TERRAIN, WIDEST_LANE_M
from ardee_datasets.lens import Lens
from ardee_datasets.plan import Scene
from ardee_datasets.ranges import Range
from ardee_datasets.rows import read_rows
from ardee_datasets.seeds import stream
from ardee_models.lookup import search_path
from ardee_models.terrain.ground import ground_model
from ardee_world.generate_field import make_configured
from ardee_world.row_truth import Lane, Polyline, Pose, lane_of, read_field
from ardee_world.trial import standing_m
from ardee_world.writers.world import world_text

# Axes of the optical frame (x right, y down, z ahead) in those of a body (x ahead, y left, z up), REP 103
_OPTICAL = np.array([[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])


@dataclass(frozen=True)
class CameraPose:
    """Pose of a camera in the world, x ahead, y left, z up, and its motion in the world's axes."""

    xyz_m: np.ndarray
    rotation: Rotation
    v_m_s: np.ndarray = field(default_factory=lambda: np.zeros(3))
    w_rad_s: np.ndarray = field(default_factory=lambda: np.zeros(3))

    def body_matrix(self) -> np.ndarray:
        """Returns the pose as a 4x4 matrix."""
        made = np.eye(4)
        made[:3, :3] = self.rotation.as_matrix()
        made[:3, 3] = self.xyz_m
        return made

    def matrix(self) -> np.ndarray:
        """Returns X_WC, 4x4: the optical frame (x right, y down, z ahead) in the world."""
        made = self.body_matrix()
        made[:3, :3] = made[:3, :3] @ _OPTICAL
        return made


@dataclass(frozen=True)
class Item:
    """A plant or a piece of clutter: its name in the truth (plant_7, weed_0), label, parts, and place."""

    truth_id: str
    label: int
    visuals: Dict[int, str]  # names of its parts, by their numbers in pictures
    foot_m: Optional[np.ndarray] = None  # of a plant, in the world
    place: Dict[str, int] = field(
        default_factory=dict
    )  # of a plant: plot, row in it, place in the row


def _between(rows: Tuple[np.ndarray, np.ndarray], share: float) -> Pose:
    """Returns the middle between two rows at a share of the first one's length, with that one's direction."""
    one, other = (Polyline(row) for row in rows)
    at = one.at(share * one.length_m)
    left_m = other.project(at.x_m, at.y_m).left_m  # of the place on one row, seen from the other
    side = at.yaw_rad - math.pi / 2
    x, y = at.x_m + left_m / 2 * math.cos(side), at.y_m + left_m / 2 * math.sin(side)
    return Pose(x, y, at.yaw_rad)


def _item(placement: Placement, plant: Optional[Plant]) -> Item:
    name = placement.name.rpartition("::")[2]
    if plant is None:
        return Item(name, placement.label, placement.visuals)
    place = {"plot": plant.plot, "row": plant.row, "place": plant.place}
    return Item(name, placement.label, placement.visuals, plant.xyz_m, place)


class Scenery:
    """A sown field with its simulation."""

    def __init__(self, scene: Scene, folder: Path) -> None:
        options = scene.options()
        shipped = [Path(name) for name in packages.model_folders()]
        terrain = options["terrain"] = options.get("terrain") or TERRAIN
        values = {
            **options,
            "name": FIELD,
            "output": str(folder),
            "seed": scene.seed,
            "format": "sdf",
            "model_path": tuple(map(str, shipped)),
        }
        self.folder = make_configured(values, has_map=False)
        self._ground = ground_model(terrain, search_path(shipped))
        text = world_text(terrain, FIELD)
        world = World.from_string(text, base_dir=folder, model_paths=[folder, *shipped])
        plants = {plant.instance: plant for plant in world.plants()}
        self.rows = read_rows(self.folder / "truth.json", self._ground)
        self.items = {
            placement.instance: _item(placement, plants.get(placement.instance))
            for placement in world.placements()
            if placement.label
        }
        self.simulation = Simulation(world, seed=scene.seed)
        self.light = scene.light()
        if self.light:
            self.simulation.set_light(self.light)
        self._seed = scene.seed
        self._field = read_field(self.folder / "truth.json")
        self._lanes = self._find_lanes()

    def _find_lanes(self) -> List[Tuple[np.ndarray, np.ndarray]]:
        """Returns the pairs of neighbouring rows that run side by side, as polylines [n, 2]."""
        rows, lanes = self._field.rows, []
        for left, right in zip(rows, rows[1:]):
            a, b = Polyline(left), Polyline(right)
            middle = a.at(a.length_m / 2)
            seen = b.project(middle.x_m, middle.y_m)
            is_beside = abs(math.sin(seen.direction_rad - middle.yaw_rad)) < 0.5
            is_beside = is_beside and 0.0 <= seen.along_m <= b.length_m  # not in the plot behind
            if is_beside and abs(seen.left_m) < WIDEST_LANE_M:
                lanes.append((left, right))
        if not lanes:
            raise GeneratorError("found no two rows side by side, expected a lane for the camera")
        return lanes

    def lens(self, name: str, keys: CameraKeys) -> Lens:
        """Returns the lens of a camera, with the dust and drops that it has in this field."""
        if not keys.lens:
            return Lens()
        assert keys.width_px and keys.height_px
        rng = stream(self._seed, "lens", name)
        return keys.lens.draw(rng, (keys.width_px, keys.height_px))

    def draw_lane(self, rng: np.random.Generator) -> Lane:
        """Returns a lane to be driven along, either way."""
        middle = _between(self._lanes[rng.integers(len(self._lanes))], 0.5)
        yaw_rad = middle.yaw_rad + (math.pi if rng.integers(2) else 0.0)
        return lane_of(self._field, middle._replace(yaw_rad=yaw_rad))

    def standing_m(self, pose: Pose) -> float:
        """Returns the height of a robot's base_footprint at a place."""
        return standing_m(self._ground, pose)

    def draw_pose(self, keys: CameraKeys, seed: int) -> CameraPose:
        """Returns a pose in a lane, looking along it either way."""
        rng = stream(seed, "pose")

        def within(limits: Range) -> float:
            return float(rng.uniform(*limits))

        at = _between(self._lanes[rng.integers(len(self._lanes))], float(rng.uniform()))
        offset = within(keys.offset_m)
        yaw = at.yaw_rad + (math.pi if rng.integers(2) else 0.0)
        x = at.x_m - offset * math.sin(yaw)
        y = at.y_m + offset * math.cos(yaw)
        z = float(self._ground.height_at(np.array([x]), np.array([y]))[0]) + within(keys.height_m)
        turn = math.degrees(yaw) + within(keys.yaw_deg)
        turned = Rotation.from_euler("ZY", (turn, within(keys.pitch_deg)), degrees=True)
        v_m_s = within(keys.speed_m_s) * np.array([math.cos(yaw), math.sin(yaw), 0.0])
        return CameraPose(np.array([x, y, z]), turned, v_m_s)
