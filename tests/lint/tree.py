# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
"""The project's own files, and what a check says about them."""

import os
import pathlib
import subprocess
from dataclasses import dataclass

NOT_OURS = {".git", ".cache", "build", "node_modules", "results"}


@dataclass(frozen=True)
class Finding:
    """Something to mend; printed as editors and compilers do."""

    path: str
    line: int
    text: str

    def __str__(self):
        return f"{self.path}:{self.line}: {self.text}"


class Tree:
    """All files of a checkout, by their path from its root."""

    def __init__(self, root):
        self.root = pathlib.Path(root).resolve()
        self.paths = sorted(self._tracked() or self._found())

    def _tracked(self):
        """What git tracks or would track; None where there is no git or no repository."""
        listed = ["--cached", "--others", "--exclude-standard"]
        command = ["git", "-C", self.root, "ls-files", "-z", *listed]
        try:
            listing = subprocess.run(command, capture_output=True, check=True).stdout.decode()
        except (OSError, subprocess.CalledProcessError):
            return None
        return [path for path in listing.split("\0") if path and (self.root / path).is_file()]

    def _found(self):
        for folder, folders, files in os.walk(self.root):
            folders[:] = [name for name in folders if name not in NOT_OURS]
            for name in files:
                yield (pathlib.Path(folder) / name).relative_to(self.root).as_posix()

    def with_suffix(self, *suffixes):
        return [path for path in self.paths if path.endswith(suffixes)]

    def lines(self, path):
        """The lines of a text file; none of a binary one."""
        try:
            return (self.root / path).read_text(encoding="utf-8").splitlines()
        except UnicodeDecodeError:
            return []

    def scripts(self):
        """Shell scripts, with or without an ending."""
        shebangs = ("#!/bin/sh", "#!/usr/bin/env bash", "#!/bin/bash")
        return [path for path in self.paths if "".join(self.lines(path)[:1]).startswith(shebangs)]
