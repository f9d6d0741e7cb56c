"""make_wheel.py -- puts wheels and a portable archive together from a built tree, without the network:

    python3 tools/wheel/make_wheel.py build/release build/wheel [VERSION...]

in the second folder: insonify-0.2.0-linux-x86_64.tar.gz and a wheel for each Python VERSION, such as 3.11, whose module was built
(target insonify_wheel_module_311). See bundle.py for what they carry.
"""

import base64
import csv
import hashlib
import io
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile
import tomllib
import zipfile

from bundle import bundle, floor_of, is_binary, redirect
from licences import write_licences

SOURCES = pathlib.Path(__file__).resolve().parents[2]
GLIBC, GLIBCXX = (2, 36), (3, 4, 30)  # Debian 12's, on which it is built.
PLATFORM = "manylinux_2_{}_x86_64".format(GLIBC[1])
TREE = "insonify_files"
SEARCH_PATHS = {"lib": "$ORIGIN", "bin": "$ORIGIN/../lib", "libexec/insonify": "$ORIGIN/../../lib"}
LONG_AGO = (1980, 1, 1, 0, 0, 0)  # The same files give the same wheel.


def install(build, folder, component):
    subprocess.run(["cmake", "--install", build, "--prefix", folder, "--component", component, "--strip"], check=True,
                   stdout=subprocess.DEVNULL)


def make_tree(build, tree):
    """The installed tree with its libraries; returns the names and paths of those."""
    for component in ("library", "tools"):
        install(build, tree, component)
    for link in [file for file in tree.rglob("*") if file.is_symlink()]:  # A wheel holds no links.
        target = link.resolve()
        link.unlink()
        if link.name.count(".") == 3:  # libinsonify.so.0.2, the name by which it is loaded.
            target.rename(link)
    libraries = bundle(tree, SEARCH_PATHS)
    binaries = [file for file in tree.rglob("*") if is_binary(file)]
    for prefix, limit in (("GLIBC_", GLIBC), ("GLIBCXX_", GLIBCXX)):
        if floor_of(binaries, prefix) > limit:
            raise SystemExit(f"The libraries need {prefix}{floor_of(binaries, prefix)}, more than {limit}")
    write_licences(tree / "share/doc/insonify/licences", libraries, [
        "glibc (2.{} or newer)".format(floor_of(binaries, "GLIBC_")[1]),
        "libstdc++ and libgcc (of GCC 12 or newer)"])
    shutil.copyfile(SOURCES / "LICENSE", tree / "share/doc/insonify/licences/LICENSE")
    return libraries


def refuse_paths(folder):
    """No file names a folder of this machine."""
    for file in folder.rglob("*"):
        if file.is_file() and str(SOURCES).encode() in file.read_bytes():
            raise SystemExit(f"{file} names {SOURCES}")


def metadata(project, version, python):
    """METADATA, from pyproject.toml."""
    lines = ["Metadata-Version: 2.1", f"Name: {project['name']}", f"Version: {version}", f"Summary: {project['description']}",
             f"License: {project['license']['text']}", f"Keywords: {','.join(project['keywords'])}",
             f"Requires-Python: =={python}.*"]
    lines += [f"Classifier: {classifier}" for classifier in project["classifiers"]]
    lines += [f"Requires-Dist: {needed}" for needed in project["dependencies"]]
    for extra, wanted in project["optional-dependencies"].items():
        lines += [f"Provides-Extra: {extra}"] + [f"Requires-Dist: {needed}; extra == '{extra}'" for needed in wanted]
    lines += ["Description-Content-Type: text/markdown", "", (SOURCES / project["readme"]).read_text()]
    return "\n".join(lines)


