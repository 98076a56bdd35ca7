#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
#
# try_scripts.sh SOURCE WORK: asks every script for help, and gives it what it must refuse, from a folder
# that is not the project's.
set -euo pipefail
scripts=$(realpath "$1")/scripts
rm -rf "$2"
mkdir -p "$2"
cd "$2"

die() {
  printf 'try_scripts.sh: %s\n' "$*" >&2
  exit 1
}

for script in "$scripts"/*; do
  [[ -f $script && -x $script ]] || continue
  name=$(basename "$script")
  "$script" --help >help 2>errors || die "$name --help fails: $(<errors)"
  [[ ! -s errors ]] || die "$name --help writes an error: $(<errors)"
  grep -qi "^usage: scripts/$name" help || die "$name --help does not say how it is called"
  if "$script" --no-such-option >output 2>errors; then die "$name takes any option"; fi
  tail -n 1 errors | grep -q "^scripts/$name: " || die "$name does not say what is wrong: $(<errors)"
done

# Who builds the packages where nothing is installed yet has what scripts/setup installs.
sed -n '/^# Libraries/,/^# Tests/s/^\([a-z0-9.+-]*-dev\) .*/\1/p' "$scripts/packages.txt" >libraries
while read -r library; do
  sed -n '/^Build-Depends/,/^Standards-Version/p' "$scripts/../packaging/debian/control" |
    grep -q " $library,\?\$" || die "packaging/debian/control does not build-depend on $library"
done <libraries
(($(wc -l <libraries) > 10)) || die 'scripts/packages.txt has no section of libraries'

# What is in a folder is somebody's, whatever it is called.
mkdir -p mine/source
touch mine/source/notes
for output in mine ''; do
  if "$scripts/package" --build . --output "$output" >told 2>errors; then
    die "package writes into '$output'"
  fi
done
[[ -e mine/source/notes ]] || die 'package has deleted what is not its own'
