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

# offers_files WORD...: for the last word, after the others, files are left to be offered.
offers_files() {
  COMP_WORDS=("$program" "$@")
  COMP_CWORD=$#
  COMPREPLY=()
  _qwsm
  if ((${#COMPREPLY[@]} > 0)); then
    printf "qwsm %s: expected files, not %s\n" "$*" "${COMPREPLY[*]}" >&2
    failures=$((failures + 1))
  fi
}

offers map m
offers map ''
offers --matcher map --ma
offers --output map robot.log --out
offers dump config ''
offers odometry convert robot.log --to ''
offers --quiet map --no-pictures ''
offers_files map --output ''
offers_files map -o ''
exit $((failures > 0))
