# SPDX-License-Identifier: MIT
"""Task: follow a lane between two crop rows from before its first stalks to its end."""

from typing import Any, Dict, Tuple

import numpy as np
from ardee_sim.envs.arguments import names
from ardee_sim.envs.fields import SownField
from ardee_sim.envs.observations import observation, observation_space, scaled_depths, space_of
from ardee_sim.envs.task import Scene, has_left
from ardee_sim.errors import ArdeeError
from gymnasium import spaces

from ardee_world.row_truth import Pose, lane_of
from ardee_world.start import Start
from ardee_world.trial import start_near

NEAR_M = 0.05  # the camera's own housing is nearer
OFFSET_WEIGHT = 0.05  # of a control period at half the lane's width from its middle


class RowFollowTask:
    """Follows the lane before which the robot starts."""

    def __init__(self, topics: Tuple[str, ...] = ("ardee/hokuyo",)) -> None:
        self.topics = names(topics, "topics")

    def start(self, sown: SownField, rng: np.random.Generator) -> Pose:
        """Returns the world's start pose with a person's inaccuracy."""
        x, y, z = sown.world.start["xyz_m"]
        planned = Start(x, y, z, sown.world.start["rpy_rad"][2])
        return start_near(planned, int(rng.integers(2**31)))

    def begin(self, scene: Scene) -> None:
        """Finds the lane."""
        self._lane = lane_of(scene.sown.trial.field, scene.pose())
        self._here = self._lane.deviation(scene.pose())

    def space(self, scene: Scene) -> spaces.Space:
        """Returns the space of the topics' readings."""
        return observation_space({topic: scene.reading(topic) for topic in self.topics})

    def observe(self, scene: Scene) -> Any:
        """Returns the topics' readings."""
        return observation({topic: scene.reading(topic) for topic in self.topics})

    def reward(self, scene: Scene) -> Dict[str, float]:
        """Returns the way along the lane [m], and a penalty for the distance from its middle."""
        before_m = self._here.along_m
        self._here = self._lane.deviation(scene.pose())
        half_m = max((self._here.left_m + self._here.right_m) / 2, 1e-3)
        offset = min(abs(self._here.lateral_m) / half_m, 1.0)
        return {"progress": self._here.along_m - before_m, "offset": -OFFSET_WEIGHT * offset}

    def end(self, scene: Scene) -> Tuple[str, float]:
        """Ends at the row's end, at a touched plant, and outside the lane."""
        if self._here.along_m > self._lane.centre.length_m:
            return "row_end", 1.0
        if scene.touches_plant():
            return "collision", -1.0
        return ("row_lost", -1.0) if has_left(self._here) else ("", 0.0)


class RowFollowCameraTask(RowFollowTask):
    """Follows a lane by pictures from the robot's front camera's place."""

    PICTURES = ("rgb", "depth", "labels")

    def __init__(
        self,
        picture: str = "rgb",
        width_px: int = 320,
        height_px: int = 224,
        horizontal_fov_rad: float = 1.2,
        camera_link: str = "camera_link",
    ) -> None:
        super().__init__(topics=())
        if picture not in self.PICTURES:
            raise ArdeeError(f"picture: found '{picture}', expected {', '.join(self.PICTURES)}")
        self._picture, self._link = picture, camera_link
        self._lens: Dict[str, Any] = dict(
            width_px=width_px,
            height_px=height_px,
            horizontal_fov_rad=horizontal_fov_rad,
            near_m=NEAR_M,
        )

    def space(self, scene: Scene) -> spaces.Space:
        """Returns the space of the picture."""
        return space_of(self.observe(scene))

    def observe(self, scene: Scene) -> Any:
        """Returns the picture of a pinhole camera without noise."""
        camera = scene.sim.state(f"{scene.robot}::{self._link}")
        xyz_m, quat_xyzw = camera.xyz_m, camera.quat_xyzw
        if self._picture == "rgb":
            return scene.sim.render(xyz_m, quat_xyzw, **self._lens)
        if self._picture == "labels":
            return scene.sim.label_image(xyz_m, quat_xyzw, **self._lens)
        return scaled_depths(scene.sim.depth_image(xyz_m, quat_xyzw, **self._lens))
