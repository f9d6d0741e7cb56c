#!/usr/bin/env python3
"""Checks that each public header can be included first: it includes what it needs.

    tools/check_headers.py FOLDER COMPILER [FLAGS...]    # FOLDER: for scratch files; exit status 1 where one cannot

Headers are parsed in chains: before a header may stand those that it includes, and which include nothing else than it does, so
that it finds nothing that it would not have by itself. And most headers include Eigen, which takes a second to parse: it is
parsed once, for those that include it themselves or by way of others. All that such a header could use of it unnoticed is what
<Eigen/Geometry> includes of the standard library.
"""

import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent / "include"


def included_by(header, known):
    """Names of all that a header includes, itself too, directly or by way of our others; `known` holds the answers so far."""
    name = str(header.relative_to(ROOT))
    if name not in known:
        known[name] = {name}  # Ends a circle.
        for included in re.findall(r'^#include ["<]([^">]+)[">]', header.read_text(), re.MULTILINE):
            path = ROOT / included
            known[name] = known[name] | (included_by(path, known) if path.exists() else {included})
    return known[name]


def uses_eigen(names):
    return any(name.startswith("Eigen/") for name in names)


def chains_of(headers):
    """The headers in chains, each of which includes the one before it; with Eigen in all of a chain, or in none."""
    chains, known = [], {}
    for header in sorted(headers, key=lambda header: len(included_by(header, known))):
        names = included_by(header, known)
        before = [chain for chain in chains
                  if str(chain[-1].relative_to(ROOT)) in names
                  and uses_eigen(included_by(chain[-1], known)) == uses_eigen(names)]
        if before:
            max(before, key=lambda chain: len(included_by(chain[-1], known))).append(header)
        else:
            chains.append([header])
    return [(chain, uses_eigen(included_by(chain[0], known))) for chain in chains]


def main():
    folder, command = pathlib.Path(sys.argv[1]), sys.argv[2:]
    folder.mkdir(parents=True, exist_ok=True)
    parsed = folder / "eigen.h"
    parsed.write_text("#include <Eigen/Geometry>\n")
    subprocess.run([*command, "-x", "c++-header", parsed, "-o", f"{parsed}.gch"], check=True)

    def faults(chain):
        """What the compiler says of a file that includes the headers of a chain."""
        headers, eigen = chain
        first = ["-include", parsed] if eigen else []
        lines = "".join(f'#include "{header.relative_to(ROOT)}"\n' for header in headers)
        done = subprocess.run([*command, *first, "-fsyntax-only", "-x", "c++", "-"], input=lines, capture_output=True, text=True)
        return done.stderr

    headers = sorted(ROOT.rglob("*.h"))
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = [text for text in pool.map(faults, chains_of(headers)) if text]
    for text in found:
        print(f"A header cannot be included first:\n{text}")
    print(f"{len(headers)} headers: " + ("at least one cannot be included first" if found else "each can be included first"))
    return 1 if found or not headers else 0


if __name__ == "__main__":
    sys.exit(main())
