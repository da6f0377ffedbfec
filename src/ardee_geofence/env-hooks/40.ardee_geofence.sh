# SPDX-License-Identifier: MIT
# Geofence files for file://, after the user's own; sourcing twice changes nothing.
case ":${GAZEBO_RESOURCE_PATH:-}:" in
  *":$CATKIN_ENV_HOOK_WORKSPACE/share/ardee_geofence:"*) ;;
  *) export GAZEBO_RESOURCE_PATH="${GAZEBO_RESOURCE_PATH:+$GAZEBO_RESOURCE_PATH:}$CATKIN_ENV_HOOK_WORKSPACE/share/ardee_geofence" ;;
esac
