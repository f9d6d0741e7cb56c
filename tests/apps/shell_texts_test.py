#!/usr/bin/python3
"""Shells complete insonify's command line, and man shows its page: shell_texts_test.py BUILD.

Each shell that is installed loads the script that the build made, and is asked for what may follow some words; of the
shells bash must be there.
"""

import os
import pathlib
import pty
import select
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
BASH = BUILD / "share/bash-completion/completions/insonify"
ZSH = BUILD / "share/zsh/site-functions/_insonify"
FISH = BUILD / "share/fish/vendor_completions.d/insonify.fish"
PAGE = BUILD / "share/man/man1/insonify.1"
COMMANDS = {"run", "serve", "emulate", "bridge", "draw", "replay", "info", "export", "mosaic", "grid", "scenes", "sonars", "describe", "compare", "survey", "bench",
            "version", "completion", "manual"}
ENVIRONMENT = {**os.environ, "PATH": f"{BUILD}:{os.environ['PATH']}"}


def output(*command, folder=None):
    done = subprocess.run(command, cwd=folder, env=ENVIRONMENT, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          timeout=60, check=False)
    if done.returncode != 0 or done.stderr:
        raise AssertionError(f"{command}: status {done.returncode}\n{done.stderr}")
    return done.stdout


def bash(*words, folder=None):
    """What bash suggests for the last of the words."""
    script = f'source "{BASH}" && complete -p insonify >/dev/null && COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) && ' \
             '_insonify && printf "%s\\n" "${COMPREPLY[@]}"'
    return set(output("bash", "--norc", "-c", script, "bash", *words, folder=folder).split())


def fish(line):
    text = output("fish", "--no-config", "-c", f'source "{FISH}"; complete -C "{line}"')
    return {row.split("\t")[0] for row in text.splitlines()}


def zsh(line):
    """What an interactive zsh shows, in a terminal of its own, when TAB is pressed twice after `line`."""
    child, terminal = pty.fork()
    if child == 0:
        os.environ.update(ENVIRONMENT, TERM="dumb", PS1="READY>", COLUMNS="200")
        os.execvp("zsh", ["zsh", "-f", "-i"])

    unread = ""

    def wait_for(text, seconds=60):
        """What the terminal shows up to `text`."""
        nonlocal unread
        end = time.monotonic() + seconds
        while text not in unread and time.monotonic() < end:
            if select.select([terminal], [], [], 0.1)[0]:
                unread += os.read(terminal, 65536).decode(errors="replace")
        before, _, unread = unread.partition(text)
        return before

    wait_for("READY>")
    setup = f"fpath=({ZSH.parent} $fpath); autoload -Uz compinit; compinit -u -D; zstyle ':completion:*' verbose no; echo LOA''DED"
    os.write(terminal, f"{setup}\n".encode())
    wait_for("LOADED")
    wait_for("READY>")
    os.write(terminal, f"{line}\t\t\x15echo DO''NE\n".encode())  # Control-U takes the line away again.
    seen = wait_for("DONE")
    os.close(terminal)
    os.waitpid(child, 0)
    return set(seen.replace(line, "", 1).split())


class BashCompletion(unittest.TestCase):
    def test_suggests_commands(self):
        self.assertEqual(bash("insonify", ""), COMMANDS)
        self.assertEqual(bash("insonify", "com"), {"compare", "completion"})
        self.assertEqual(bash("insonify", "bench", ""), {"engine", "paper", "primary", "batch", "survey", "device", "changes", "sampling",
                                                          "growth"})

    def test_suggests_the_options_of_the_command(self):
        self.assertEqual(bash("insonify", "run", "--no-"), {"--no-pictures", "--no-view"})
        self.assertEqual(bash("insonify", "bench", "engine", "--tr"), {"--triangles"})

    def test_suggests_what_an_option_takes(self):
        self.assertLessEqual({"auto", "cpu", "gpu", "reference"}, bash("insonify", "run", "--engine", ""))
        self.assertEqual(bash("insonify", "compare", "a.h5", "b.h5", "--scale", "d"), {"db"})
        self.assertEqual(bash("insonify", "run", "--pings", ""), set())

    def test_suggests_files_and_folders(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "fan.yaml").touch()
            (pathlib.Path(folder) / "out").mkdir()
            self.assertEqual(bash("insonify", "run", "f", folder=folder), {"fan.yaml"})
            self.assertEqual(bash("insonify", "run", "fan.yaml", "-o", "", folder=folder), {"out"})

    def test_suggests_presets_and_sections(self):
        self.assertEqual(bash("insonify", "sonars", "tritech-micron"), {"tritech-micron-dst"})
        self.assertEqual(bash("insonify", "describe", "wa"), {"water"})
        self.assertEqual(bash("insonify", "completion", ""), {"bash", "zsh", "fish"})


@unittest.skipUnless(shutil.which("fish"), "fish is not installed")
class FishCompletion(unittest.TestCase):
    def test_suggests_commands_options_and_values(self):
        self.assertEqual(fish("insonify "), COMMANDS)
        self.assertEqual(fish("insonify bench "), {"engine", "paper", "primary", "batch", "survey", "device", "changes", "sampling",
                                                          "growth"})
        self.assertEqual(fish("insonify run --no-"), {"--no-pictures", "--no-view"})
        self.assertEqual(fish("insonify run --engine "), {"auto", "cpu", "gpu", "reference"})
        self.assertEqual(fish("insonify sonars tritech-micron"), {"tritech-micron-dst"})


@unittest.skipUnless(shutil.which("zsh"), "zsh is not installed")
class ZshCompletion(unittest.TestCase):
    def test_suggests_commands_options_and_values(self):
        self.assertLessEqual(COMMANDS, zsh("insonify "))
        self.assertLessEqual({"engine", "paper", "primary", "batch", "changes", "sampling", "growth"}, zsh("insonify bench "))
        self.assertLessEqual({"--no-pictures", "--no-view"}, zsh("insonify run --no-"))
        self.assertLessEqual({"auto", "cpu", "reference"}, zsh("insonify run --engine "))
        self.assertLessEqual({"tritech-gemini-720i", "tritech-gemini-720is"}, zsh("insonify sonars tritech-gemini-"))


class ManualPage(unittest.TestCase):
    @unittest.skipUnless(shutil.which("groff"), "groff is not installed")
    def test_is_set_without_a_warning(self):
        text = output("groff", "-man", "-ww", "-Tascii", "-P-cbou", str(PAGE))
        for part in ("NAME\n", "insonify run [OPTIONS] SCENARIO", "--engine NAME", "insonify bench engine", "EXIT STATUS"):
            self.assertIn(part, text)

    def test_names_every_command_and_option_of_the_help(self):
        text = PAGE.read_text(encoding="utf-8").replace("\\-", "-")
        for command in COMMANDS - {"bench", "survey"} | {"survey plan"}:
            self.assertIn(f".SS insonify {command} ", text)
            for word in output(str(BUILD / "insonify"), *command.split(), "--help").replace(",", " ").split():
                if word.startswith("--") and len(word) > 2:
                    self.assertIn(word, text)


if __name__ == "__main__":
    unittest.main()
