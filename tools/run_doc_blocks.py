#!/usr/bin/python3
"""Runs the code blocks of Markdown files, so that what the documentation shows is what happens.

    tools/run_doc_blocks.py --build build/dev README.md docs/tutorial.md    # exit status 1 where a block fails

The blocks of a file run from top to bottom in one scratch folder of their own, which has the source tree's `scenes`,
`presets` and `examples` in it, the build as `build/release`, and the command line as `insonify` on the path. `python3`
is the Python that runs this, and finds the Python package of the build.

    ```bash      run by bash, stopping at the first command that fails
    ```python    run by python3
    ```cpp       a whole program: compiled against the library and run, in the scratch folder
    ```console   what the block that ran last printed, or a part of it: compared line by line

In a console block a line of `...` stands for any lines. Times and rates (numbers before s, ms or pings/s) may be others.

Other blocks are only shown. A comment before a block says otherwise:

    <!-- file: NAME -->          the block is the file NAME: written, not run (but a cpp program is compiled and run too)
    <!-- run: no (REASON) -->    the block is not run; REASON tells a reader of the source why
    <!-- run: fails -->          the block must fail: the exit status is not 0. A console block with its message must follow
    <!-- run: with --images -->  the block is run with --images alone: it is slow, and only makes pictures
    <!-- run: needs MODULE -->   the block is run where Python can import MODULE, else only shown; a name with
                                 a dash, as insonify-bridge-dds, is that of a program on the path
    <!-- from: PATH -->          the block is not run; its lines are those of the file PATH of the source tree, in order,
                                 with `...` for lines that are left out

A comment anywhere says where a picture that the page shows comes from; blocks must have made it when the page ends:

    <!-- image: ../images/reef.png = reef/fls_fan_0000.png -->

A Jupyter notebook (.ipynb) is run as one program, and compared with the text output that it stores.

With --images the pictures in the source tree are replaced by those.
"""

import argparse
import dataclasses
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SECONDS_PER_BLOCK = 300
PICTURES_ONLY = "with --images"
MARKER = re.compile(r"^\s*<!--\s*(file|run|from):\s*(.*?)\s*-->\s*$")
IMAGE = re.compile(r"^\s*<!--\s*image:\s*(\S+)\s*=\s*(\S+)\s*-->\s*$")
TIME = re.compile(r"\b\d+(\.\d+)?(?= (s|ms|pings/s)\b)")
FENCE = re.compile(r"^(\s*)(`{3,})(\w*)[^`]*$")


@dataclasses.dataclass
class Block:
    line: int
    language: str
    text: str
    file: str | None = None
    run: str | None = None
    source: str | None = None


class Fault(Exception):
    """A block that does not do what it should, or a marker that makes no sense."""


def blocks_of(path):
    """Code blocks of a Markdown file, each with the markers before it."""
    blocks, markers, inside = [], {}, None
    indent = ticks = ""
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
        fence = FENCE.match(line)
        marker = MARKER.match(line)
        if inside is not None:
            if fence and not fence.group(3) and len(fence.group(2)) >= len(ticks):
                blocks.append(inside)
                inside = None
            else:
                inside.text += line.removeprefix(indent) + "\n"
        elif fence:
            indent, ticks = fence.group(1), fence.group(2)
            inside = Block(number, fence.group(3), "", markers.get("file"), markers.get("run"),
                           markers.get("from"))
            markers = {}
        elif marker:
            markers[marker.group(1)] = marker.group(2)
        elif line.strip() and markers:
            raise Fault(f"{path}:{number}: a marker must stand right before its block")
    if inside is not None:
        raise Fault(f"{path}:{inside.line}: the block does not end")
    return blocks


def check_messages(path, blocks):
    """After a block that must fail stands the message that it ends with: else a failure of another kind would pass."""
    for block, after in zip(blocks, [*blocks[1:], None]):
        if block.run == "fails" and (after is None or after.language != "console" or after.run is not None):
            raise Fault(f"{path}:{block.line}: a console block with the message must follow a block that fails")


def notebook_blocks(path):
    """The code cells of a Jupyter notebook as one program, and the text that it stores as their output."""
    cells = [cell for cell in json.loads(path.read_text(encoding="utf-8"))["cells"] if cell["cell_type"] == "code"]
    printed = ["".join(output["text"]) for cell in cells for output in cell["outputs"] if output["output_type"] == "stream"]
    program = "\n".join("".join(cell["source"]) for cell in cells)
    return [Block(1, "python", program, run="needs insonify"), Block(1, "console", "".join(printed))]


def execute(command, folder, environment):
    """Exit status and output; no input, and nothing outlives its time."""
    try:
        done = subprocess.run(command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, timeout=SECONDS_PER_BLOCK, check=False)
        return done.returncode, done.stdout.decode(errors="replace")
    except subprocess.TimeoutExpired:
        return 124, f"took longer than {SECONDS_PER_BLOCK} s"


def check_excerpt(block, root):
    """The lines of a block that shows a file must be in it."""
    path = root / block.source
    if not path.is_file():
        raise Fault(f"from: there is no {block.source}")
    # "# ..." in a program stands for omitted lines, too.
    shown = re.sub(r"(?m)^\s*# \.\.\.$", "...", block.text)
    lines = [line for line in path.read_text(encoding="utf-8").splitlines() if line.strip()]
    wrong = mismatch("...\n" + "\n".join(line for line in shown.splitlines() if line.strip()), "\n".join(lines))
    if wrong is not None:
        raise Fault(f"this line is not in {block.source}, or not there: {wrong}")


def is_there(name, environment):
    """Whether Python can import a module, or a program is there: a name with a dash is a program's."""
    if "-" in name:
        return shutil.which(name, path=environment["PATH"]) is not None
    return execute([sys.executable, "-c", f"import {name}"], None, environment)[0] == 0


