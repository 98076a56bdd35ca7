#!/bin/sh
# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
#
# consume_with_pkg_config.sh COMPILER PC_FOLDER PROGRAM: builds the consumer with nothing but what
# qwsm.pc says, and runs it.
set -eu
compiler=$1
PKG_CONFIG_PATH=$2
program=$3
export PKG_CONFIG_PATH

flags=$("$PKG_CONFIG" --cflags --libs qwsm)
echo "qwsm $("$PKG_CONFIG" --modversion qwsm): $flags"
# The flags are many words; a path with a blank arrives escaped, so the shell has to read it again.
eval "\"$compiler\" -std=c++20 \"$(dirname "$0")/consumer/main.cpp\" -o \"$program\" $flags"
"$program"
