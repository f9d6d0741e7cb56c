#!/usr/bin/python3
"""failing_calls.py -- the n-th allocation, write or opening of a file fails in a small run: no crash, and no half file.

failing_calls.py INSONIFY LIBRARY [--count 40] [--kinds allocation,write,open] [--keep FOLDER]

LIBRARY is failing_calls.cpp, preloaded. For each kind, COUNT calls are spread over all of the run. Right is exit status 0, 1 or 2, with
one line if it is not 0; recordings that can be read, pictures that are whole, and nothing unfinished.
"""

import argparse
import concurrent.futures
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

SCENARIO = """world: world.obj
pings: 2
sonars:
  - {name: a, beam_count: 12, bin_count: 20, max_range: 12, position: [0, 0, 3], orientation_deg: [0, 60, 0],
     sampling: {columns_per_beam: 1, rows: 8}}
"""
COMMAND = "run s.yaml -o out --record h5,mcap --threads 1 -q --height 240 --no-view"


def run(insonify, library, fail, folder, calls=None):
    (folder / "world.obj").write_text("v -9 -9 0\nv 9 -9 0\nv 0 9 0\nf 1 2 3\n")
    (folder / "s.yaml").write_text(SCENARIO)
    environment = {**os.environ, "LD_PRELOAD": library, "INSONIFY_FAIL": fail, **({"INSONIFY_CALLS": calls} if calls else {})}
    return subprocess.run([insonify, *COMMAND.split()], cwd=folder, env=environment, capture_output=True, timeout=60)


def what_is_wrong(insonify, done, folder):
    """@return  None where a run has ended as it should."""
    if done.returncode not in (0, 1, 2):
        return f"exit status {done.returncode}"
    lines = done.stderr.decode(errors="replace").splitlines()
    if done.returncode != 0 and not any(line.startswith("insonify: ") for line in lines):
        return "no line that says why"
    for path in (folder / "out").glob("*"):
        if path.suffix == ".new" or ".new" in path.name:
            return f"{path.name} is left"
        if path.suffix == ".png" and not path.read_bytes().endswith(b"IEND\xaeB`\x82"):
            return f"{path.name} is not whole"
        if path.suffix in (".h5", ".mcap"):
            info = subprocess.run([insonify, "info", "--verify", path], capture_output=True, text=True)
            if info.returncode != 0:
                return f"{path.name}: {info.stderr}"
    return None


def attempt(insonify, library, fail, keep):
    folder = pathlib.Path(tempfile.mkdtemp(prefix="insonify-failing-"))
    try:
        done = run(insonify, library, fail, folder)
        problem = what_is_wrong(insonify, done, folder)
        if problem and keep:
            shutil.copytree(folder, keep / fail.replace(" ", "-"))
        return done.returncode, problem, done.stderr[-300:]
    finally:
        shutil.rmtree(folder)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("insonify", type=lambda path: str(pathlib.Path(path).resolve()))
    parser.add_argument("library", type=lambda path: str(pathlib.Path(path).resolve()))
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--kinds", default="allocation,write,open")
    parser.add_argument("--keep", type=pathlib.Path)
    options = parser.parse_args()
    wrong = 0
    for kind in options.kinds.split(","):
        with tempfile.TemporaryDirectory() as scratch:
            calls = pathlib.Path(scratch) / "calls"
            whole = run(options.insonify, options.library, f"{kind} 0", pathlib.Path(scratch), str(calls))
            if whole.returncode != 0:
                print(whole.stderr)
                return 1
            total = int(calls.read_text())
        count = min(options.count, total)
        which = sorted({1 + i * total // count for i in range(count)})
        failed = 0
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            fails = [f"{kind} {n}" for n in which]
            for fail, result in zip(fails, pool.map(lambda one: attempt(options.insonify, options.library, one, options.keep), fails)):
                status, problem, text = result
                failed += status != 0
                if problem:
                    wrong += 1
                    print(f"{fail}: {problem}: {text!r}", flush=True)
        print(f"{kind}: {len(which)} of {total} failed, {failed} ended the run")
        wrong += failed == 0
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
