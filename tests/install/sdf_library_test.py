#!/usr/bin/python3
"""libinsonify_sdf is opened at the first SDF file, and one line says so where it is absent.

    sdf_library_test.py INSONIFY LIBRARY SONAME SCENARIO    # the scenario's world is an SDF file
"""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

program, library, soname, scenario = sys.argv[1:]


def run(*words, folder="", **environment):
    """A process that finds libraries in the folder first."""
    environment = {**os.environ, "LD_LIBRARY_PATH": folder, **environment}
    return subprocess.run([program, *words], capture_output=True, text=True, env=environment)


def libraries_of(*words):
    """What the loader opens for a process."""
    done = run(*words, LD_DEBUG="files")
    assert done.returncode == 0, done.stderr
    return done.stderr


with tempfile.TemporaryDirectory() as folder:
    out = str(pathlib.Path(folder) / "out")
    assert "libsdformat" not in libraries_of("version")
    assert "libsdformat" in libraries_of("run", scenario, "-o", out, "--pings", "1", "--no-pictures")

    alone = pathlib.Path(folder) / "alone"
    alone.mkdir()
    shutil.copy(library, alone / soname)
    presets = str(pathlib.Path(scenario).parent.parent / "presets")
    done = run("run", scenario, "-o", out, "--force", folder=str(alone), INSONIFY_PRESETS=presets)
    world = pathlib.Path(scenario).with_suffix(".sdf")
    missing = alone / soname.replace("insonify", "insonify_sdf")
    assert done.returncode == 2, done
    assert done.stderr == (f"insonify: {world}: the reader of SDF files cannot be opened: {missing}: cannot open shared object "
                           "file: No such file or directory\n"), done.stderr
print("Opened when needed, and missed in one line")
