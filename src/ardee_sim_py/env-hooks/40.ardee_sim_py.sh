# SPDX-License-Identifier: MIT
# gymnasium where scripts/setup puts it, or in an install space, unless there is another one; after all other folders.
for _ardee_gym in "$CATKIN_ENV_HOOK_WORKSPACE/../pydeps_gym" "$CATKIN_ENV_HOOK_WORKSPACE/share/ardee_sim_py/pydeps_gym"; do
  if [ -d "$_ardee_gym" ] && ! python3 -c 'import importlib.util, sys; sys.exit(not importlib.util.find_spec("gymnasium"))' 2>/dev/null; then
    export PYTHONPATH="${PYTHONPATH:+$PYTHONPATH:}$(cd "$_ardee_gym" && pwd)"
  fi
done
unset _ardee_gym
