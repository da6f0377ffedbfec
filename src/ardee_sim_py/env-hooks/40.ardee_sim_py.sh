# SPDX-License-Identifier: MIT
# gymnasium where scripts/setup puts it, unless there is another one; after all other folders.
_ardee_gym="$CATKIN_ENV_HOOK_WORKSPACE/../pydeps_gym"
if [ -d "$_ardee_gym" ] && ! python3 -c 'import importlib.util, sys; sys.exit(not importlib.util.find_spec("gymnasium"))' 2>/dev/null; then
  export PYTHONPATH="${PYTHONPATH:+$PYTHONPATH:}$(cd "$_ardee_gym" && pwd)"
fi
unset _ardee_gym
