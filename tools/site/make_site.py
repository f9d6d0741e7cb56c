#!/usr/bin/python3
"""Makes the site from docs/: gathers its pages in build/site/pages, has mkdocs build them in build/docs, checks its links.

    tools/site/make_site.py --build build/release --xml FOLDER    # FOLDER: what Doxygen reads of the public headers

Pages are those of docs/, by the same paths; the changelog and its like are pages of project/. What else a page links to in the
source tree is copied to source/. A comment `<!-- site: TEXT -->` is TEXT in the site alone, and nothing on GitHub.
"""

import argparse
import html.parser
import os
import pathlib
import re
import shutil
import subprocess
import sys
import urllib.parse

import cpp_reference

ROOT = pathlib.Path(__file__).resolve().parents[2]
HERE = pathlib.Path(__file__).resolve().parent
PAGES = ROOT / "build/site/pages"
SITE = ROOT / "build/docs"
KATEX = pathlib.Path("/usr/share/javascript/katex")
# Pages of other folders, by their place in the site.
PROJECT = {"CHANGELOG.md": "project/changelog.md", "CONTRIBUTING.md": "project/contributing.md",
           "SECURITY.md": "project/security.md", "bench/README.md": "project/benchmarks.md", "README.md": "index.md"}
LINK = re.compile(r"(\]\(|\]: |src=\"|href=\")([^)\s\"]+)")
FENCED = re.compile(r"(^ *(?P<ticks>```+).*?^ *(?P=ticks) *$)", re.MULTILINE | re.DOTALL)
SITE_ONLY = re.compile(r"(`+[^`]*`+)|<!-- site: (.*?) -->", re.DOTALL)
COMMENT = re.compile(r"^ *<!--.*?-->\n?", re.MULTILINE | re.DOTALL)


def place_of(path):
    """Where in the site a file of the source tree is, copied there if it is no page."""
    inside = path.relative_to(ROOT).as_posix()
    if inside in PROJECT:
        return PROJECT[inside]
    if inside.startswith("docs/"):
        return inside.removeprefix("docs/")
    target = PAGES / "source" / (inside if path.suffix in (".png", ".svg") else inside + ".txt")
    target.parent.mkdir(parents=True, exist_ok=True)
    if path.is_file():
        shutil.copyfile(path, target)
    else:
        target.write_text("\n".join(sorted(p.name for p in path.iterdir())) + "\n", encoding="utf-8")
    return target.relative_to(PAGES).as_posix()


def page(path, text):
    """The text of a page as the site has it."""
    where = pathlib.PurePosixPath(PROJECT.get(path.relative_to(ROOT).as_posix(), path.relative_to(ROOT).as_posix().removeprefix("docs/")))

    def moved(link):
        target, _, anchor = link[2].partition("#")
        if not target or re.match(r"\w+:", target):
            return link[0]
        file = (path.parent / urllib.parse.unquote(target)).resolve()
        if not file.exists():
            return link[0]  # A page that is made for the site; mkdocs says if it is not there.
        return link[1] + os.path.relpath(place_of(file), where.parent) + ("#" + anchor if anchor else "")

    parts = FENCED.split(text)
    # Groups of the pattern: text, block, ticks, text ...
    shown = [SITE_ONLY.sub(lambda found: found[1] or found[2], part) for part in parts[0::3]]
    texts = [LINK.sub(moved, COMMENT.sub("\n", part)) for part in shown]
    blocks = parts[1::3] + [""]
    return "".join(part + block for part, block in zip(texts, blocks, strict=True))


