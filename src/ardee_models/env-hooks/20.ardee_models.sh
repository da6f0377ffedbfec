# SPDX-License-Identifier: MIT
# Crop and terrain models for model:// and file://, after the user's own; sourcing twice changes nothing.
_ardee_share="$CATKIN_ENV_HOOK_WORKSPACE/share/ardee_models"
case ":${GAZEBO_MODEL_PATH:-}:" in
  *":$_ardee_share/models:"*) ;;
  *) export GAZEBO_MODEL_PATH="${GAZEBO_MODEL_PATH:+$GAZEBO_MODEL_PATH:}$_ardee_share/models" ;;
esac
for _ardee_dir in "$_ardee_share" "$_ardee_share/models"; do
  case ":${GAZEBO_RESOURCE_PATH:-}:" in
    *":$_ardee_dir:"*) ;;
    *) export GAZEBO_RESOURCE_PATH="${GAZEBO_RESOURCE_PATH:+$GAZEBO_RESOURCE_PATH:}$_ardee_dir" ;;
  esac
done
unset _ardee_share _ardee_dir
