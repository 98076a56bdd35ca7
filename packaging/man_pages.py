# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
"""Manual pages of a program from what its --help says, one of the program and one for each command.

    man_pages.py PROGRAM VERSION FOLDER   writes FOLDER/program.1, program-command.1, ...
"""

import pathlib
import re
import subprocess
import sys

HEADING = re.compile(r"(\w[\w ]*):$")
USAGE = re.compile(r"Usage: (.*)")
ENTRY = re.compile(r"  (\S.*?)(?:   *(\S.*))?$")
DEEPER = re.compile(r" {6,}(\S.*)")


def help_of(program, *command):
    run = subprocess.run([program, *command, "--help"], capture_output=True, text=True, check=True)
    return run.stdout


def escaped(text):
    """As troff prints it: backslashes, dashes to be copied, and a dot or quote that begins a line."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + text if text.startswith((".", "'")) else text


def body(help_text):
    """(summary, usage, lines of troff) of a help text."""
    summary, usage, lines, in_examples = [], "", [], False
    for line in help_text.splitlines():
        if heading := HEADING.match(line):
            in_examples = heading[1] == "Examples"
            lines += [f".SH {heading[1].upper()}"]
        elif told := USAGE.match(line):
            usage = told[1]
        elif not lines and not usage:
            summary += [line.strip()]
        elif in_examples and line.strip():
            lines += [".nf", escaped(line.strip()), ".fi"]
        elif more := DEEPER.match(line):
            lines += [escaped(more[1])]
        elif entry := ENTRY.match(line):
            lines += [".TP", f".B {escaped(entry[1])}", escaped(entry[2] or "")]
        elif line.strip():
            lines += [".PP", escaped(line.strip())]
    return " ".join(filter(None, summary)), usage, lines


def commands_of(help_text):
    section = re.search(r"^Subcommands:\n((?:  .*\n)*)", help_text, re.MULTILINE)
    return re.findall(r"^  ([a-z][a-z-]*)", section[1], re.MULTILINE) if section else []


def pages_of(program, version, name, *command):
    """(name, text) of the page of a command and of those of its subcommands."""
    help_text = help_of(program, *command)
    page = "-".join([name, *command])
    summary, usage, lines = body(help_text)
    commands = commands_of(help_text)
    others = [f"{page}-{other}" for other in commands] if commands else [name]
    yield page, "\n".join([
        f'.TH {page.upper()} 1 "" "Q-WSM {version}" "User Commands"',
        ".SH NAME", f"{escaped(page)} \\- {escaped(summary.rstrip('.'))}",
        ".SH SYNOPSIS", f".B {escaped(usage)}",
        *lines,
        ".SH SEE ALSO", *[f".BR {escaped(other)} (1)" for other in others],
    ]) + "\n"
    for other in commands:
        yield from pages_of(program, version, name, *command, other)


def main(program, version, folder):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    for page, text in pages_of(program, version, pathlib.Path(program).name):
        (folder / f"{page}.1").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
