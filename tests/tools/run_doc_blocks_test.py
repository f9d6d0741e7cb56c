"""The runner of documentation blocks runs what it should, and notices what fails."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

RUNNER = pathlib.Path(__file__).resolve().parents[2] / "tools/run_doc_blocks.py"


def run_in(folder, text, *options, name="page.md"):
    """Exit status and output of the runner on a document, with the document's name taken out."""
    document = pathlib.Path(folder) / name
    document.write_text(text, encoding="utf-8")
    done = subprocess.run([sys.executable, RUNNER, "--build", folder, *options, document], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, check=False)
    return done.returncode, done.stdout.decode().replace(f"{folder}/", "")


def run(text):
    with tempfile.TemporaryDirectory() as folder:
        return run_in(folder, text)


def block(language, text, marker=""):
    return f"{marker}\n```{language}\n{text}\n```\n\n"


class RunDocBlocksTest(unittest.TestCase):
    def test_blocks_of_a_page_share_a_folder_and_run_in_order(self):
        page = block("bash", "echo 7 > number") + block("python", "assert open('number').read() == '7\\n'")
        self.assertEqual(run(page), (0, "page.md: 2 blocks ran\n"))

    def test_a_file_block_is_written_and_not_run(self):
        page = block("yaml", "depth: 3", "<!-- file: a/b.yaml -->") + block("bash", "grep -x 'depth: 3' a/b.yaml")
        self.assertEqual(run(page), (0, "page.md: 1 blocks ran\n"))

    def test_a_bash_block_stops_at_its_first_failure(self):
        status, output = run("Text.\n" + block("bash", "false\ntrue"))
        self.assertEqual(status, 1)
        self.assertIn("page.md:3: the block failed with status 1\n", output)

    def test_a_program_is_compiled_and_run(self):
        self.assertEqual(run(block("cpp", "int main() {}")), (0, "page.md: 1 blocks ran\n"))
        self.assertEqual(run(block("cpp", "int main() { return 3; }"))[0], 1)
        self.assertEqual(run(block("cpp", "no C++"))[0], 1)

    def test_a_block_that_must_fail_must_fail(self):
        message = block("console", "no such sonar")
        self.assertEqual(run(block("bash", "echo no such sonar; exit 2", "<!-- run: fails -->") + message)[0], 0)
        status, output = run(block("bash", "true", "<!-- run: fails -->") + message)
        self.assertEqual(status, 1)
        self.assertIn("page.md:2: the block should have failed\n", output)

    def test_a_block_that_must_fail_must_say_what_the_page_shows(self):
        fails = block("bash", "echo no such sonar; exit 2", "<!-- run: fails -->")
        status, output = run(fails + block("console", "no such range"))
        self.assertEqual(status, 1)
        self.assertIn("page.md:7: this line was not printed there: no such range\n", output)
        fault = "page.md:2: a console block with the message must follow a block that fails\n"
        for after in ("", block("bash", "true"), block("console", "no such sonar", "<!-- run: no (a test) -->")):
            self.assertEqual(run(fails + after), (1, fault))

    def test_other_languages_and_skipped_blocks_are_shown_only(self):
        page = block("", "./no-such-thing") + block("json", "{") + block("bash", "exit 2", "<!-- run: no (a test) -->")
        self.assertEqual(run(page), (0, "page.md: 0 blocks ran\n"))

    def test_a_block_that_needs_a_module_is_run_where_it_is(self):
        page = block("python", "print(3)", "<!-- run: needs json -->") + block("console", "3")
        self.assertEqual(run(page), (0, "page.md: 1 blocks ran\n"))
        self.assertEqual(run(block("python", "1/0", "<!-- run: needs json -->"))[0], 1)
        page = block("python", "1/0", "<!-- run: needs no_such_module -->") + block("console", "3")
        self.assertEqual(run(page), (0, "  only shown: a block that needs no_such_module\npage.md: 0 blocks ran\n"))

    def test_a_block_that_needs_a_program_is_run_where_it_is(self):
        with tempfile.TemporaryDirectory() as folder:
            program = pathlib.Path(folder) / "bin/sonar-tool"
            program.parent.mkdir()
            program.write_text("#!/bin/sh\necho 3\n", encoding="utf-8")
            program.chmod(0o755)
            page = block("bash", "sonar-tool", "<!-- run: needs sonar-tool -->") + block("console", "3")
            self.assertEqual(run_in(folder, page), (0, "page.md: 1 blocks ran\n"))
        self.assertEqual(run(page), (0, "  only shown: a block that needs sonar-tool\npage.md: 0 blocks ran\n"))
        self.assertIn("run: sometimes must be", run(block("bash", "true", "<!-- run: sometimes -->"))[1])

    def test_an_excerpt_is_what_the_file_has(self):
        marker = "<!-- from: tests/tools/run_doc_blocks_test.py -->"
        page = block("python", "import pathlib\nimport subprocess\n\n# ...\ndef run(text):", marker)
        self.assertEqual(run(page), (0, "page.md: 0 blocks ran\n"))
        for wrong in ("import pathlib\nimport sys", "import sys\n...\nimport pathlib", "import  pathlib"):
            status, output = run(block("python", wrong, marker))
            self.assertEqual(status, 1, wrong)
            self.assertIn("page.md:2: this line is not in tests/tools/run_doc_blocks_test.py, or not there: ", output)
        self.assertIn("from: there is no no.py", run(block("python", "a", "<!-- from: no.py -->"))[1])

    def test_python3_finds_the_package_of_the_build(self):
        self.assertEqual(run(block("bash", 'test "$PYTHONPATH" = "$(readlink -f build/release)/python"; python3 -c ""'))[0], 0)

    def test_skipping_needs_a_reason(self):
        status, output = run(block("bash", "exit 2", "<!-- run: no -->"))
        self.assertEqual(status, 1)
        self.assertIn("run: no must tell why", output)

    def test_a_console_block_is_what_was_printed(self):
        made = block("bash", "printf 'a 1\\nb 2\\nc 3\\nd in 0.52 s\\n'")
        for shown in ("a 1\nb 2", "b 2\nc 3", "a 1\n...\nd in 7 s", "..."):
            self.assertEqual(run(made + block("console", shown)), (0, "page.md: 1 blocks ran\n"), shown)
        for shown, wrong in (("a 2", "a 2"), ("a 1\nc 3", "c 3"), ("b 2\n...\na 1", "a 1"), ("d in 0.52 m", "d in 0.52 m")):
            status, output = run(made + block("console", shown))
            self.assertEqual(status, 1, shown)
            self.assertIn(f": this line was not printed there: {wrong}\n", output)

    def test_a_console_block_needs_a_block_that_ran(self):
        status, output = run(block("console", "a"))
        self.assertEqual((status, output), (1, "page.md:2: nothing ran before this block\n"))

    def test_a_notebook_is_one_program_and_prints_what_it_stores(self):
        def cell(source, printed=()):
            return {"cell_type": "code", "source": [source], "outputs": [{"output_type": "stream", "text": [one]} for one in printed]}

        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "python").mkdir()
            (pathlib.Path(folder) / "python/insonify.py").touch()
            cells = [{"cell_type": "markdown", "source": ["# Text"]}, cell("x = 3"), cell("print(x)\nx", ["3\n"]),
                     cell("print(x + 1)", ["4\n"])]
            self.assertEqual(run_in(folder, json.dumps({"cells": cells}), name="a.ipynb"), (0, "a.ipynb: 1 blocks ran\n"))
            cells[-1] = cell("print(x + 1)", ["5\n"])
            status, output = run_in(folder, json.dumps({"cells": cells}), name="a.ipynb")
            self.assertEqual((status, output.splitlines()[0]), (1, "a.ipynb:1: this line was not printed there: 5"))

    def test_pictures_are_replaced_only_when_asked_for(self):
        page = "<!-- image: a.png = out/b.png -->\n![A](a.png)\n\n" + block("bash", "mkdir out; echo new > out/b.png")
        with tempfile.TemporaryDirectory() as folder:
            picture = pathlib.Path(folder) / "a.png"
            picture.write_text("old\n", encoding="utf-8")
            self.assertEqual(run_in(folder, page), (0, "page.md: 1 blocks ran\n"))
            self.assertEqual(picture.read_text(encoding="utf-8"), "old\n")
            self.assertEqual(run_in(folder, page, "--images"), (0, "page.md: 1 blocks ran\n"))
            self.assertEqual(picture.read_text(encoding="utf-8"), "new\n")

    def test_a_block_may_make_pictures_alone(self):
        page = "<!-- image: a.png = b.png -->\n![A](a.png)\n\n" + block("bash", "echo new > b.png", "<!-- run: with --images -->")
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(run_in(folder, page), (0, "page.md: 0 blocks ran\n"))
            self.assertEqual(run_in(folder, page, "--images"), (0, "page.md: 1 blocks ran\n"))
            self.assertEqual((pathlib.Path(folder) / "a.png").read_text(encoding="utf-8"), "new\n")

    def test_pictures_must_be_made_and_shown(self):
        marker = "Text.\n<!-- image: a.png = b.png -->\n"
        self.assertEqual(run(marker + "![A](a.png)\n"), (1, "page.md:2: no block made b.png\n"))
        self.assertEqual(run(marker + block("bash", "touch b.png")), (1, "page.md:2: the page does not show a.png\n"))

    def test_a_marker_without_a_block_is_a_fault(self):
        status, output = run("<!-- run: fails -->\nText.\n")
        self.assertEqual((status, output), (1, "page.md:2: a marker must stand right before its block\n"))

    def test_a_block_without_end_is_a_fault(self):
        self.assertEqual(run("```bash\ntrue\n"), (1, "page.md:1: the block does not end\n"))

    def test_a_block_may_show_blocks(self):
        self.assertEqual(run("````text\n" + block("bash", "exit 2") + "````\n"), (0, "page.md: 0 blocks ran\n"))

    def test_indented_blocks_lose_their_indent(self):
        self.assertEqual(run("1. Item\n\n   ```python\n   x = 1\n   ```\n"), (0, "page.md: 1 blocks ran\n"))


if __name__ == "__main__":
    unittest.main()
