"""Type stubs of the Python package: they are those of the module, and mypy finds nothing in them and in the examples.

    PYTHONPATH=build/dev/python tests/python/types_test.py SOURCE_FOLDER
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import insonify

SOURCES = pathlib.Path()
PACKAGE = pathlib.Path(insonify.__file__).parent
SKIPPED = 77

# What stubtest cannot know of classes made by pybind11: their metaclass, and that some cannot be constructed.
FROM_PYBIND = re.compile(r"is inconsistent, metaclass differs$|__init__ is inconsistent, stub does not have \*args")
# Modules of the package that are its own matter.
INTERNAL = re.compile(r"^error: insonify\._(calls|catalogue|compare|layers|levels|pictures|plot|pose|scene)\b")


def run(*command, folder=None):
    environment = dict(os.environ, MYPYPATH=str(PACKAGE.parent), PYTHONPATH=str(PACKAGE.parent))
    return subprocess.run(command, capture_output=True, text=True, cwd=folder, env=environment)


class TypesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        # One for all runs: NumPy's types are analysed once. Runs of other options than --strict could not use it.
        cache = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cache.cleanup)
        cls.strict_mypy = ("/usr/bin/mypy", "--strict", f"--cache-dir={cache.name}")

    def test_stubs_are_those_that_the_module_gives(self):
        with tempfile.TemporaryDirectory() as folder:
            done = run(sys.executable, SOURCES / "tools/make_python_stubs.py", SOURCES / "python/stubs", folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            made = sorted(pathlib.Path(folder).glob("*.pyi"))
            self.assertEqual([path.name for path in made], ["__init__.pyi", "acoustics.pyi", "similarity.pyi", "survey.pyi"])
            for path in made:
                self.assertEqual(path.read_text(), (PACKAGE / "_insonify" / path.name).read_text(), path.name)
        self.assertTrue((PACKAGE / "py.typed").exists())

    def test_every_public_name_and_attribute_is_in_them(self):
        # stubtest looks for attributes of classes in both; names of modules it compares by __all__, which ours lack.
        for module, stub in ((insonify._insonify, "__init__"), (insonify.acoustics, "acoustics"),
                             (insonify.similarity, "similarity"), (insonify.survey, "survey")):
            text = (PACKAGE / f"_insonify/{stub}.pyi").read_text()
            for name in vars(module):
                if not name.startswith("_"):
                    self.assertRegex(text, rf"(?m)^(def|class) {name}\b|^{name}:|import {name}\b", name)
        done = run("/usr/bin/stubtest", "insonify")
        wrong = [line for line in done.stdout.splitlines()
                 if line.startswith("error:") and not FROM_PYBIND.search(line) and not INTERNAL.match(line)]
        self.assertEqual(wrong, [])
        self.assertIn("insonify.SonarConfig", done.stdout)  # It has looked: there are the metaclasses at least.

    def test_mypy_finds_nothing(self):
        done = run(*self.strict_mypy, "-p", "insonify")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        examples = sorted((SOURCES / "examples/python").glob("*.py"))
        self.assertGreater(len(examples), 5)
        done = run(*self.strict_mypy, *examples)
        # Whether other libraries have types, and so whether a line must be ignored, differs from version to version of them.
        wrong = [line for line in done.stdout.splitlines() if "error: " in line and "[unused-ignore]" not in line]
        self.assertEqual((wrong, done.stderr), ([], ""))

    def test_mypy_finds_what_is_wrong(self):
        with tempfile.TemporaryDirectory() as folder:
            program = pathlib.Path(folder, "wrong.py")
            program.write_text("import insonify\n"
                               "insonify.SonarConfig(max_range='far')\n"
                               "insonify.SonarConfig().max_rnage\n"
                               "insonify.SonarConfig(type='flx')\n"
                               "x: str = insonify.acoustics.sphere_cross_section(0.5)\n"
                               "y: float = insonify.acoustics.sphere_cross_section(0.5)\n"
                               "insonify.export('a.h5', 'a.npz', replace=True, levels=(-90, -40), color_map='grey')\n"
                               "insonify.export('a.h5', 'a.npz', force=True)\n")
            done = run(*self.strict_mypy, program)
            self.assertEqual([int(line.split(":")[1]) for line in done.stdout.splitlines() if "error:" in line], [2, 3, 4, 5, 8],
                             done.stdout)


if __name__ == "__main__":
    if not pathlib.Path("/usr/bin/mypy").exists() or not pathlib.Path("/usr/bin/stubtest").exists():
        print("Skipped: there is no mypy (Debian's package of that name)")
        sys.exit(SKIPPED)
    SOURCES = pathlib.Path(sys.argv[1]).resolve()
    unittest.main(argv=sys.argv[:1])
