# SPDX-License-Identifier: MIT
"""Numbers of the three generations from the sources; config/ts*_config.urdf.xacro names the sources."""
from dataclasses import dataclass
from typing import Tuple


@dataclass(frozen=True)
class Generation:
    """Expected numbers of one robot: m, kg, kg m^2, N m/rad, N m, rad."""

    name: str
    mass: float
    chassis_box: Tuple[float, float, float]
    chassis_mesh: Tuple[float, float, float]
    chassis_z: float
    lid_box: Tuple[float, float, float]
    wheel_depth: float
    wheel_mass: float
    wheel_about_axle: float
    leg_mass: float
    leg_travel: float
    wheelbase: float  # legs extended
    stiffness: float
    appears_at_rest: bool  # true: joint angle 0 is at rest; false: fully extended
    torque: float
    sensors: frozenset  # names of links, without encoders
    heavy_end: int  # 1 front, -1 rear

    @property
    def file(self) -> str:
        """Returns the name of the assembly file."""
        return f"ts{self.name}_default.urdf.xacro"


V1 = Generation(
    name="v1",
    mass=6.6,
    chassis_box=(0.508, 0.35322, 0.13136),
    chassis_mesh=(0.508, 0.35322, 0.13136),
    chassis_z=0.04545,
    lid_box=(0.508, 0.35322, 0.015),
    wheel_depth=0.03838,
    wheel_mass=0.5,
    wheel_about_axle=0.5 * 0.5 * 0.097**2,
    leg_mass=0.18656,
    leg_travel=0.682,
    wheelbase=0.339,
    stiffness=100,
    appears_at_rest=False,
    torque=10,
    sensors=frozenset({"hokuyo", "camera", "camera_left", "imu", "gps", "battery"}),
    heavy_end=-1,
)
V2 = Generation(
    name="v2",
    # The masses are those of chassis, lid, legs, wheels and sensors.
    mass=7.227 + 0.3 + 4 * (0.735 + 0.5) + 1.42,
    chassis_box=(0.528, 0.32, 0.19),
    chassis_mesh=(0.528, 0.465, 0.19),
    chassis_z=0.02175,
    lid_box=(0.44, 0.28, 0.02),
    wheel_depth=0.03838,
    wheel_mass=0.5,
    wheel_about_axle=0.5 * 0.5 * 0.097**2,
    leg_mass=0.735,
    leg_travel=0.3,
    wheelbase=0.339,
    stiffness=100,
    appears_at_rest=False,
    torque=10,
    sensors=V1.sensors | {"camera_right"},
    heavy_end=-1,
)
V3 = Generation(
    name="v3",
    mass=10.615 + 0.3 + 4 * (0.18656 + 1.003) + 1.669,
    chassis_box=(0.44, 0.33, 0.14),
    chassis_mesh=(0.44, 0.33, 0.14),
    chassis_z=0.01,
    lid_box=(0.46, 0.35322, 0.03),
    wheel_depth=0.055,
    wheel_mass=1.003,
    wheel_about_axle=4.276e-3,
    leg_mass=0.18656,
    leg_travel=0.4363,
    wheelbase=2 * (0.0305 + 0.115 * 0.86602),
    stiffness=20,
    appears_at_rest=True,
    torque=6,
    sensors=frozenset({"hokuyo", "imu", "magnetometer", "gps", "battery"})
    | {
        f"camera_{side}{part}"
        for side in ("front", "left", "right")
        for part in ("", "_bracket", "_gimbal", "_imu")
    },
    heavy_end=-1,
)
GENERATIONS = (V1, V2, V3)
