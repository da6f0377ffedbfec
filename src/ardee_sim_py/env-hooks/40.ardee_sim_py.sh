# SPDX-License-Identifier: MIT
# gymnasium and viser where scripts/setup puts them, or in an install space, unless there are others; after all other
# folders.
for _ardee_pair in gymnasium:pydeps_gym viser:pydeps_view; do
  for _ardee_folder in "$CATKIN_ENV_HOOK_WORKSPACE/.." "$CATKIN_ENV_HOOK_WORKSPACE/share/ardee_sim_py"; do
    _ardee_folder="$_ardee_folder/${_ardee_pair#*:}"
    if [ -d "$_ardee_folder" ] && ! python3 -c 'import importlib.util, sys; sys.exit(not importlib.util.find_spec(sys.argv[1]))' "${_ardee_pair%:*}" 2>/dev/null; then
      export PYTHONPATH="${PYTHONPATH:+$PYTHONPATH:}$(cd "$_ardee_folder" && pwd)"
    fi
  done
done
unset _ardee_pair _ardee_folder
