# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
"""Documents lead where they say, and agree with each other."""

import re
import unicodedata

import layers
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


NUMBER = re.compile(r"-?\d+(\.(\d+))?")


def check_figures(tree):
    """Every figure of README's results is that of docs/results.md, rounded."""
    if not {"README.md", "docs/results.md"} <= set(tree.paths):
        return
    measured = {}
    for _, row, column, cell in cells(tree.lines("docs/results.md")):
        measured[frozenset((row, column))] = cell
    for line, row, column, cell in cells(section(tree.lines("README.md"), "## Results")):
        figure = NUMBER.match(cell)
        source = NUMBER.match(measured.get(frozenset((row, column)), ""))
        if figure and not source:
            yield Finding("README.md", line, f"docs/results.md has no '{column}' of '{row}'")
        elif figure and abs(float(source[0]) - float(figure[0])) > rounding(figure):
            told = f"'{column}' of '{row}' is {figure[0]}, in docs/results.md it is {source[0]}"
            yield Finding("README.md", line, told)


def rounding(figure):
    """Half a unit of the last digit, and a little for a 5 that was rounded either way."""
    return 0.501 * 10.0 ** -len(figure[2] or "")


def section(lines, heading):
    """The lines with all but those below the heading made empty: numbers stay what they are."""
    inside = False
    kept = []
    for line in lines:
        if line.startswith("#"):
            inside = line == heading
        kept.append(line if inside else "")
    return kept


def cells(lines):
    """(line, row, column, text) of every cell of every Markdown table."""
    header = None
    for number, line in enumerate(lines, start=1):
        if not line.startswith("|"):
            header = None
            continue
        row = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if header is None:
            header = row
        elif not set(line) <= set("|-: "):
            for column, cell in zip(header[1:], row[1:]):
                yield number, row[0], column, cell


def check_layer_table(tree):
    """The table of folders in docs/architecture.md is that of tests/lint/layers.py."""
    path = "docs/architecture.md"
    if path not in tree.paths:
        return
    told = {}
    for number, row, column, cell in cells(section(tree.lines(path), "## Folders")):
        layer = row.strip("`/")
        if column == "may use" and layer in layers.MAY_USE:
            named = set(re.findall(r"`([\w/]+)`", cell))
            told[layer] = set(told) - named if "all of the above" in cell else named
            if told[layer] != layers.MAY_USE[layer]:
                allowed = ", ".join(sorted(layers.MAY_USE[layer])) or "nothing of ours"
                yield Finding(path, number, f"{layer} may use {allowed}, says tests/lint/layers.py")
    for layer in sorted(set(layers.MAY_USE) - set(told)):
        yield Finding(path, 1, f"the table of folders has no row for {layer}")


CITATION = re.compile(r"//.*?\b([A-Z][\w-]+)(?: et al\.)?,? \(?((?:19|20)\d\d)\b")
ENTRY = re.compile(r"@\w+\{(.*?)\n\}", re.DOTALL)


def check_citations(tree):
    """Every paper that a comment cites by name and year stands in docs/references.bib."""
    path = "docs/references.bib"
    entries = ENTRY.findall("\n".join(tree.lines(path))) if path in tree.paths else []
    papers = [plain(entry) for entry in entries]
    for source in tree.with_suffix(".hpp", ".cpp", ".inc"):
        for number, line in enumerate(tree.lines(source), start=1):
            for name, year in CITATION.findall(line):
                if not any(plain(name) in paper and year in paper for paper in papers):
                    yield Finding(source, number, f"{path} does not have {name} {year}")


def plain(text):
    """Letters without what stands above them, be it Unicode or LaTeX."""
    letters = unicodedata.normalize("NFD", re.sub(r"\\.|[{}]", "", text))
    return "".join(letter for letter in letters if not unicodedata.combining(letter)).lower()
