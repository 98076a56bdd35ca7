# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
"""Every header compiles alone.

The build proves that of the public headers (CMAKE_VERIFY_INTERFACE_HEADER_SETS), and a build with
QWSM_SEPARATE_SOURCES, as preset `tidy` makes it, of those that some source includes first. The
others are compiled here. Only Eigen is precompiled, for the headers that include it, because it
would be most of what is parsed.
"""

import concurrent.futures
import json
import os
import pathlib
import shlex
import subprocess
import tempfile

from layers import INCLUDE
from tree import Finding


def check_standalone_headers(tree, build):
    """Every header that no other build proves compiles without anything included before it."""
    commands = json.loads((pathlib.Path(build) / "compile_commands.json").read_text())
    takes_eigen = users_of_eigen(tree, tree.with_suffix(".hpp"))
    proven = {first_include(tree, path) for path in tree.with_suffix(".cpp")}
    headers = [path for path in tree.with_suffix(".hpp")
               if "/include/" not in path and included_as(path) not in proven]
    with tempfile.TemporaryDirectory() as folder:
        parse = syntax_check(commands)
        eigen = pathlib.Path(folder) / "eigen.hpp"
        eigen.write_text("#include <Eigen/Core>\n")
        subprocess.run([*parse, "-x", "c++-header", "-o", f"{eigen}.gch", eigen], check=True)

        def compile_alone(path):
            before = ["-include", eigen] if path in takes_eigen else []
            alone = ["-fsyntax-only", "-include", tree.root / path, "-x", "c++", "/dev/null"]
            return subprocess.run([*parse, *before, *alone], capture_output=True, text=True)

        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            for path, run in zip(headers, pool.map(compile_alone, headers)):
                if run.returncode != 0:
                    yield Finding(path, 1, "does not compile alone:\n" + run.stderr.strip())


def users_of_eigen(tree, headers):
    """The headers that include Eigen, directly or through others."""
    by_name = {included_as(path): path for path in headers}
    includes = {path: [match[1] for match in map(INCLUDE.match, tree.lines(path)) if match]
                for path in headers}
    users = {path for path in headers if any(name.startswith("Eigen/") for name in includes[path])}
    while True:
        more = {path for path in headers
                if any(by_name.get(name) in users for name in includes[path])} - users
        if not more:
            return users
        users |= more


def first_include(tree, path):
    includes = (INCLUDE.match(line) for line in tree.lines(path))
    return next((include[1] for include in includes if include), None)


def included_as(path):
    """How sources name a header: a public one from its include folder, others from the root."""
    return path.split("/include/")[-1]


def syntax_check(commands):
    """A compiler with the language, the warnings and all folders and definitions of a build."""
    lines = [shlex.split(entry["command"]) for entry in commands if is_cpp(entry["file"])]
    flags = [word for words in lines for word in words if word.startswith(("-I", "-D", "-std", "-W"))]
    systems = [pair for words in lines for pair in zip(words, words[1:]) if pair[0] == "-isystem"]
    kept = list(dict.fromkeys(flags)) + [word for pair in dict.fromkeys(systems) for word in pair]
    return [compiler(lines[0]), *kept]


def is_cpp(path):
    return path.endswith((".cpp", ".cxx"))


def compiler(words):
    """The compiler of a command line, which may begin with a launcher such as ccache."""
    return next(word for word in words[:2] if not word.endswith("ccache"))
