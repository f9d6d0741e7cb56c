"""laws_in_shaders_test.py -- the headers of src/echo/laws are GLSL too: glslc compiles each of their functions.

    laws_in_shaders_test.py SOURCE_DIR

Exit status 77, with the reason, where glslc is not installed.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import unittest

SOURCES = pathlib.Path(sys.argv.pop(1)) / "src"
LAWS = SOURCES / "echo/laws"
FUNCTION = re.compile(r"^LAW (\w+) (\w+)\(([^)]*)\) {", re.MULTILINE)

# What C++ reads the laws through.
FOR_CPP = {"all.h", "laws.h"}

# What a shader includes with Real as double, where it needs it.
IN_DOUBLES = ["echo/laws/window_rung.h"]


def ordered_headers():
    """The headers that all.h names, after those that they use; the first is the prelude."""
    return re.findall(r'#include "(echo/laws/\w+\.h)"', (LAWS / "all.h").read_text())


def functions_of(header):
    """(result type, name, [argument types]) of each law in a header."""
    found = FUNCTION.findall((SOURCES / header).read_text())
    return [(result, name, [argument.split()[0] for argument in arguments.split(",")]) for result, name, arguments in found]


def shader(headers, functions):
    """A compute shader that includes the headers and calls the functions with values from a buffer."""
    fields, calls = [], []
    for number, (result, name, types) in enumerate(functions):
        arguments = [f"a{number}_{i}" for i in range(len(types))]
        fields += [f"  {kind} {argument};" for kind, argument in zip(types, arguments)] + [f"  {result} result{number};"]
        calls.append(f"  result{number} = {name}({', '.join(arguments)});")
    includes = [f'#include "{header}"' for header in headers]
    return "\n".join(["#version 450", *includes, "layout(local_size_x = 1) in;", "layout(std430, binding = 0) buffer Values {",
                      *fields, "};", "void main() {", *calls, "}", ""])


def errors_of(text):
    """What glslc says of a compute shader, empty where it compiles."""
    done = subprocess.run(["glslc", "-Werror", "--target-env=vulkan1.3", "-fshader-stage=compute", f"-I{SOURCES}", "-o", "/dev/null", "-"],
                          input=text, capture_output=True, text=True)
    return done.stderr or ("" if done.returncode == 0 else f"status {done.returncode}")


class LawsInShadersTest(unittest.TestCase):
    def test_every_header_is_among_all_of_them(self):
        headers = {path.name for path in LAWS.glob("*.h")} - FOR_CPP
        self.assertEqual(headers, {pathlib.Path(header).name for header in ordered_headers()})

    def test_each_header_compiles_after_those_before_it(self):
        headers = ordered_headers()
        for last in range(1, len(headers)):
            functions = functions_of(headers[last])
            with self.subTest(header=headers[last]):
                self.assertEqual(len(functions), (SOURCES / headers[last]).read_text().count("LAW "))
                self.assertEqual(errors_of(shader(headers[: last + 1], functions)), "")

    def test_a_shader_includes_all_of_them_at_once(self):
        headers = [header for header in ordered_headers()[1:] if header not in IN_DOUBLES]
        functions = [function for header in headers for function in functions_of(header)]
        self.assertEqual(errors_of(shader(["echo/laws/all.h"], functions)), "")

    def test_what_is_not_in_the_common_subset_is_found(self):
        for wrong in ("float f() { return std::sqrt(2.0); }", "float f(const float& x) { return x; }", "struct S { float x = 0; };"):
            with self.subTest(wrong=wrong):
                self.assertIn("error", errors_of(shader(["echo/laws/prelude.h"], []).replace("void main", f"{wrong}\nvoid main")))


if __name__ == "__main__":
    if shutil.which("glslc") is None:
        print("Skipped: glslc is not installed")
        sys.exit(77)
    unittest.main()