def make_package(build, tree, root, python):
    """What of a wheel is for one Python: the package with its module."""
    package = root / "insonify"
    built = build / "python/insonify"
    package.mkdir(parents=True)
    for file in [*built.glob("*.py"), *built.glob("py.typed")]:
        shutil.copyfile(file, package / file.name)
    shutil.copytree(built / "_insonify", package / "_insonify")
    digits = python.replace(".", "")
    module = package / f"_insonify.cpython-{digits}-x86_64-linux-gnu.so"
    shutil.copyfile(build / "wheel" / module.name, module)
    subprocess.run(["strip", "--strip-unneeded", module], check=True)
    # It is linked with fmt, of which the tree has a copy.
    copies = {re.sub(r"-[0-9a-f]{8}(?=\.so)", "", file.name): file.name for file in (tree / "lib").iterdir()}
    redirect(module, copies, f"$ORIGIN/../{TREE}/lib")


def write_wheel(path, folders, dist_info, texts):
    """folders: of files to pack, by their names in the wheel; texts: of the files of dist_info."""
    record = io.StringIO()
    rows = csv.writer(record, lineterminator="\n")
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as wheel:
        def add(name, content, mode):
            entry = zipfile.ZipInfo(name, LONG_AGO)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o100000 | mode) << 16
            wheel.writestr(entry, content)
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            rows.writerow((name, f"sha256={digest}", len(content)))

        for top, folder in folders.items():
            for file in sorted(folder.rglob("*")):
                if file.is_file():
                    add(f"{top}/{file.relative_to(folder)}", file.read_bytes(), 0o755 if file.stat().st_mode & 0o100 else 0o644)
        for name, text in texts.items():
            add(f"{dist_info}/{name}", text.encode(), 0o644)
        rows.writerow((f"{dist_info}/RECORD", "", ""))
        wheel.writestr(zipfile.ZipInfo(f"{dist_info}/RECORD", LONG_AGO), record.getvalue())


def make_wheel(build, tree, out, version, python):
    root = out / f"staged-{python}"
    make_package(build, tree, root, python)
    refuse_paths(root)
    tag = "cp{0}-cp{0}-{1}".format(python.replace(".", ""), PLATFORM)
    project = tomllib.loads((SOURCES / "pyproject.toml").read_text())["project"]
    path = out / f"insonify-{version}-{tag}.whl"
    scripts = "".join(f"{name} = {function}\n" for name, function in project["scripts"].items())
    write_wheel(path, {"insonify": root / "insonify", TREE: tree}, f"insonify-{version}.dist-info", {
        "METADATA": metadata(project, version, python),
        "WHEEL": f"Wheel-Version: 1.0\nGenerator: insonify make_wheel\nRoot-Is-Purelib: false\nTag: {tag}\n",
        "entry_points.txt": f"[console_scripts]\n{scripts}",
        "top_level.txt": f"insonify\n{TREE}\n"})
    return path


def of_root(info):
    info.uid = info.gid = 0
    info.uname = info.gname = "root"
    return info


def main(build, out, *pythons):
    build, out = pathlib.Path(build).resolve(), pathlib.Path(out).resolve()
    version = re.search(r"^project\(insonify VERSION ([\d.]+)", (SOURCES / "CMakeLists.txt").read_text(), re.MULTILINE).group(1)
    for old in [*out.glob("*.whl"), *out.glob("*.tar.gz")]:
        old.unlink()
    for old in out.glob("staged*"):
        shutil.rmtree(old)
    tree = out / f"staged-tree/insonify-{version}-linux-x86_64"
    make_tree(build, tree)
    refuse_paths(tree)
    archive = out / f"{tree.name}.tar.gz"
    with tarfile.open(archive, "w:gz", compresslevel=9) as packed:
        packed.add(tree, tree.name, filter=of_root)
    shutil.copyfile(SOURCES / "python" / TREE / "__init__.py", tree / "__init__.py")
    made = [archive] + [make_wheel(build, tree, out, version, python) for python in pythons]
    for path in made:
        print(f"{path.relative_to(pathlib.Path.cwd()) if path.is_relative_to(pathlib.Path.cwd()) else path}"
              f"  {path.stat().st_size / 1e6:.1f} MB")


if __name__ == "__main__":
    main(*sys.argv[1:])
