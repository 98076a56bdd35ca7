# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
"""Documents lead where they say."""

import re

from tree import Finding

LINK = re.compile(r"\]\(([^)\s]+)\)|<img [^>]*src=\"([^\"]+)\"")
HEADING = re.compile(r"#+ (.*)")


def check_links(tree):
    """Every relative link of a Markdown file leads to a file, and to a heading that it has."""
    for path in tree.with_suffix(".md"):
        for number, line in enumerate(tree.lines(path), start=1):
            for link in LINK.finditer(line):
                target = link[1] or link[2]
                if not target.startswith(("https://", "http://", "mailto:")):
                    yield from broken(tree, path, number, target)


def broken(tree, path, number, target):
    file, _, anchor = target.partition("#")
    linked = (tree.root / path).parent / file if file else tree.root / path
    if not linked.exists():
        yield Finding(path, number, f"the link {target} leads nowhere")
    elif anchor and anchor not in anchors(linked):
        yield Finding(path, number, f"{file or path} has no heading for #{anchor}")


def anchors(document):
    headings = (HEADING.match(line) for line in document.read_text(encoding="utf-8").splitlines())
    return {slug(heading[1]) for heading in headings if heading}


def slug(heading):
    """The anchor that GitHub and GitLab give a heading."""
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
