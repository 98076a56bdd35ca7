# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
"""Checks of single files: notices, lengths, paths, shell syntax, and that the build knows them."""

import pathlib
import re
import shutil
import subprocess

from tree import Finding

LONGEST_FILE_LINES = 400
LONGEST_FUNCTION_LINES = 60

COPYRIGHT = "SPDX-FileCopyrightText: "
LICENSE = "SPDX-License-Identifier: BSD-3-Clause"
CARRIES_NOTICE = (
    ".hpp", ".cpp", ".h", ".py", ".sh", ".cmake", ".idl", ".yaml", ".hpp.in", ".cmake.in",
    "CMakeLists.txt",
)


def check_notices(tree):
    """Every source, script and configuration names its copyright and its license."""
    for path in sorted(set(tree.with_suffix(*CARRIES_NOTICE)) | set(tree.scripts())):
        start = "\n".join(tree.lines(path)[:4])
        if COPYRIGHT not in start or LICENSE not in start:
            yield Finding(path, 1, "the two SPDX lines are missing at the top")


def check_headers(tree):
    """Every header guards itself."""
    for path in tree.with_suffix(".hpp"):
        if "#pragma once" not in tree.lines(path):
            yield Finding(path, 1, "#pragma once is missing")


def check_lengths(tree):
    """No file above 400 lines, no function above 60."""
    for path in tree.with_suffix(".hpp", ".cpp", ".py"):
        lines = tree.lines(path)
        if len(lines) > LONGEST_FILE_LINES:
            yield Finding(path, len(lines), f"{len(lines)} lines: split it by what it is about")
    for path in tree.with_suffix(".hpp", ".cpp"):
        for first, last in functions("\n".join(tree.lines(path))):
            length = last - first + 1
            if length > LONGEST_FUNCTION_LINES:
                yield Finding(path, first, f"a function of {length} lines: name its steps")


LITERAL = re.compile(
    r"""//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])'""", re.DOTALL)
NO_FUNCTION = re.compile(r"\b(namespace|class|struct|union|enum|extern)\b[^()]*$|=\s*$")


def functions(source):
    """(first, last) line of every outermost function body, by matching braces."""
    code = LITERAL.sub(lambda match: "\n" * match[0].count("\n"), source)
    outside = []  # Whether each open brace encloses declarations (a namespace, a class).
    head = ""
    function_at = None  # (depth, line) of the function we are in.
    line = 1
    for character in code:
        if character == "\n":
            line += 1
        if character == "{":
            declares = "(" not in head or NO_FUNCTION.search(head.strip())
            is_function = function_at is None and not declares
            if is_function:
                function_at = (len(outside), line - head.lstrip().count("\n"))
            outside.append(not is_function)
        elif character == "}" and outside:
            outside.pop()
            if function_at and function_at[0] == len(outside):
                yield function_at[1], line
                function_at = None
        head = "" if character in "{};" else head + character


COMPILED_TOGETHER = re.compile(
    r"qwsm/src/|slam6d/src/|sim/src/|service/(?:.*/)?|tests/(?:unit|property|integration|regression)/")
NAMESPACE = re.compile(r"^namespace ([\w:]+) \{$", re.MULTILINE)
UNNAMED = re.compile(r"^namespace \{$(.*?)^\}  // namespace$", re.MULTILINE | re.DOTALL)
DEFINES = re.compile(r"^(?!using |namespace |class |struct )\w[\w:<>,&* .]*[ *&](\w+) ?(?:\(|=|\{|;|\[)", re.MULTILINE)


def check_unnamed_namespaces(tree):
    """Sources that are compiled together have no function or constant of the same name for themselves.

    Where their types differ no compiler complains, and one calls what is the other's.
    """
    seen = {}
    for path in tree.with_suffix(".cpp"):
        together = COMPILED_TOGETHER.match(path)
        source = (tree.root / path).read_text(encoding="utf-8") if together else ""
        around = NAMESPACE.search(source)
        names = {name[1] for part in UNNAMED.finditer(source) for name in DEFINES.finditer(part[1])}
        for name in sorted(names):
            other = seen.setdefault((together[0], around and around[1], name), path)
            if other != path:
                yield Finding(path, 1, f"{name} is a name of {other}, too: give one a better name")


def check_paths(tree):
    """No tracked file names a home folder or the place of this checkout."""
    here = re.escape(f"{tree.root}/")
    private = re.compile(rf"(?<![\w.}}$-])(?:/(?:home|Users)/\w+|/roo[t]/|{here})")
    for path in tree.paths:
        for number, line in enumerate(tree.lines(path), start=1):
            if private.search(line):
                yield Finding(path, number, "names a folder that other machines do not have")


def check_scripts(tree):
    """Shell scripts parse, and ShellCheck, where it is installed, agrees."""
    linter = shutil.which("shellcheck")
    for path in tree.scripts():
        shell = "bash" if "bash" in tree.lines(path)[0] else "sh"
        commands = [[shell, "-n", path]] + ([[linter, "--external-sources", "--format=gcc", path]] if linter else [])
        for command in commands:
            run = subprocess.run(command, cwd=tree.root, capture_output=True, text=True)
            if run.returncode != 0:
                yield Finding(path, 1, (run.stderr + run.stdout).strip())


def check_build(tree):
    """The build knows every source and every public header: a forgotten test would never fail."""
    public_headers = [path for path in tree.with_suffix(".hpp") if "/include/" in path]
    for path in tree.with_suffix(".cpp") + public_headers:
        name = re.compile(rf"\b{re.escape(pathlib.PurePath(path).stem)}\b")
        if not any(name.search(text) for text in lists_above(tree, path)):
            yield Finding(path, 1, "stands in no CMakeLists.txt above it")


def lists_above(tree, path):
    for folder in pathlib.PurePath(path).parents:
        lists = (folder / "CMakeLists.txt").as_posix()
        if lists in tree.paths:
            yield "\n".join(tree.lines(lists))
