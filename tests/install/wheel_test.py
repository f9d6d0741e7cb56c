"""wheel_test.py -- what `./dev wheel` rests on: names of copied libraries, and wheels that `pip` takes; of small made-up trees."""

import base64
import csv
import hashlib
import pathlib
import subprocess
import sys
import tempfile
import unittest
import zipfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools/wheel"))
import bundle
import make_wheel


class WheelTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def wheel(self):
        tree = self.folder / "tree"
        (tree / "bin").mkdir(parents=True)
        program = tree / "bin/insonify"
        program.write_text("#!/bin/sh\n")
        program.chmod(0o755)
        (tree / "data, with a comma").write_text("1")
        path = self.folder / "insonify-1.2-cp311-cp311-manylinux_2_36_x86_64.whl"
        make_wheel.write_wheel(path, {"insonify_files": tree}, "insonify-1.2.dist-info", {"METADATA": "Name: insonify\n"})
        return path

    def test_record_has_a_digest_of_each_file(self):
        with zipfile.ZipFile(self.wheel()) as wheel:
            record = wheel.read("insonify-1.2.dist-info/RECORD").decode()
            rows = {row[0]: row[1:] for row in csv.reader(record.splitlines())}
            self.assertEqual(set(rows), set(wheel.namelist()))
            for name, (digest, size) in rows.items():
                if name.endswith("/RECORD"):
                    self.assertEqual((digest, size), ("", ""))
                    continue
                content = wheel.read(name)
                expected = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
                self.assertEqual((digest, size), (f"sha256={expected}", str(len(content))))

    def test_programs_stay_programs(self):
        with zipfile.ZipFile(self.wheel()) as wheel:
            modes = {entry.filename: entry.external_attr >> 16 & 0o777 for entry in wheel.infolist()}
        self.assertEqual(modes["insonify_files/bin/insonify"], 0o755)
        self.assertEqual(modes["insonify_files/data, with a comma"], 0o644)

    def test_the_same_files_give_the_same_wheel(self):
        first = self.wheel().read_bytes()
        self.setUp()
        self.assertEqual(self.wheel().read_bytes(), first)

    def test_metadata_is_that_of_pyproject(self):
        project = make_wheel.tomllib.loads((make_wheel.SOURCES / "pyproject.toml").read_text())["project"]
        text = make_wheel.metadata(project, "1.2", "3.11")
        head = text[:text.index("\n\n")].splitlines()
        for line in ("Name: insonify", "Version: 1.2", "Requires-Python: ==3.11.*", "Requires-Dist: numpy",
                     "Requires-Dist: matplotlib; extra == 'plot'"):
            self.assertIn(line, head)
        self.assertIn("\n# insonify\n", text)

    def test_copied_libraries_have_names_of_their_own(self):
        library = self.folder / "libz.so.1.2.13"
        library.write_bytes(b"abc")  # sha256: ba7816bf 8f01cfea ...
        self.assertEqual(bundle.own_name("libz.so.1", library), "libz-ba7816bf.so.1")

    def test_the_system_keeps_the_libraries_of_its_compiler(self):
        needed = bundle.libraries_of([pathlib.Path(sys.executable).resolve()], set())
        self.assertFalse([name for name in needed if name.startswith(("libc.", "libm.", "libstdc++", "ld-linux"))])

    def test_the_stand_in_has_what_is_asked_for_under_its_version(self):
        code = self.folder / "user.c"
        code.write_text("int curl_easy_init(void); int use(void) { return curl_easy_init(); }\n")
        real, versions = self.folder / "libcurl.so.4", self.folder / "v"
        (self.folder / "real.c").write_text("int curl_easy_init(void) { return 1; }\n")
        versions.write_text("CURL_OPENSSL_4 { curl_easy_init; };\n")
        user, stand_in = self.folder / "libuser.so", self.folder / bundle.STAND_IN
        subprocess.run(["gcc", "-shared", "-fPIC", self.folder / "real.c", f"-Wl,--version-script={versions}", "-o", real], check=True)
        subprocess.run(["gcc", "-shared", "-fPIC", code, real, "-o", user], check=True)
        bundle.make_stand_in(stand_in, [user])
        self.assertIn("curl_easy_init@@CURL_OPENSSL_4", bundle.output_of("nm", "-D", stand_in))


if __name__ == "__main__":
    unittest.main()
