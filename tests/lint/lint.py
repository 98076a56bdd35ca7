#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
"""Checks of the source tree that no compiler makes."""

import argparse
import pathlib
import sys

import documents
import headers
import layers
import sources
from tree import Tree

CHECKS = {
    "layers": layers.check_layers,
    "notices": sources.check_notices,
    "headers": sources.check_headers,
    "lengths": sources.check_lengths,
    "unnamed_namespaces": sources.check_unnamed_namespaces,
    "paths": sources.check_paths,
    "scripts": sources.check_scripts,
    "build": sources.check_build,
    "links": documents.check_links,
    "figures": documents.check_figures,
    "layer_table": documents.check_layer_table,
    "citations": documents.check_citations,
    "standalone_headers": headers.check_standalone_headers,
}
NEEDS_BUILD = {"standalone_headers"}


def main():
    parser = argparse.ArgumentParser(
        description=__doc__,
        epilog="\n".join(f"  {name:20}{check.__doc__}" for name, check in CHECKS.items()),
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("checks", nargs="*", metavar="CHECK", help="names listed below; or all")
    parser.add_argument("--build", help="build folder with compile_commands.json")
    arguments = parser.parse_args()
    unknown = set(arguments.checks) - set(CHECKS)
    if unknown:
        parser.error(f"unknown check: {', '.join(sorted(unknown))}")
    if not arguments.build and not arguments.checks:
        arguments.checks = [name for name in CHECKS if name not in NEEDS_BUILD]

    tree = Tree(pathlib.Path(__file__).resolve().parents[2])
    findings = []
    for name in arguments.checks or CHECKS:
        findings += CHECKS[name](*([tree, arguments.build] if name in NEEDS_BUILD else [tree]))
    for finding in findings:
        print(finding)
    print(f"{len(findings)} findings in {len(tree.paths)} files")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
