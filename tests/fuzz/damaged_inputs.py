"""damaged_inputs.py -- commands on damaged files of every format: none crashes, hangs or swells, each error is one line.

Usage: damaged_inputs.py INSONIFY [--count 5000] [--seed 1] [--formats obj,ply] [--keep FOLDER] [--jobs N]

Each input is a whole file with damages by chance (damage.py), read by a command that is limited to 20 s of processor time and
4 GB. Right is exit status 0 or 2; with 2 one line, printable, that names a file. What is wrong is printed, and kept in FOLDER.
"""

import argparse
import collections
import concurrent.futures
import os
import pathlib
import random
import re
import resource
import shutil
import sys
import tempfile

from damage import damaged
from whole_inputs import whole_inputs

SECONDS, BYTES = 20, 4_000_000_000
FILE_NAME = re.compile(r"[\w.-]+\.(yaml|sdf|obj|ply|stl|dae|gltf|glb|scn|png|asc|tif|bag|csv|svp|asvp|tum|kitti|h5|mcap|np[yz]|raw|bin|xtf|jpg|pgm)\b")


def run(command, folder, limited=True):
    """@return  (exit status or minus the signal, what it wrote to stderr, processor seconds, megabytes at most)."""
    with open(folder / "stderr", "w+b") as err:
        child = os.fork()
        if child == 0:
            os.chdir(folder)
            null = os.open("/dev/null", os.O_RDWR)
            for source, target in ((null, 0), (null, 1), (err.fileno(), 2)):
                os.dup2(source, target)
            resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS + 1))
            if limited:
                resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            os.environ["INSONIFY_LIMITS"] = f"seconds={SECONDS - 5} memory=2e9"
            os.execv(command[0], command)
        _, status, usage = os.wait4(child, 0)
        err.seek(0)
        text = err.read()
    return os.waitstatus_to_exitcode(status), text, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1e3


def what_is_wrong(status, text):
    """@return  None where a command has ended as it should."""
    if status not in (0, 2):
        return f"exit status {status}"
    try:
        lines = text.decode("utf-8").split("\n")[:-1]
    except UnicodeDecodeError:
        return "bytes that are no UTF-8"
    if any(not line.isprintable() for line in lines):
        return "control characters"
    errors = [line for line in lines if line.startswith("insonify: ") and not line.startswith("insonify: warning")]
    if status == 2 and (len(lines) == 0 or not lines[-1].startswith("insonify: ")):
        return "no line that says why"
    if status == 2 and not FILE_NAME.search(lines[-1]):
        return "no file is named"
    if status == 2 and len(errors) > 30:
        return f"{len(errors)} lines of errors"
    return None


def attempt(insonify, inputs, seed, limited):
    """One damaged input. @return  (format, command, exit status, text, seconds, megabytes, what is wrong, damage, input folder)."""
    chance = random.Random(seed)
    form, name, whole, others, commands = inputs[seed % len(inputs)]
    bytes_, how = damaged(whole, chance)
    folder = pathlib.Path(tempfile.mkdtemp(prefix="insonify-damaged-"))
    for other, content in others.items():
        (folder / other).write_bytes(content)
    (folder / name).write_bytes(bytes_)
    command = commands[(seed // len(inputs)) % len(commands)].replace("{}", name)
    status, text, seconds, megabytes = run([insonify, *command.split()], folder, limited)
    return form, command, status, text, seconds, megabytes, what_is_wrong(status, text), how, folder


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("insonify", type=lambda path: str(pathlib.Path(path).resolve()))
    parser.add_argument("--count", type=int, default=5000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--formats", default="")
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("--unlimited", action="store_true", help="without a limit of memory, which sanitizers need")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        inputs = whole_inputs(options.insonify, pathlib.Path(scratch))
    inputs = [entry for entry in inputs if not options.formats or entry[0] in options.formats.split(",")]
    statuses, wrong, slowest, largest = collections.Counter(), 0, (0, ""), (0, "")
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        seeds = range(options.seed, options.seed + options.count)
        for seed, result in zip(seeds, pool.map(lambda one: attempt(options.insonify, inputs, one, not options.unlimited), seeds)):
            form, command, status, text, seconds, megabytes, problem, how, folder = result
            statuses[form, status] += 1
            about = f"{form}, seed {seed}, {how}: insonify {command}"
            slowest, largest = max(slowest, (seconds, about)), max(largest, (megabytes, about))
            if problem:
                wrong += 1
                print(f"{about}: {problem}: {text[-300:]!r}", flush=True)
                if options.keep:
                    shutil.copytree(folder, options.keep / f"{form}-{seed}")
            shutil.rmtree(folder)
    for form in sorted({form for form, _ in statuses}):
        print(f"{form:6}", ", ".join(f"status {status}: {count}" for (of, status), count in sorted(statuses.items()) if of == form))
    print(f"slowest {slowest[0]:.1f} s: {slowest[1]}\nlargest {largest[0]:.0f} MB: {largest[1]}")
    print(f"{options.count} damaged inputs, {wrong} wrong")
    return 1 if wrong or len(statuses) == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
