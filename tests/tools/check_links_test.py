"""The checker of links finds links to files and headings that are not there, and no others."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
CHECKER = ROOT / "tools/check_links.py"
OTHER = """# Other

## What `it` does, and why

## Twice

## Twice

| <a id="water.depth" href="#water.depth">`depth`</a> |

```
## Not a heading
[not a link](nowhere.md)
```
"""


def check(text):
    """Exit status and lines of the checker on a folder of two pages."""
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "page.md").write_text(text, encoding="utf-8")
        (pathlib.Path(folder) / "other.md").write_text(OTHER, encoding="utf-8")
        done = subprocess.run([sys.executable, CHECKER, folder], stdout=subprocess.PIPE, check=False)
        return done.returncode, done.stdout.decode().replace(f"{folder}/", "")


class CheckLinksTest(unittest.TestCase):
    def test_live_links_pass(self):
        self.assertEqual(check("# A page\n[1](other.md) [2](#a-page) [3](other.md#what-it-does-and-why) [4](other.md#twice-1) "
                               "[5](https://a.example/b#c) [6](other.md#water.depth) `[7](no.md)`\n"), (0, ""))

    def test_dead_links_are_named(self):
        self.assertEqual(check("[1](no.md)\n[2](other.md#why)\n[3](#a)\n![4](no.png)\n[5](other.md#not-a-heading)\n"),
                         (1, "page.md: no.md: there is no such file\npage.md: other.md#why: there is no such heading\n"
                             "page.md: #a: there is no such heading\npage.md: no.png: there is no such file\n"
                             "page.md: other.md#not-a-heading: there is no such heading\n"))

    def test_every_page_is_in_the_navigation_of_the_site(self):
        navigation = (ROOT / "tools/site/mkdocs.yml").read_text(encoding="utf-8").split()
        pages = [path.relative_to(ROOT / "docs").as_posix() for path in (ROOT / "docs").rglob("*.md")]
        self.assertEqual([page for page in pages if page not in navigation], [])


if __name__ == "__main__":
    unittest.main()
