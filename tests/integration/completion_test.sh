#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
#
# completion_test.sh COMPLETION PROGRAM: what the shell offers for command lines of the program.
set -euo pipefail
# shellcheck source=scripts/completion/qwsm
source "$1"
program=$2
failures=0

# offers EXPECTED WORD...: the last word, after the others, must complete to EXPECTED among others.
offers() {
  local expected=$1
  shift
  COMP_WORDS=("$program" "$@")
  COMP_CWORD=$#
  COMPREPLY=()
  _qwsm
  if [[ " ${COMPREPLY[*]} " != *" $expected "* ]]; then
    printf "qwsm %s: expected %s among: %s\n" "$*" "$expected" "${COMPREPLY[*]}" >&2
    failures=$((failures + 1))
  fi
}

offers map m
offers map ''
offers --matcher map --ma
offers --output map robot.log --out
offers dump config ''
exit $((failures > 0))
