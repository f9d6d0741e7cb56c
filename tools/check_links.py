#!/usr/bin/python3
"""Checks that relative links of Markdown files lead to files and headings that are there, as GitHub names these.

    tools/check_links.py README.md docs    # exit status 1 where a link is dead; folders are searched for *.md
"""

import pathlib
import re
import sys
import urllib.parse

FENCED = re.compile(r"^ *(`{3,}).*?^ *\1`* *$", re.MULTILINE | re.DOTALL)
CODE = re.compile(r"(`+)(?!`).*?(?<!`)\1(?!`)", re.DOTALL)
COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
HEADING = re.compile(r"^#{1,6} +(.*?) *#*$", re.MULTILINE)
LINK = re.compile(r"\]\(([^)\s]+)\)|(?:href|src)=\"([^\"]+)\"")


def slug(heading):
    """The anchor that GitHub gives a heading; the site gives the same."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "")
    return re.sub(r"[^\w\- ]", "", text.lower()).replace(" ", "-")


def anchors_of(path):
    """All anchors of a page: of its headings, numbered where they repeat, and those that it names itself."""
    text = FENCED.sub("", path.read_text(encoding="utf-8"))
    anchors = set(re.findall(r"<a id=\"([^\"]+)\"", text))
    for heading in HEADING.findall(text):
        name, count = slug(heading), 0
        while name + (f"-{count}" if count else "") in anchors:
            count += 1
        anchors.add(name + (f"-{count}" if count else ""))
    return anchors


def dead_links(path, known):
    """What is wrong with the links of a page, a line each."""
    text = COMMENT.sub("", FENCED.sub("", path.read_text(encoding="utf-8")))
    for match in LINK.finditer(CODE.sub("", text)):
        link = match[1] or match[2]
        if re.match(r"\w+:", link):
            continue
        target, _, anchor = urllib.parse.unquote(link).partition("#")
        file = (path.parent / target).resolve() if target else path.resolve()
        if not file.exists():
            yield f"{path}: {link}: there is no such file"
        elif anchor and file.suffix == ".md" and anchor not in known.setdefault(file, anchors_of(file)):
            yield f"{path}: {link}: there is no such heading"


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    named = [pathlib.Path(name) for name in sys.argv[1:]]
    pages = [page for path in named for page in (sorted(path.rglob("*.md")) if path.is_dir() else [path])]
    known = {}
    dead = [line for page in pages for line in dead_links(page, known)]
    print(*dead, sep="\n", end="\n" if dead else "")
    return bool(dead)


if __name__ == "__main__":
    sys.exit(main())
