# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
"""Every header compiles alone.

A header that some source includes first is proven by the build. The others are compiled here.
"""

import concurrent.futures
import json
import os
import pathlib
import shlex
import subprocess

from layers import INCLUDE
from tree import Finding


def check_standalone_headers(tree, build):
    """Every header compiles without anything included before it."""
    commands = json.loads((pathlib.Path(build) / "compile_commands.json").read_text())
    proven = {first_include(tree, path) for path in tree.with_suffix(".cpp")}
    headers = [path for path in tree.with_suffix(".hpp") if included_as(path) not in proven]

    def compile_alone(path):
        command = syntax_check(commands, tree.root / path)
        return subprocess.run(command, cwd=build, capture_output=True, text=True)

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for path, run in zip(headers, pool.map(compile_alone, headers)):
            if run.returncode != 0:
                yield Finding(path, 1, "does not compile alone:\n" + run.stderr.strip())


def included_as(path):
    """How sources name a header: a public one from its include folder, others from the root."""
    return path.split("/include/")[-1]


def first_include(tree, path):
    includes = (INCLUDE.match(line) for line in tree.lines(path))
    return next((include[1] for include in includes if include), None)


def syntax_check(commands, header):
    """The commands of the sources nearest to `header`, together, changed to parse the header only.

    A folder may hold sources of several libraries, each with includes of its own.
    """
    closeness = [len(common(pathlib.Path(entry["file"]), header)) for entry in commands]
    nearest = [entry for entry, close in zip(commands, closeness) if close == max(closeness)]
    lines = [shlex.split(entry["command"]) for entry in nearest]
    flags = [word for words in lines for word in words if word.startswith(("-I", "-D", "-std", "-W"))]
    systems = [pair for words in lines for pair in zip(words, words[1:]) if pair[0] == "-isystem"]
    kept = list(dict.fromkeys(flags)) + [word for pair in dict.fromkeys(systems) for word in pair]
    includer = ["-include", str(header), "-x", "c++", "/dev/null"]
    return [compiler(lines[0]), *kept, "-fsyntax-only", *includer]


def compiler(words):
    """The compiler of a command line, which may begin with a launcher such as ccache."""
    return next(word for word in words[:2] if not word.endswith("ccache"))


def common(a, b):
    parts = zip(a.parts, b.parts)
    return [left for left, right in parts if left == right]
