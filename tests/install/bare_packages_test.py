"""bare_packages_test.py PACKAGES TESTS -- Debian packages, used on a machine that has Python, NumPy and apt alone.

PACKAGES is the folder of the .deb files, TESTS that of the tests' built programs. Run by `./dev package --test` as root in a bare
root, which it changes. Each bridge is installed, and a vehicle beside a wall rides by its messages (bench/follow_wall.py).
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

SOURCES = pathlib.Path(__file__).resolve().parents[2]
# What the vehicle needs beside the bridge's own package, and its program.
VEHICLES = {"ros1": (["python3-rosmaster", "python3-rospy", "python3-geometry-msgs", "python3-nav-msgs"], None),
            "dds": (["fastdds-tools"], "bridges/dds/wall_vehicle"),
            "gazebo": ([], "bridges/gazebo/gazebo_wall_vehicle")}
PING = """
import insonify
ping = insonify.Simulator(insonify.Scenario.load("ferry")).ping()
assert (ping.intensity > 0).any()
print("ferry from Python", insonify.__version__, *ping.shape)
"""


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "DEBIAN_FRONTEND": "noninteractive"})
    assert done.returncode == 0, f"{command}: {done.returncode}\n{done.stdout}{done.stderr}"
    return done.stdout


def install(*packages):
    """Returns the seconds that it took."""
    started = time.monotonic()
    run("apt-get", "install", "-y", "--no-install-recommends", *map(str, packages))
    return time.monotonic() - started


def main(packages, tests):
    assert not any(map(shutil.which, ("gcc", "g++", "cmake", "insonify"))), "this root is not bare"
    os.chdir(tempfile.mkdtemp())
    run("apt-get", "update")
    plain = [path for path in packages.glob("*.deb") if re.match("(lib|python3-)?insonify[0-9._]", path.name)]
    print(f"{', '.join(sorted(path.name for path in plain))}: installed in {install(*plain):.1f} s")
    assert "pings/s" in run("insonify", "run", "ferry", "--pings", "1", "-o", "run")
    print(run("python3", "-c", PING).strip())
    for bridge, (more, vehicle) in VEHICLES.items():
        found = list(packages.glob(f"insonify-{bridge}_*.deb"))
        if not found:
            print(f"{bridge}: there is no package")
            continue
        seconds = install(*found)
        assert f"insonify bridge {bridge}" in run("insonify", "bridge", bridge, "--help")
        install(*more)
        ride = ["--vehicle", str(tests / vehicle)] if vehicle else []
        print(f"{found[0].name}: installed in {seconds:.1f} s")
        print(run("python3", str(SOURCES / "bench/follow_wall.py"), bridge, "/usr/bin/insonify", "--seconds", "3", "--slowest", "0",
                  *ride).strip())


if __name__ == "__main__":
    main(*(pathlib.Path(word).resolve() for word in sys.argv[1:]))
