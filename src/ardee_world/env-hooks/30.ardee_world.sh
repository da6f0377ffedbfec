# SPDX-License-Identifier: MIT
# Generated fields and terrains for model:// and file://, after the user's own models; sourcing twice changes nothing.
_ardee_models="$CATKIN_ENV_HOOK_WORKSPACE/share/ardee_world/models"
case ":${GAZEBO_MODEL_PATH:-}:" in
  *":$_ardee_models:"*) ;;
  *) export GAZEBO_MODEL_PATH="${GAZEBO_MODEL_PATH:+$GAZEBO_MODEL_PATH:}$_ardee_models" ;;
esac
case ":${GAZEBO_RESOURCE_PATH:-}:" in
  *":$_ardee_models:"*) ;;
  *) export GAZEBO_RESOURCE_PATH="${GAZEBO_RESOURCE_PATH:+$GAZEBO_RESOURCE_PATH:}$_ardee_models" ;;
esac
unset _ardee_models
