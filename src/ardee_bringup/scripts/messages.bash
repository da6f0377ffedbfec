# SPDX-License-Identifier: MIT
# Sourced by the scripts beside it: how they end with a message, and how they print their usage.
# shellcheck shell=bash

die() {
  printf '%s: %s\n' "$(basename "$0")" "$*" >&2
  exit 2
}

# Print the comment block below the first two lines of the calling script: its usage.
usage() { awk 'NR > 2 && /^#/ { sub(/^# ?/, ""); print; next } NR > 2 { exit }' "$0"; }
