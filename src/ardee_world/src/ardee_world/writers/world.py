# SPDX-License-Identifier: MIT
"""A world file that includes a terrain at its origin and a field, with the light and physics of thesis Listing A.22."""

from typing import Optional, Tuple

_HEAD = """<?xml version="1.0" ?>
<sdf version='1.5'>
  <world name='default'>

    <!-- When Gazebo is loaded zoom into where the robot spawns -->
    <gui>
      <camera name="user_camera">
        <pose>2.20 1.60 2.20 0 0.323 -2.834</pose>
      </camera>
    </gui>

    <!-- Initialize some lighting conditions -->
    <light name='sundir' type='directional'>
      <cast_shadows>1</cast_shadows>
      <pose>0 0 10 0 -0 0</pose>
      <diffuse>1.0 0.95 0.8 1</diffuse>
      <attenuation>
        <range>1000</range>
        <constant>0.9</constant>
        <linear>0.01</linear>
        <quadratic>0.001</quadratic>
      </attenuation>
      <direction>-0.3 0.4 -1.0</direction>
    </light>

    <!-- Configure ODE Physics engine parameters -->
    <physics type="ode">
      <max_step_size>0.005</max_step_size>
      <real_time_factor>1.0</real_time_factor>
      <real_time_update_rate>0.0</real_time_update_rate>
      <gravity>0 0 -9.8</gravity>
    </physics>

    <!-- Configure all of the scene parameters -->
    <scene>
      <!-- Use a blue sky -->
      <sky/>
      <!-- Show the grid on the floor -->
      <grid>true</grid>
    </scene>

"""
_ORIGIN = """    <!-- The world's origin on the Earth; x points east -->
    <spherical_coordinates>
      <surface_model>EARTH_WGS84</surface_model>
      <latitude_deg>{}</latitude_deg>
      <longitude_deg>{}</longitude_deg>
      <elevation>0</elevation>
      <heading_deg>0</heading_deg>
    </spherical_coordinates>

"""
_INCLUDES = """    <include>
      <uri>model://{terrain}</uri>
      <pose>0 0 0 0 0 0</pose>
    </include>

    <!-- Without a pose here, it stands where its own says -->
    <include>
      <uri>model://{field}</uri>
    </include>
"""
_TAIL = """  </world>
</sdf>
"""


def world_text(terrain: str, field: str, origin_deg: Optional[Tuple[float, float]] = None) -> str:
    """Text of a world, whose origin has this latitude and longitude."""
    origin = _ORIGIN.format(*origin_deg) if origin_deg else ""
    return _HEAD + origin + _INCLUDES.format(terrain=terrain, field=field) + _TAIL
