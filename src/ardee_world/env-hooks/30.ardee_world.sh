# SPDX-License-Identifier: MIT
# Generated fields for model://, after the user's own models; sourcing twice changes nothing.
case ":${GAZEBO_MODEL_PATH:-}:" in
  *":$CATKIN_ENV_HOOK_WORKSPACE/share/ardee_world/models:"*) ;;
  *) export GAZEBO_MODEL_PATH="${GAZEBO_MODEL_PATH:+$GAZEBO_MODEL_PATH:}$CATKIN_ENV_HOOK_WORKSPACE/share/ardee_world/models" ;;
esac
