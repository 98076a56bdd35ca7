# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
"""A page of Markdown as Doxygen 1.9 understands it, on standard output: Doxygen's INPUT_FILTER.

On GitHub every heading is an anchor; here it gets one, named after page and heading, for Doxygen has one
name space for all pages. Links to what is no page of the site (examples, scripts) become names.

    page_filter.py ROOT PAGE   ROOT is the source tree
"""

import os
import pathlib
import re
import sys
import unicodedata

LINK = re.compile(r"(?<!!)\[([^\]]*)\]\(([^)\s]+)\)")
HEADING = re.compile(r"(#+) (.*)")
FENCE = re.compile(r"```")


def slug(heading):
    """The anchor that GitHub and GitLab give a heading."""
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def anchor(page, heading_slug):
    ascii_slug = unicodedata.normalize("NFKD", heading_slug).encode("ascii", "ignore").decode()
    return f"{pathlib.PurePath(page).stem.lower()}-{ascii_slug}"


def is_page(path):
    return path.endswith(".md")


def linked(root, page, match):
    """What a link of a page becomes."""
    text, target = " ".join(match[1].replace("`", "").split()), match[2]
    if target.startswith(("https://", "http://", "mailto:")):
        return match[0]
    file, _, heading = target.partition("#")
    path = os.path.normpath(os.path.join(os.path.dirname(page), file)) if file else page
    if heading and is_page(path):
        return f"[{text}](#{anchor(path, heading)})"
    if is_page(path):
        return f"[{text}]({pathlib.Path(root, path)})"
    return text if path.rstrip("/") in text else f"{text} (`{path}`)"


def filtered(root, page, lines):
    in_code = False
    for line in lines:
        in_code ^= bool(FENCE.match(line))
        heading = HEADING.fullmatch(line)
        if not in_code and heading:
            is_title = heading[1] == "#"
            name = pathlib.PurePath(page).stem.lower() if is_title else anchor(page, slug(heading[2]))
            yield f"{line} {{#{name}}}"
        else:
            yield line


def main(root, page):
    path = pathlib.Path(page).resolve()
    name = path.relative_to(pathlib.Path(root).resolve()).as_posix()
    pieces = re.split(r"(^```.*?^```)", path.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
    for i in range(0, len(pieces), 2):  # The others are code.
        pieces[i] = LINK.sub(lambda match: linked(root, name, match), pieces[i])
    print("\n".join(filtered(root, name, "".join(pieces).split("\n"))))


if __name__ == "__main__":
    main(*sys.argv[1:])
