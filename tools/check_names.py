#!/usr/bin/python3
"""Finds types of one name in one namespace that are defined in several files.

    tools/check_names.py FOLDER...    # exit status 1 where there are any

The linker merges functions of such types, so that a program runs those of the other: a program's `Track` was destroyed by
the library's destructor of another one.
"""

import pathlib
import re
import sys

NAMESPACE = re.compile(r"^(?:inline )?namespace ?([\w:]*) ?\{")
END = re.compile(r"^\}  // namespace")
TYPE = re.compile(r"^(?:template <.*> )?(?:struct|class|enum class|union) (?:alignas\(\d+\) )?([A-Za-z]\w*)(?: final)?(?: ?:[^:].*)? ?\{")


def types_of(path):
    """Names with their namespaces, but for unnamed ones, whose types are the file's own."""
    spaces = []
    for line in path.read_text(encoding="utf-8").splitlines():
        if opened := NAMESPACE.match(line):
            spaces.append(opened.group(1))
        elif END.match(line):
            spaces.pop()
        elif (found := TYPE.match(line)) and "" not in spaces:
            yield "::".join([*spaces, found.group(1)])


def main():
    places = {}
    for folder in sys.argv[1:]:
        for path in sorted(pathlib.Path(folder).rglob("*")):
            if path.suffix in (".h", ".cpp"):
                for name in types_of(path):
                    places.setdefault(name, []).append(str(path))
    doubled = {name: files for name, files in places.items() if len(files) > 1}
    for name, files in sorted(doubled.items()):
        print(f"{name} is defined in {' and '.join(files)}")
    print(f"{len(places)} types")
    sys.exit(bool(doubled) or not places)


if __name__ == "__main__":
    main()