def gather():
    """Pages and what they are shown with."""
    shutil.rmtree(PAGES, ignore_errors=True)
    shutil.copytree(ROOT / "docs", PAGES)
    for path in [*(ROOT / "docs").rglob("*.md"), *(ROOT / name for name in PROJECT if name != "README.md")]:
        target = PAGES / place_of(path)
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(page(path, path.read_text(encoding="utf-8")), encoding="utf-8")
    assets = PAGES / "assets"
    (assets / "katex").mkdir(parents=True)
    for name in ("site.css", "site.js"):
        shutil.copyfile(HERE / name, assets / name)
    shutil.copyfile(ROOT / "web/icon.svg", assets / "favicon.svg")
    for name in ("katex.min.css", "katex.min.js"):
        shutil.copyfile(KATEX / name, assets / "katex" / pathlib.Path(name).name)
    (assets / "katex/fonts").mkdir()
    for font in (KATEX / "fonts").glob("*.woff2"):
        shutil.copyfile(font, assets / "katex/fonts" / font.name)


def references(build, doxygen):
    """Pages of the Python and C++ references; writes the settings of the site with them in the navigation."""
    made = subprocess.run([sys.executable, HERE / "python_reference.py", PAGES / "reference"], check=True, stdout=subprocess.PIPE,
                          env=dict(os.environ, PYTHONPATH=f"{build}/python", PYTHONDONTWRITEBYTECODE="1"), encoding="utf-8")
    python = [line.partition(" ")[::2] for line in made.stdout.splitlines()]
    cpp = [(file, name) for name, file in cpp_reference.write_pages(doxygen, PAGES / "reference")]
    settings = (HERE / "mkdocs.yml").read_text(encoding="utf-8")
    for marker, pages in (("PYTHON", python), ("CPP", [("cpp_headers.md", "All headers"), *cpp])):
        indent = " " * 10
        lines = "\n".join(f"{indent}    - {title}: reference/{file}" for file, title in pages)
        settings = settings.replace(f"{indent}    - {marker}", lines)
    (ROOT / "build/site/mkdocs.yml").write_text(settings, encoding="utf-8")


def show_film():
    """Puts the film on the first page, in place of the moving picture, if ./dev pictures film has made one."""
    film = ROOT / "build/film/film.mp4"
    if film.is_file():
        shutil.copyfile(film, PAGES / "images/film.mp4")
        page = PAGES / "index.md"
        shown = '<video class="film" controls preload="metadata" poster="images/viewer_dark.png" src="images/film.mp4"></video>'
        page.write_text(re.sub(r"!\[[^\]]*\]\(images/viewer.gif\)", shown, page.read_text(encoding="utf-8")), encoding="utf-8")


class Links(html.parser.HTMLParser):
    """Anchors and links of a page."""

    def __init__(self, path):
        super().__init__()
        self.anchors, self.links = {"", "__skip"}, []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("id", "name") and value:
                self.anchors.add(value)
            elif name in ("href", "src") and value and not re.match(r"\w+:|//", value):
                self.links.append(value)


def dead_links():
    """Links of the site's pages to files or anchors that are not there."""
    pages = {path: Links(path) for path in SITE.rglob("*.html")}
    for path, page_links in pages.items():
        if path.name == "404.html":
            continue  # Its links are from the server's root.
        for link in page_links.links:
            target, _, anchor = urllib.parse.unquote(link).partition("#")
            file = (path.parent / target.partition("?")[0]).resolve() if target else path
            file = file / "index.html" if file.is_dir() else file
            if not file.exists() or (file in pages and anchor not in pages[file].anchors):
                yield f"{path.relative_to(SITE)}: {link} is not there"


def main():
    parser = argparse.ArgumentParser(description="Makes the site from docs/.")
    parser.add_argument("--build", required=True, help="build folder with the Python package in it")
    parser.add_argument("--xml", required=True, type=pathlib.Path, help="folder of Doxygen's XML of the public headers")
    arguments = parser.parse_args()
    gather()
    show_film()
    references(arguments.build, arguments.xml)
    done = subprocess.run([sys.executable, "-m", "mkdocs", "build", "--quiet", "--strict", "-f", ROOT / "build/site/mkdocs.yml"], check=False)
    dead = list(dead_links()) if done.returncode == 0 else []
    print(*dead, sep="\n", end="\n" if dead else "")
    return done.returncode or bool(dead)


if __name__ == "__main__":
    sys.exit(main())
