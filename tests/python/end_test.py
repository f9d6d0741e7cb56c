#!/usr/bin/python3
"""Programs that end while threads of theirs make pings: end_test.py INSONIFY SOURCE_FOLDER."""

import subprocess
import sys
import unittest

try:
    import insonify  # noqa: F401
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

# Threads that nobody waits for make pings of a sonar each, or of the same, until the program ends. It does so in the
# middle of them: it has seen some of each, and a batch takes longer than the end.
PROGRAM = """
import atexit, sys, threading
import insonify
scenario = insonify.Scenario.from_dict({
    "points": [{"position": [5, 1, 0], "target_strength_db": -20}],
    "sonars": [{"name": "fls", "beam_count": 64, "bin_count": 400, "max_range": 9}]})
atexit.register(lambda: print("ended", insonify.Simulator(scenario).ping().number))
shared = insonify.Simulator(scenario)
begun = [threading.Event() for _ in range(4)]

def make_pings(sim, event, count):
    while True:
        sim.ping_batch("fls", [insonify.Pose()] * count) if count > 1 else sim.ping()
        event.set()

for i, (sim, count) in enumerate([(insonify.Simulator(scenario), 1), (shared, 1), (shared, 1), (shared, 100)]):
    threading.Thread(target=make_pings, args=(sim, begun[i], count), daemon=True).start()
for event in begun:
    event.wait()
"""


class EndTest(unittest.TestCase):
    def test_threads_that_make_pings_do_not_abort_the_end(self):
        for _ in range(4):
            done = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True, timeout=120, check=False)
            self.assertEqual((done.returncode, done.stderr, done.stdout), (0, "", "ended 0\n"))

    def test_the_end_of_a_fork_does_not_wait_for_threads_that_it_does_not_have(self):
        program = PROGRAM + """
import os
child = os.fork()
if not child:
    atexit._run_exitfuncs()
    os._exit(5)
os._exit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
"""
        program = "\n".join(line for line in program.splitlines() if "ended" not in line)
        words = [sys.executable, "-W", "ignore::DeprecationWarning", "-c", program]  # Python warns of it from 3.12 on.
        done = subprocess.run(words, capture_output=True, text=True, timeout=120, check=False)
        self.assertEqual((done.returncode, done.stderr), (5, ""))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
