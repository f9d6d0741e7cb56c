#!/usr/bin/env python3
"""Checks that each public header can be included first: it includes what it needs.

    tools/check_headers.py FOLDER COMPILER [FLAGS...]    # FOLDER: for scratch files; exit status 1 where one cannot

Most headers include Eigen, which takes a second to parse: it is parsed once, for those that include it themselves or by way of
others. All that such a header could use of it unnoticed is what <Eigen/Geometry> includes of the standard library.
"""

import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent / "include"


def includes_eigen(header, known):
    """Whether a header includes Eigen; `known` holds the answers so far."""
    if header not in known:
        known[header] = False  # Ends a circle.
        for name in re.findall(r'^#include ["<]([^">]+)[">]', header.read_text(), re.MULTILINE):
            path = ROOT / name
            if name.startswith("Eigen/") or path.exists() and includes_eigen(path, known):
                known[header] = True
    return known[header]


def main():
    folder, command = pathlib.Path(sys.argv[1]), sys.argv[2:]
    folder.mkdir(parents=True, exist_ok=True)
    parsed = folder / "eigen.h"
    parsed.write_text("#include <Eigen/Geometry>\n")
    subprocess.run([*command, "-x", "c++-header", parsed, "-o", f"{parsed}.gch"], check=True)
    known = {}

    def faults(header):
        """What the compiler says of a file that includes the header first."""
        first = ["-include", parsed] if includes_eigen(header, known) else []
        line = f'#include "{header.relative_to(ROOT)}"\n'
        done = subprocess.run([*command, *first, "-fsyntax-only", "-x", "c++", "-"], input=line, capture_output=True, text=True)
        return done.stderr

    headers = sorted(ROOT.rglob("*.h"))
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = {header: text for header, text in zip(headers, pool.map(faults, headers)) if text}
    for header, text in found.items():
        print(f"{header}: cannot be included first\n{text}")
    print(f"{len(headers)} headers, {len(found)} cannot be included first")
    return 1 if found or not headers else 0


if __name__ == "__main__":
    sys.exit(main())
