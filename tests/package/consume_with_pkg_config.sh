#!/bin/sh
# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
#
# consume_with_pkg_config.sh COMPILER PC_FOLDER EXAMPLES OUTPUT COMPONENT...: builds a program for each
# component with nothing but what its .pc file says, and runs it.
set -eu
compiler=$1
PKG_CONFIG_PATH=$2
examples=$3
output=$4
shift 4
export PKG_CONFIG_PATH
consumer=$(dirname "$0")/consumer

# consume PACKAGE SOURCE [ARGUMENT...]
consume() {
  package=$1
  source=$2
  shift 2
  flags=$("$PKG_CONFIG" --cflags --libs "$package")
  echo "$package $("$PKG_CONFIG" --modversion "$package"): $flags"
  # The flags are many words; a path with a blank arrives escaped, so the shell has to read it again.
  eval "\"$compiler\" -std=c++20 \"$source\" -o \"$output/$package\" $flags"
  "$output/$package" "$@"
}

for component in "$@"; do
  case $component in
    qwsm) consume qwsm "$consumer/main.cpp" ;;
    slam6d) consume slam6d "$examples/04_register_clouds.cpp" ;;
    logs) consume qwsm_logs "$examples/02_map_a_log.cpp" "$consumer/robot.log" ;;
    ceres) consume qwsm_ceres "$consumer/close_a_loop.cpp" ;;
  esac
done
