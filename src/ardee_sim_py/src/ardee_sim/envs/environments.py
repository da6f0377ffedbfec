# SPDX-License-Identifier: MIT
"""The registered environments."""

from typing import Any, Dict, Optional, Tuple

from ardee_sim.envs.field_env import FieldEnv
from ardee_sim.envs.go_to import GoToTask
from ardee_sim.envs.headland_turn import HeadlandTurnTask
from ardee_sim.envs.row_follow import RowFollowCameraTask, RowFollowTask


class RowFollowEnv(FieldEnv):
    """ardee/RowFollow-v0: follow a lane between crop rows by lidar.

    Description
    -----------
    A robot stands before a lane of a field, near its middle, and has to drive to the lane's end without touching a
    plant.

    Action Space
    ------------
    `Box(-1, 1, (2,), float32)`

    | Num | Action | Min | Max | Name | Unit |
    |---|---|---|---|---|---|
    | 0 | speed / `v_max_m_s` | -1 | 1 | `linear_x` | m/s |
    | 1 | turn rate / `w_max_rad_s`, positive to the left | -1 | 1 | `angular_z` | rad/s |

    Observation Space
    -----------------
    `Box(0, 1, (1081,), float32)`: the last scan, ranges / greatest range, from right to left; 1 where nothing was met.
    With more than one of `topics` a Dict of scans, images and IMU readings by the topics' last parts.

    Rewards
    -------
    | term in `info` | value |
    |---|---|
    | `reward_progress` | way along the lane in the control period [m] |
    | `reward_offset` | -0.05 x distance from the lane's middle / half its width |
    | `reward_end` | 1 at the row's end, -1 at a collision or outside the lane, else 0 |

    Starting State
    --------------
    The world's start pose, displaced to the side (0.03 m) and turned (0.05 rad) by normal deviates, at rest. The field
    is sown anew with `seed_field`. `info["replay"]` has all that was drawn; `reset(options=...)` with it repeats the
    episode.

    Episode End
    -----------
    `info["end_reason"]`: `row_end`, `collision` (a plant was touched in the control period), `row_lost` (the
    robot's middle is beyond a row, or the robot turned round). Truncated after 600 control periods.

    Arguments
    ---------
    topics : sensors of the observation
    scenario="corn", and all others of FieldEnv

    Version History
    ---------------
    v0 : first version
    """

    def __init__(self, *, topics: Tuple[str, ...] = ("ardee/hokuyo",), **arguments: Any) -> None:
        super().__init__(RowFollowTask(topics), **_in_corn(arguments))


class RowFollowCameraEnv(FieldEnv):
    """ardee/RowFollowCamera-v0: follow a lane between crop rows by a camera's picture.

    Description
    -----------
    As ardee/RowFollow-v0, with a pinhole camera without noise at the place of the robot's front camera.

    Action Space
    ------------
    As ardee/RowFollow-v0.

    Observation Space
    -----------------
    `picture="rgb"`: `Box(0, 255, (224, 320, 3), uint8)`. `"depth"`: `Box(0, 1, (224, 320), float32)`, depth along the
    camera's axis / 10 m, 1 where nothing is nearer. `"labels"`: `Box(0, 65535, (224, 320), uint16)`, classes: 0 none,
    1 corn, 2 sorghum, 3 tobacco, 10 weed, 11 stone, 12 litter.

    Rewards
    -------
    As ardee/RowFollow-v0.

    Starting State
    --------------
    As ardee/RowFollow-v0.

    Episode End
    -----------
    As ardee/RowFollow-v0.

    Arguments
    ---------
    picture : rgb, depth or labels
    width_px=320, height_px=224, horizontal_fov_rad=1.2 : of the camera
    camera_link="camera_link" : link that holds it, x forward, z up
    scenario="corn", and all others of FieldEnv

    Version History
    ---------------
    v0 : first version
    """

    def __init__(
        self,
        *,
        picture: str = "rgb",
        width_px: int = 320,
        height_px: int = 224,
        horizontal_fov_rad: float = 1.2,
        camera_link: str = "camera_link",
        **arguments: Any,
    ) -> None:
        task = RowFollowCameraTask(picture, width_px, height_px, horizontal_fov_rad, camera_link)
        super().__init__(task, **_in_corn(arguments))


