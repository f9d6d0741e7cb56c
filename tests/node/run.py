#!/usr/bin/python3
"""Runs a test of node: run.py FOLDER TEST.mjs ARGS... Exit status 77 where install.py could not install."""

import os
import pathlib
import subprocess
import sys

folder = pathlib.Path(sys.argv[1])
if not (folder / "installed").exists():
    print("skipped: node's packages are not installed; see the test node_packages")
    sys.exit(77)
root = pathlib.Path(__file__).resolve().parents[2]
sys.exit(subprocess.run(["node", folder / sys.argv[2], *sys.argv[3:]], stdin=subprocess.DEVNULL, check=False,
                        env={**os.environ, "INSONIFY_ROOT": str(root)}).returncode)
