#!/usr/bin/env python3
"""Says where the time of the last build and of the last tests went, as Markdown: seconds of tasks, of which several run at once.

    tools/time_table.py [BUILD]    # a build folder, build/release unless given; of a clean build for all of it
"""

import pathlib
import sys

# What a built file belongs to, by the beginning of its path in the build folder; the first that fits.
PARTS = {
    "library": ("CMakeFiles/insonify.dir/", "lib/libinsonify.so"),
    "reader of SDF": ("CMakeFiles/insonify_sdf", "lib/libinsonify_sdf"),
    "command line": ("apps/insonify/", "bin/", "share/"),
    "bridges": ("apps/bridges/",),
    "Python package": ("python/",),
    "meshes of the scenes": ("scenes/", "make_meshes"),
    "tests": ("tests/",),
    "other": ("",),
}
SLOWEST = 25


def build_seconds(log):
    """Seconds of each part, from ninja's log: start and end [ms], time stamp, output, hash of the command."""
    tasks = {}
    for line in log.read_text().splitlines()[1:]:
        start, end, _, output, _ = line.split("\t")
        tasks[start, end] = output  # One task may make several files.
    parts = dict.fromkeys(PARTS, 0.0)
    for (start, end), output in tasks.items():
        part = next(name for name, places in PARTS.items() if output.startswith(places))
        parts[part] += (int(end) - int(start)) / 1000
    return parts


def test_seconds(costs):
    """Seconds of each test, from what ctest remembers: name, runs, seconds; after them the tests that failed."""
    tests = {}
    for line in costs.read_text().splitlines():
        if line == "---":
            break
        name, _, seconds = line.rsplit(" ", 2)
        tests[name] = float(seconds)
    return tests


def main():
    build = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "build/release")
    parts = build_seconds(build / ".ninja_log")
    print(f"| Built | Seconds |\n| --- | ---: |\n| all | {sum(parts.values()):.0f} |")
    for part, seconds in sorted(parts.items(), key=lambda item: -item[1]):
        print(f"| {part} | {seconds:.0f} |")
    costs = build / "Testing/Temporary/CTestCostData.txt"
    if costs.exists():
        tests = test_seconds(costs)
        print(f"\n| Test | Seconds |\n| --- | ---: |\n| all {len(tests)} | {sum(tests.values()):.0f} |")
        for name, seconds in sorted(tests.items(), key=lambda item: -item[1])[:SLOWEST]:
            print(f"| {name} | {seconds:.1f} |")


if __name__ == "__main__":
    main()
