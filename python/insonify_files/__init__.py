"""What a wheel of insonify holds beside the Python package: command line, libraries, presets, scenes."""

import os
import pathlib
import sys


def main() -> None:
    """The command `insonify`: becomes the program. Nothing else is imported, so that it starts at once."""
    program = pathlib.Path(__file__).parent / "bin/insonify"
    os.execv(program, ["insonify", *sys.argv[1:]])
