"""bare_root_test.py FOLDER -- the wheel and the archive in FOLDER, used as on a machine that has Python, NumPy and pip alone.

Run by `./dev wheel --test` as root in bare roots of Debian 12 and 13, which it changes.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import urllib.request

PING = """
import insonify
sim = insonify.Simulator(insonify.Scenario.load("ferry_calibrated"))
ping = sim.ping()
assert (ping.intensity > 0).any()
names = {sim.scene.instance_names[i] for i in set(ping.instance.ravel().tolist()) if i != insonify.NO_LABEL}
assert any("ferry" in name for name in names), names
insonify.write_png("ferry.png", insonify.fan(ping))
print("ferry_calibrated from Python", insonify.__version__, *ping.shape)
"""


def run(*command, **more):
    return subprocess.run(command, check=True, capture_output=True, text=True, **more).stdout


def check_program(program):
    """The command line, by its path or name: a scene of SDF with its meshes, a recording that is read again, a page that answers."""
    assert "cpu" in run(program, "version")
    assert "tritech-gemini-720i" in run(program, "sonars")
    assert re.search("^sphere ", run(program, "scenes"), re.MULTILINE)
    said = run(program, "run", "ferry", "--pings", "1", "-o", "run")
    assert "pings/s" in said, said
    assert pathlib.Path("run/fls.h5").stat().st_size > 100_000 and list(pathlib.Path("run").glob("fls_fan*.png"))
    assert "fls" in run(program, "info", "run/fls.h5")
    shutil.rmtree("run")
    served = subprocess.Popen([program, "serve", "sphere", "--port", "0"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    try:
        for line in served.stdout:
            if address := re.search(r"http://\S+?:\d+", line):
                break
        with urllib.request.urlopen(address.group(0) + "/") as page:
            assert page.status == 200 and b"<html" in page.read()
    finally:
        served.terminate()
        served.wait()


def main(folder):
    assert not any(map(shutil.which, ("gcc", "cc", "g++", "cmake"))), "this root is not bare"
    digits = "".join(map(str, sys.version_info[:2]))
    wheel, = folder.glob(f"*-cp{digits}-*.whl")
    archive, = folder.glob("*.tar.gz")
    os.chdir(tempfile.mkdtemp())
    started = time.monotonic()
    run("pip", "install", "--no-index", "--break-system-packages", "--root-user-action=ignore", str(wheel))
    installed = time.monotonic()
    print(run(sys.executable, "-c", PING).strip())
    print(f"pip install {installed - started:.1f} s, first ping {time.monotonic() - installed:.1f} s later")
    check_program("insonify")
    run("pip", "uninstall", "-y", "--break-system-packages", "--root-user-action=ignore", "insonify")
    run("tar", "xf", str(archive))
    tree, = pathlib.Path().glob("insonify-*")
    tree.rename("moved")
    check_program(os.path.abspath("moved/bin/insonify"))
    print("wheel and archive: run, info, serve, SDF worlds")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]).resolve())