def run_block(block, folder, arguments, environment):
    """Runs one block. Returns its exit status and output, or None if it is only shown."""
    if block.run is not None and block.run.startswith("no"):
        if not re.fullmatch(r"no \(.+\)", block.run):
            raise Fault("run: no must tell why, as in <!-- run: no (needs a network) -->")
        return None
    needed = re.fullmatch(r"needs ([\w.-]+)", block.run or "")
    if needed and not is_there(needed.group(1), environment):
        print(f"  only shown: a block that needs {needed.group(1)}")
        return None
    if block.run == PICTURES_ONLY and not arguments.images:
        return None
    if block.run not in (None, "fails", PICTURES_ONLY) and not needed:
        raise Fault(f"run: {block.run} must be no (REASON), fails, {PICTURES_ONLY} or needs MODULE")
    if block.file is not None:
        file = folder / block.file
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(block.text, encoding="utf-8")
    if block.language == "cpp":
        source = folder / (block.file or f"block_{block.line}.cpp")
        source.write_text(block.text, encoding="utf-8")
        program = source.with_suffix("")
        status, output = execute([*arguments.compile.split(), "-o", program, source, *arguments.link.split()], folder,
                                 environment)
        return (status, output) if status != 0 else execute([program], folder, environment)
    if block.file is not None:
        return None
    if block.language == "bash":
        return execute(["bash", "-euo", "pipefail", "-c", block.text], folder, environment)
    if block.language == "python":
        return execute([sys.executable, "-c", block.text], folder, environment)
    return None


def mismatch(shown, printed):
    """First line of the shown text that is not where it should be in what was printed; None where all are."""
    lines = [TIME.sub("#", line.rstrip()) for line in printed.splitlines()]
    free, at = True, 0  # Whether the next line may come later than right after the one before.
    for line in shown.splitlines():
        if line.strip() == "...":
            free = True
            continue
        wanted = TIME.sub("#", line.rstrip())
        candidates = range(at, len(lines)) if free else range(at, min(at + 1, len(lines)))
        found = next((i for i in candidates if lines[i] == wanted), None)
        if found is None:
            return line
        free, at = False, found + 1
    return None


def take_images(path, folder, replace):
    """Demands the pictures that the page says its blocks make; copies them to where the page shows them if asked to."""
    page = path.read_text(encoding="utf-8")
    for number, line in enumerate(page.splitlines(), start=1):
        marker = IMAGE.match(line)
        if not marker:
            continue
        shown, made = marker.group(1), folder / marker.group(2)
        if f"]({shown})" not in page:
            raise Fault(f"{path}:{number}: the page does not show {shown}")
        if not made.is_file():
            raise Fault(f"{path}:{number}: no block made {marker.group(2)}")
        if replace:
            shutil.copyfile(made, path.parent / shown)


def run_document(path, arguments):
    """Runs all blocks of one file; returns how many ran."""
    root = pathlib.Path(__file__).resolve().parent.parent
    build = pathlib.Path(arguments.build).resolve()
    count = 0
    with tempfile.TemporaryDirectory(prefix="insonify_docs_") as name:
        folder = pathlib.Path(name)
        for shared in ("scenes", "presets", "examples"):
            (folder / shared).symlink_to(root / shared)
        (folder / "build").mkdir()
        (folder / "build/release").symlink_to(build)
        (folder / ".bin").mkdir()
        (folder / ".bin/python3").symlink_to(sys.executable)
        environment = dict(os.environ, PATH=f"{build}:{build}/bin:{folder}/.bin:{os.environ['PATH']}", TMPDIR=name,
                           PYTHONPATH=str(build / "python"), PYTHONDONTWRITEBYTECODE="1", MPLBACKEND="Agg")
        output, all_ran = None, True
        blocks = notebook_blocks(path) if path.suffix == ".ipynb" else blocks_of(path)
        check_messages(path, blocks)
        for block in blocks:
            if block.source is not None:
                try:
                    check_excerpt(block, root)
                except Fault as fault:
                    raise Fault(f"{path}:{block.line}: {fault}") from fault
                continue
            if block.language == "console" and block.run is None:
                if not all_ran:
                    continue
                if output is None:
                    raise Fault(f"{path}:{block.line}: nothing ran before this block")
                wrong = mismatch(block.text, output)
                if wrong is not None:
                    raise Fault(f"{path}:{block.line}: this line was not printed there: {wrong}\n{output}")
                continue
            try:
                result = run_block(block, folder, arguments, environment)
            except Fault as fault:
                raise Fault(f"{path}:{block.line}: {fault}") from fault
            if result is None:
                all_ran = all_ran and not (block.run or "").startswith(("needs", PICTURES_ONLY))
                continue
            count += 1
            status, output = result
            if (status != 0) != (block.run == "fails"):
                wanted = "should have failed" if status == 0 else f"failed with status {status}"
                raise Fault(f"{path}:{block.line}: the block {wanted}\n{block.text}\n{output}")
        if all_ran:
            take_images(path, folder, arguments.images)
    return count


def main():
    parser = argparse.ArgumentParser(description="Runs the code blocks of Markdown files.")
    parser.add_argument("--build", required=True, help="build folder with the command line in it")
    parser.add_argument("--compile", default="c++ -std=c++20", help="compiles a program, with what finds the headers")
    parser.add_argument("--link", default="", help="what a program is linked with")
    parser.add_argument("--images", action="store_true", help="replace the pictures that the pages show")
    parser.add_argument("files", nargs="+", type=pathlib.Path)
    arguments = parser.parse_args()
    try:
        for path in arguments.files:
            print(f"{path}: {run_document(path, arguments)} blocks ran")
    except Fault as fault:
        print(fault)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