class HeadlandTurnEnv(FieldEnv):
    """ardee/HeadlandTurn-v0: turn at the end of a lane into the lane beside it.

    Description
    -----------
    A robot stands 0.3 m before the end of its lane and has to come into the next lane on the left or on the right.

    Action Space
    ------------
    As ardee/RowFollow-v0.

    Observation Space
    -----------------
    A Dict: `hokuyo`, `Box(0, 1, (1081,), float32)`, the last scan as in ardee/RowFollow-v0; `odom`,
    `Box(-1, 1, (4,), float32)`, way ahead and to the left since the start / 5 m by wheel odometry, sine and cosine of
    the turn; `side`, `Box(-1, 1, (1,), float32)`, 1: the lane on the left, -1: on the right.

    Rewards
    -------
    | term in `info` | value |
    |---|---|
    | `reward_progress` | by how much the straight line to a point 0.5 m inside the lane became shorter [m] |
    | `reward_end` | 1 in the lane, -1 at a collision or when lost, else 0 |

    Starting State
    --------------
    In the middle of the lane before which the world's start pose is, displaced to the side (0.03 m) and turned
    (0.05 rad) by normal deviates, at rest; the side is drawn.

    Episode End
    -----------
    `info["end_reason"]`: `in_lane`, `collision`, `lost` (5 m from the goal). Truncated after 300 control periods.

    Arguments
    ---------
    scan_topic, odometry_topic : of the robot's lidar and wheel odometry
    scenario="corn", and all others of FieldEnv

    Version History
    ---------------
    v0 : first version
    """

    def __init__(
        self,
        *,
        scan_topic: str = "ardee/hokuyo",
        odometry_topic: str = "odom",
        **arguments: Any,
    ) -> None:
        super().__init__(HeadlandTurnTask(scan_topic, odometry_topic), **_in_corn(arguments))


class GoToEnv(FieldEnv):
    """ardee/GoTo-v0: go to a place under the canopy by satellite position and IMU.

    Description
    -----------
    A robot stands before a lane and has to go to a place in it, which it knows by its coordinates.

    Action Space
    ------------
    As ardee/RowFollow-v0.

    Observation Space
    -----------------
    `Box(-1, 1, (7,), float32)`: the goal's distance ahead and to the left / 20 m, from the last fix (10 a second) and
    the IMU's yaw; sine and cosine of that yaw; angular velocities about x, y, z / 10 rad/s.

    Rewards
    -------
    | term in `info` | value |
    |---|---|
    | `reward_progress` | by how much the robot came nearer to the goal [m] |
    | `reward_end` | 1 at the goal, -1 at a collision or when lost, else 0 |

    Starting State
    --------------
    0.5 m before the lane, displaced and turned as in ardee/HeadlandTurn-v0; the goal is drawn at 30 to 90 % of the
    lane.

    Episode End
    -----------
    `info["end_reason"]`: `arrived` (within 0.3 m), `collision`, `lost` (2 m farther away than at the start).
    Truncated after 600 control periods.

    Arguments
    ---------
    fix_topic, imu_topic : of the robot's receiver, whose world has x east and y north, and IMU
    error_topic : of the receiver's true error, by which the first fix is corrected; None: that fix counts as exact
    scenario="corn", and all others of FieldEnv

    Version History
    ---------------
    v0 : first version
    """

    def __init__(
        self,
        *,
        fix_topic: str = "ardee/gps",
        error_topic: Optional[str] = "ardee/gps/data",
        imu_topic: str = "ardee/imu/custom",
        **arguments: Any,
    ) -> None:
        super().__init__(GoToTask(fix_topic, error_topic, imu_topic), **_in_corn(arguments))


def _in_corn(arguments: Dict[str, Any]) -> Dict[str, Any]:
    return arguments if arguments.get("world") is not None else {"scenario": "corn", **arguments}
