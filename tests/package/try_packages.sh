#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
#
# try_packages.sh SOURCE BUILD WORK: makes the Debian packages of a build, which lintian looks at, unpacks
# them, and uses what is in them from there.
set -euo pipefail
source=$(realpath "$1")
build=$(realpath "$2")
mkdir -p "$3"
work=$(realpath "$3")

die() {
  printf 'try_packages.sh: %s\n' "$*" >&2
  exit 1
}

"$source/scripts/package" --build "$build" --output "$work/packages" --quick >"$work/package.log" 2>&1 ||
  { cat "$work/package.log" && die 'the packages could not be made'; }
version=$(sed -n 's/^project(qwsm VERSION \([0-9.]*\).*/\1/p' "$source/CMakeLists.txt")
rm -rf "$work/root"
for package in qwsm libqwsm-dev python3-qwsm qwsm-doc; do
  deb=$(echo "$work/packages/${package}_${version}_"*.deb)
  [[ -f $deb ]] || die "there is no $package of version $version"
  dpkg-deb --extract "$deb" "$work/root"
done

cd "$work/root"
[[ $(usr/bin/qwsm --version) == "qwsm $version"* ]] || die "qwsm is not of version $version"
usr/bin/qwsm sim office --duration 5 --output "$work/office" --force --quiet
usr/bin/slam6d config --describe >/dev/null
python=$(sed -n "s/^QWSM_PYTHON:[A-Z]*=//p" "$build/CMakeCache.txt")
PYTHONPATH=usr/lib/python3/dist-packages "$python" -B -c 'import qwsm, slam6d'
for page in usr/share/man/man1/{qwsm,slam6d,qwsm-map,slam6d-register}.1.gz; do
  gzip --test "$page" || die "there is no $page"
done
for file in lib/systemd/system/qwsm.service usr/share/qwsm/configs/default.yaml \
  usr/share/bash-completion/completions/slam6d usr/share/doc/qwsm/html/index.html; do
  [[ -s $file ]] || die "there is no $file"
done
