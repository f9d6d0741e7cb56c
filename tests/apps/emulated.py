"""A program `insonify emulate` in a folder of its own, for tests. The program is their first argument."""

import faulthandler
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

INSONIFY = os.path.abspath(sys.argv.pop(1))
faulthandler.dump_traceback_later(110, exit=True)  # A test that hangs says where, before ctest ends it.

# For the end of a program that waits for nothing, on a machine with much else to do [s].
PROMPT = 10


class Emulated:
    """`files` are written into the folder first. What the program prints is read by those who derive from this."""

    def __init__(self, *words, files):
        self.folder = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self.folder.name)
        for name, text in files.items():
            (self.path / name).write_text(text)
        # As a shell's script starts it with `&`: it must end on SIGINT all the same.
        self.process = subprocess.Popen([INSONIFY, "emulate", *words], cwd=self.path, text=True,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_IGN))

    def end(self):
        """Exit status, what was printed on both streams, and how long it took [s]."""
        start = time.monotonic()
        self.process.send_signal(signal.SIGINT)
        out, err = self.process.communicate(timeout=120)
        return self.process.returncode, out, err, time.monotonic() - start

    def close(self):
        if self.process.poll() is None:
            self.process.kill()
            self.process.communicate()
        self.process.stdout.close()
        self.process.stderr.close()
        self.folder.cleanup()
