# SPDX-License-Identifier: MIT
# Sourced by every script here: the workspace's root, a sane environment, and how to print.
# shellcheck shell=bash

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

# Debian's own ROS nodes start with `env python3`, and catkin looks python3 up on PATH: it must be the system's.
export PATH="/usr/bin:$PATH"
# The machine's own name need not resolve, as in a container.
export ROS_IP="${ROS_IP:-127.0.0.1}"
unset ROS_HOSTNAME
# roslaunch's `import distutils` then loads Python's own instead of all of setuptools: half a second less at each start.
export SETUPTOOLS_USE_DISTUTILS="${SETUPTOOLS_USE_DISTUTILS:-stdlib}"

# Leave out what the calling shell has sourced of another checkout or of an install space: its stand-ins are no packages
# of the system, and it is not to lie below this workspace. Other workspaces of the user's and /opt/ros stay.
drop_other_checkouts() {
  local name entry folder kept
  for name in {CMAKE_PREFIX,GAZEBO_MODEL,GAZEBO_RESOURCE,LD_LIBRARY,PKG_CONFIG,ROS_PACKAGE}_PATH PATH PYTHONPATH; do
    kept=""
    while IFS= read -rd : entry; do
      folder=$entry
      until [[ -e $folder/src/ardee_sim_cpp || -e $folder/share/ardee_sim_cpp || $folder != */* ]]; do
        folder=${folder%/*}
      done
      [[ $folder == */* && ! $folder -ef $root && ! $folder -ef $root/devel ]] || kept+=:$entry
    done <<<"${!name:+${!name}:}"
    if [[ $kept ]]; then export "$name=${kept#:}"; else unset "$name"; fi
  done
}
drop_other_checkouts

heading() { printf '\n== %s\n' "$*"; }
note() { printf '   %s\n' "$*"; }
die() {
  printf '%s: %s\n' "$(basename "$0")" "$*" >&2
  exit 2
}

# Print the comment block below the first two lines of the calling script: its usage.
usage() { awk 'NR > 2 && /^#/ { sub(/^# ?/, ""); print; next } NR > 2 { exit }' "$0"; }

# Source a set-up file of ROS; they read variables that need not be set.
source_ros() {
  set +u
  # shellcheck disable=SC1090
  source "$1"
  set -u
}

# ROS below this workspace: /opt/ros/noetic where there is one, else Debian's packages, which need no set-up file.
source_underlay() {
  if [[ -f /opt/ros/noetic/setup.bash ]]; then
    source_ros /opt/ros/noetic/setup.bash
    export PATH="/usr/bin:$PATH"
  fi
}

# Have the compiler's cache, where there is one, serve each build of this tree and of its copies in other folders.
use_ccache() {
  command -v ccache >/dev/null || return 0
  export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache
  export CCACHE_BASEDIR=$root CCACHE_ABSSTDERR=1   # paths in messages stay absolute, those of __FILE__ do not
  export CCACHE_SLOPPINESS=pch_defines,time_macros # what it needs to know of precompiled headers
}

# This workspace as built.
source_workspace() {
  [[ -f $root/devel/setup.bash ]] || die "not built yet: run scripts/build"
  source_ros "$root/devel/setup.bash"
  export PATH="/usr/bin:$PATH"
}
