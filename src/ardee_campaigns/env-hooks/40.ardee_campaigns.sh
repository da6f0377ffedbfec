# SPDX-License-Identifier: MIT
# pyarrow where scripts/setup puts it, or in an install space, unless there is another one; after all other folders.
for _ardee_arrow in "$CATKIN_ENV_HOOK_WORKSPACE/../pydeps_campaigns" "$CATKIN_ENV_HOOK_WORKSPACE/share/ardee_campaigns/pydeps_campaigns"; do
  if [ -d "$_ardee_arrow" ] && ! python3 -c 'import importlib.util, sys; sys.exit(not importlib.util.find_spec("pyarrow"))' 2>/dev/null; then
    export PYTHONPATH="${PYTHONPATH:+$PYTHONPATH:}$(cd "$_ardee_arrow" && pwd)"
  fi
done
unset _ardee_arrow
