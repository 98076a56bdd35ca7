# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
"""Every link of the site leads to a page, and to an anchor that it has; no markup is left unread.

    check_site.py FOLDER
"""

import functools
import pathlib
import re
import sys

LINK = re.compile(r'(?:href|src)="([^"]+)"')
ANCHOR = re.compile(r'(?:id|name)="([^"]+)"')
UNREAD = re.compile(r"^@(?:section|subsection) |@ref ", re.MULTILINE)
ELSEWHERE = ("http:", "https:", "mailto:", "javascript:")
DOXYGENS_OWN = {"nested-classes"}  # Its summaries link to lists that it leaves out.


@functools.cache
def text_of(page):
    return page.read_text(encoding="utf-8")


@functools.cache
def anchors_of(page):
    return set(ANCHOR.findall(text_of(page))) | DOXYGENS_OWN


def faults_of(page):
    if UNREAD.search(text_of(page)):
        yield "has markup that Doxygen did not read"
    for target in LINK.findall(text_of(page)):
        if target.startswith(ELSEWHERE):
            continue
        file, _, anchor = target.partition("#")
        linked = page.parent / file if file else page
        if not linked.exists():
            yield f"links to {target}, which is not there"
        elif anchor and linked.suffix == ".html" and anchor not in anchors_of(linked):
            yield f"links to {target}, which has no such anchor"


def main(folder):
    pages = sorted(pathlib.Path(folder).glob("*.html"))
    faults = [f"{page.name}: {fault}" for page in pages for fault in faults_of(page)]
    print(*faults, f"{len(faults)} faults in {len(pages)} pages", sep="\n")
    return 1 if faults or not pages else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
