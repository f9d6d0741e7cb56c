#!/usr/bin/python3
"""Installs the npm packages of the tests, and copies the tests and the viewer's page beside them: install.py FOLDER. Exit status 77 where there
is no node, npm or registry."""

import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).parent
SKIPPED = 77
NO_NETWORK = ("ENOTFOUND", "ECONNREFUSED", "ECONNRESET", "ETIMEDOUT", "EAI_AGAIN", "ENETUNREACH", "EHOSTUNREACH",
              "ERR_SOCKET_TIMEOUT")


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for program in ("node", "npm"):
        if shutil.which(program) is None:
            print(f"skipped: there is no {program}")
            return SKIPPED
    lock = (HERE / "package-lock.json").read_bytes()
    done = folder / "installed"
    for source, target in ((HERE, folder), (HERE.parent / "web", folder / "web")):
        target.mkdir(exist_ok=True)
        for file in [*source.glob("*.mjs"), *source.glob("*.yaml")]:
            shutil.copy(file, target)
    shutil.rmtree(folder / "page", ignore_errors=True)
    shutil.copytree(HERE.parents[1] / "web", folder / "page")
    if done.exists() and done.read_bytes() == lock:
        return 0
    done.unlink(missing_ok=True)
    for name in ("package.json", "package-lock.json"):
        shutil.copy(HERE / name, folder)
    run = subprocess.run(["npm", "ci", "--no-audit", "--no-fund", "--ignore-scripts"], cwd=folder, text=True,
                         capture_output=True, stdin=subprocess.DEVNULL, check=False)
    if run.returncode != 0:
        print(run.stdout, run.stderr)
        if any(word in run.stderr for word in NO_NETWORK):
            print("skipped: npm cannot reach its registry")
            return SKIPPED
        return 1
    done.write_bytes(lock)
    return 0


if __name__ == "__main__":
    sys.exit(main())
